// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file's format is named, or told by its ending.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "rondel/export.h"
#include "rondel/io.h"

namespace rondel::io {

// ".csv" of the format "CSV" or, if none is named, of the path "data/Stations.CSV": in lower case;
// empty if the path has no ending. Slashes at the end, as of a folder, do not count.
RONDEL_API std::string ending(const FileName& file);

// The endings that files of netCDF have, those of UGRID, Exodus and HDF5 among them.
inline constexpr std::array<std::string_view, 9> netcdf_endings = {
    ".nc", ".nc4", ".cdf", ".ncf", ".ug", ".exo", ".e", ".g", ".h5"};
// Whether the format or, where none is named, the ending of the path is one of them.
RONDEL_API bool has_netcdf_ending(const FileName& file);

// The options, with the kind that the file's name says if they have none.
RONDEL_API NetcdfOptions with_kind(NetcdfOptions options, const FileName& file);

// The row of a table of formats whose member `ending` fits the file; null if there is none.
template <typename Format>
const Format* find_format(std::span<const Format> formats, const FileName& file) {
  const std::string wanted = ending(file);
  for (const Format& format : formats) {
    if (format.ending == wanted) return &format;
  }
  return nullptr;
}

// Throws FileError: `out.dat: unknown ending ".dat"; cells are written as .geojson .vtp .npz`,
// where `what` is "cells are written as".
[[noreturn]] RONDEL_API void throw_unknown_ending(const FileName& file, std::string_view what,
                                                  std::span<const std::string_view> known);

// The row of find_format(); where there is none, throw_unknown_ending() lists the endings of all.
template <typename Format>
const Format& require_format(std::span<const Format> formats, const FileName& file,
                             std::string_view what) {
  if (const Format* const format = find_format(formats, file)) return *format;
  std::vector<std::string_view> known;
  for (const Format& format : formats) known.push_back(format.ending);
  throw_unknown_ending(file, what, known);
}

// A row of a table of formats: how what a job says is written.
template <typename Job>
struct Writer {
  std::string_view ending;
  void (*write)(AtomicFile&, const Job&);
};

// Writes the whole file, in the format that require_format() finds, or nothing.
template <typename Job>
void write_whole(std::span<const Writer<Job>> writers, const FileName& output,
                 std::string_view what, const Job& job) {
  const Writer<Job>& writer = require_format(writers, output, what);
  AtomicFile file(output.path);
  writer.write(file, job);
  file.commit();
}

}  // namespace rondel::io
