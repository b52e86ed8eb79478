// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file's ending tells its format.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rondel::io {

// ".csv" of "data/Stations.CSV": the ending in lower case; empty if the name has none.
std::string ending(std::string_view path);

// The row of a table of formats whose member `ending` fits the path; null if there is none.
template <typename Format>
const Format* find_format(std::span<const Format> formats, std::string_view path) {
  const std::string wanted = ending(path);
  for (const Format& format : formats) {
    if (format.ending == wanted) return &format;
  }
  return nullptr;
}

// Throws FileError: `out.dat: unknown ending ".dat"; cells are written as .geojson .vtp .npz`,
// where `what` is "cells are written as".
[[noreturn]] void throw_unknown_ending(const std::string& path, std::string_view what,
                                       std::span<const std::string_view> known);

// The same as find_format, which must not fail.
template <typename Format>
const Format& require_format(std::span<const Format> formats, const std::string& path,
                             std::string_view what) {
  if (const Format* const format = find_format(formats, path)) return *format;
  std::vector<std::string_view> known;
  for (const Format& format : formats) known.push_back(format.ending);
  throw_unknown_ending(path, what, known);
}

}  // namespace rondel::io
