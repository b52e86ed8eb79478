// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files and strings that Python passes to what reads or writes a FileName.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

#include <optional>
#include <string>
#include <variant>

#include "rondel/io.h"

namespace rondel::python {

using PathOut = std::optional<std::string>;
using PathIn = std::variant<std::string, nb::bytes>;

// Calls write(FileName) for a path, and returns nothing; or, without a path, for a string of
// GeoJSON, which it returns.
template <class Write>
std::optional<nb::bytes> written(const PathOut& path, const Write& write) {
  std::string text;
  write(path ? FileName(*path) : FileName::in_memory(text, "geojson"));
  if (path) return std::nullopt;
  return nb::bytes(text.data(), text.size());
}

// Calls read(FileName) for a path; or for bytes, which are GeoJSON of geometries. Returns its
// result.
template <class Read>
auto read_from(const PathIn& path, const Read& read) {
  if (const auto* const name = std::get_if<std::string>(&path)) return read(FileName(*name));
  const auto& bytes = std::get<nb::bytes>(path);
  std::string text(bytes.c_str(), bytes.size());
  return read(FileName::in_memory(text, "geojson", "geometries"));
}

}  // namespace rondel::python
