// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the format of a file, which the user names or the ending of the file tells.
//
// in    the name of a file, and perhaps a format
// out   a row of a table of formats
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "rondel/io.h"

namespace rondel::io {

// Returns ".csv" for the format "CSV" or, if no format is named, for the path "data/Stations.CSV":
// the ending in lower case. Returns an empty text if the path has no ending. Slashes at the end, as
// of a folder, do not count.
std::string ending(const FileName& file);

// True if a file has features of GeoJSON, by its format or its ending.
inline bool is_geojson(const FileName& file) {
  const std::string text = ending(file);
  return text == ".geojson" || text == ".json";
}

// True if the file is standard input, and no format is named for it.
inline bool is_unnamed_input(const FileName& file) {
  return file.path == "-" && file.format.empty() && file.bytes == nullptr;
}

// Returns the format of an unnamed input: "geojson" if its text begins as an object of JSON, or else
// "csv".
std::string format_of_text(std::string_view text);

// The endings of netCDF files, including those of UGRID, Exodus and HDF5.
inline constexpr std::array<std::string_view, 9> netcdf_endings = {
    ".nc", ".nc4", ".cdf", ".ncf", ".ug", ".exo", ".e", ".g", ".h5"};
// True if the format or, if none is named, the ending of the path is one of them.
bool has_netcdf_ending(const FileName& file);

// Returns the options, with the kind that the file's name tells if they have none.
NetcdfOptions with_kind(NetcdfOptions options, const FileName& file);

// Returns the row of a table of formats whose member `ending` matches the file; null if there is
// none.
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
[[noreturn]] void throw_unknown_ending(const FileName& file, std::string_view what,
                                       std::span<const std::string_view> known);

// Returns the row of find_format(); if there is none, throws FileError with all known endings.
template <typename Format>
const Format& require_format(std::span<const Format> formats, const FileName& file,
                             std::string_view what) {
  if (const Format* const format = find_format(formats, file)) return *format;
  std::vector<std::string_view> known;
  for (const Format& format : formats) known.push_back(format.ending);
  throw_unknown_ending(file, what, known);
}

// A row of a table of writers: the ending of a format, and the function that writes it.
template <typename Job>
struct Writer {
  std::string_view ending;
  void (*write)(AtomicFile&, const Job&);
};

// Writes the whole file in the format that require_format() finds, or nothing if it throws.
template <typename Job>
void write_whole(std::span<const Writer<Job>> writers, const FileName& output,
                 std::string_view what, const Job& job) {
  const Writer<Job>& writer = require_format(writers, output, what);
  AtomicFile file(output);
  writer.write(file, job);
  file.commit();
}

}  // namespace rondel::io
