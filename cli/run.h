// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options of the commands, and the functions that run them after parsing (plot apart:
/// plot.cpp).
///
/// in    the options of a command, with the files that they name
/// out   files, a report, and the exit status of the tool
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "command.h"
#include "inputs/kinds.h"
#include "rondel/polygon_files.h"

namespace rondel::cli {

/// The options of `rondel delaunay`; the files are written beside the triangles.
struct DelaunayOptions {
  CommonOptions common;
  std::string neighbors;      ///< --neighbors; empty: not written
  std::string areas;          ///< --areas; empty: not written
  std::string circumcenters;  ///< --circumcenters; empty: not written
  std::string duplicates;     ///< --duplicates; empty: not written
  std::string scratch;        ///< --scratch; empty: everything in memory
  std::uint64_t memory = 0;   ///< --memory, in bytes; 0: not given
  bool resume = false;        ///< --resume
};

/// The options of `rondel voronoi`.
struct VoronoiOptions {
  CommonOptions common;
  double tolerance_deg = 0.01;
  std::string clip;        ///< --clip; empty: whole cells
  std::string clip_value;  ///< --clip-value; empty: the union of the polygons
  PolygonEdges edges = PolygonEdges::lonlat;
  PolygonOverlap overlap = PolygonOverlap::error;
  std::string group;           ///< --group; empty: one cell a site
  double densify_km = 0;       ///< --densify; 0: the input has sites, otherwise lines and polygons
  double earth_radius_km = 0;  ///< --earth-radius; 0: not given, and areas are not in square
                               ///< kilometers
};

/// The options of `rondel hull`.
struct HullCommandOptions {
  CommonOptions common;
  bool is_compact = false;  ///< --compact
};

/// The options of `rondel check`.
struct CheckOptions {
  CommonOptions common;
  std::string triangles;
};

/// The options of `rondel generate`.
struct GenerateOptions {
  CommonOptions common;
  std::string kind;
  inputs::Recipe recipe;
  double angle = 0;  ///< in the unit of the command line; 0: the kind's own
};

/// The options of locate and nearest; k and within_deg belong to nearest only.
struct QueryOptions {
  CommonOptions common;
  std::string queries;               ///< QUERIES; "-": standard input
  std::string query_format;          ///< empty: by the ending
  std::vector<std::string> columns;  ///< --column: columns of INPUT to add to the answers
  std::uint64_t k = 0;               ///< -k; 0: not given
  double within_deg = -1;            ///< --within; negative: not given
};

/// These functions run the commands after parsing.
ExitStatus run_delaunay(const DelaunayOptions& options);
/// Runs run_delaunay() with --scratch (out_of_core.cpp).
ExitStatus run_out_of_core(const DelaunayOptions& options);
ExitStatus run_voronoi(const VoronoiOptions& options);
ExitStatus run_hull(const HullCommandOptions& options);
ExitStatus run_check(const CheckOptions& options);
ExitStatus run_generate(const GenerateOptions& options);
ExitStatus run_locate(const QueryOptions& options);
ExitStatus run_nearest(const QueryOptions& options);
ExitStatus run_info(const CommonOptions& options);

}  // namespace rondel::cli
