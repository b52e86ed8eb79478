// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// A run of a command, whose stages are timed and whose progress is shown, and the report at its
/// end.
///
/// in    the options that commands share
/// out   what is read and triangulated; the report
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "options.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "rondel/read_cells.h"
#include "rondel/triangulation.h"

namespace rondel::cli {

/// The stages of a job that a command times itself.
enum class Stage { read, dual, locator, query, write };

/// Wall time of a job and of its stages, in seconds. A stage that a command does not time is a part
/// of `total` only.
struct Seconds {
  double read = 0;
  double dual = 0;
  double locator = 0;
  double query = 0;
  double write = 0;
  double total = 0;
};

/// One run of a command: reads, triangulates, times each stage, shows progress on a terminal, and
/// reports in the end. The files that the command writes appear together when it reports; if it
/// fails before, none of them does.
class Job {
 public:
  explicit Job(const CommonOptions& options);
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Reads the sites of INPUT. \throws FileError if it cannot be read
  SiteTable read();
  /// Reads the sites of another file. From netCDF it reads the sites of the variables `names`,
  /// which become the columns, unless FILE:NAME names a variable. Sites that netCDF masks are left
  /// out. \throws FileError if it cannot be read
  SiteTable read(const FileName& file, const ReadOptions& read,
                 std::span<const std::string> names = {});
  /// Does the same, but keeps sites that netCDF masks, and returns what the file says of their
  /// grid. \throws FileError if it cannot be read
  NetcdfSites read_grid(const FileName& file, const ReadOptions& read,
                        std::span<const std::string> names = {});
  /// Reads sites as read_sites_on_mesh() does, and tells what the mesh lacks; as read_grid() does if
  /// no mesh is named.
  /// \param file  the values, or one of its variables; then `names` may be empty
  NetcdfSites read_on_mesh(const FileName& file, const FileName& mesh, const ReadOptions& read,
                           std::span<const std::string> names);
  /// Triangulates the sites. The result refers to the table's sites, which must outlive it.
  /// \throws FileError with the file and line of a site that the library does not accept, and for
  ///         longitudes and latitudes with --center
  Triangulation triangulate(const SiteTable& table);
  /// Returns the convex hull of the sites. \throws FileError like triangulate()
  Triangulation hull(const SiteTable& table);
  /// Returns the values as they are shown: where several sites are in one place, each has the first
  /// value there. The report will say how many sites have no value, and how many have another value
  /// than the one shown.
  /// \param values  a value for each site, by the index of the input; NaN: none
  /// \param name  the column that the values come from
  /// \param consequence  what becomes of sites without a value: "cells without a value have no
  /// color"
  std::vector<double> shown_values(const Triangulation& triangulation,
                                   const std::vector<double>& values, const std::string& name,
                                   const std::string& consequence);
  /// Adds a remark on a file, which is told with the report.
  void remark(const std::string& file, const std::string& text);
  /// Runs `work` on the clock of `stage`.
  void time(Stage stage, const std::function<void()>& work);
  /// Returns the wanted number of threads, and a progress, which is empty if none is shown.
  [[nodiscard]] Execution execution() const;
  /// Returns the sphere that the options say.
  [[nodiscard]] const Sphere& sphere() const;
  /// Returns the times up to now.
  [[nodiscard]] Seconds seconds() const;

  /// Prints the summary, or the JSON object of --json; prints nothing with --quiet, or if the
  /// output goes to standard output. `what` says what was written to OUTPUT, for example "the
  /// triangulation". \throws FileError if stdout cannot be written
  void report(const Triangulation& triangulation, const std::string& what);
  /// Does the same for a command with its own report; `json` is printed with --json.
  void report(const std::string& json, const std::string& summary);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns work(), which calls the library with the sites of `table`. An InvalidInput becomes a
/// FileError that names the site's place in the file.
template <class Work>
auto with_places(const SiteTable& table, Work&& work) {
  try {
    return work();
  } catch (const InvalidInput& error) {
    const bool has_place = error.index() != InvalidInput::no_index;
    throw FileError((has_place ? table.where(error.index()) : table.name) + ": " + error.what());
  }
}

/// Returns for each site whether it is a vertex: neither hidden nor a duplicate of another one.
std::vector<bool> are_vertices(const Triangulation& triangulation);

/// Returns the longitudes and latitudes of a table: those that it has, or those of its points as they
/// are seen from a center.
std::vector<LonLat> lonlats_of(const SiteTable& table, const Point& center);
/// Makes points around a center of longitudes and latitudes, which are seen from there. Tables with
/// x, y, z stay as they are.
void move_to(const Point& center, SiteTable& table);

/// Tells that names of columns in `read`, which are for another file, change nothing for this one.
void tell_of_columns(const std::string& netcdf, const ReadOptions& read);

/// Writes to stdout and flushes. \throws FileError
void print(const std::string& text);

}  // namespace rondel::cli
