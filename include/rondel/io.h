// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Files in and out (target rondel::io). Every function throws FileError with one line that
/// names the file and, where there is one, the line and the value. Output
/// goes to a temporary name beside the file and is renamed when it is complete.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rondel/diagram.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::inline v0 {

/// How to read sites.
struct ReadOptions {
  std::string lon, lat;  ///< column names; empty: found by header (lon, lng, long, longitude ...)
  std::string x, y, z;   ///< column names; empty: found by header
  /// Column of the angular radius in degrees, for GeoJSON a property: each site is then the
  /// weighted site of a circle, see polar_point(). Empty: sites have no radius.
  std::string radius;
  bool radians = false;       ///< longitude, latitude and radius are in radians
  bool keep_columns = false;  ///< keep the text of every column, for the properties of GeoJSON
  Progress progress{};
};

/// One column of a table, as text.
struct Column {
  std::string name;
  /// Every cell that is not empty is JSON, which is written as it is; of a file, a number.
  bool is_numeric = false;
  std::string text;                 ///< all cells, one after the other
  std::vector<std::uint64_t> ends;  ///< where each cell ends in `text`
};

/// Points of a vector, or of a file that is mapped into memory and stays so as long as it is
/// needed.
class PointArray {
 public:
  using value_type = Point;
  using const_iterator = const Point*;
  using iterator = const_iterator;

  PointArray() = default;
  PointArray(std::vector<Point> points) : owned_(std::move(points)) {}
  /// Refers to points that live as long as `memory`.
  PointArray(std::span<const Point> points, std::shared_ptr<const void> memory)
      : mapped_(points), memory_(std::move(memory)) {}

  [[nodiscard]] std::span<const Point> view() const noexcept {
    return mapped_.empty() ? std::span<const Point>(owned_) : mapped_;
  }
  [[nodiscard]] const_iterator begin() const noexcept { return view().data(); }
  [[nodiscard]] const_iterator end() const noexcept { return begin() + size(); }
  [[nodiscard]] std::size_t size() const noexcept { return view().size(); }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  const Point& operator[](std::size_t i) const { return view()[i]; }

  /// Whether the points are those of a mapped file.
  [[nodiscard]] bool is_mapped() const noexcept { return !mapped_.empty(); }
  /// The vector, to change it; not for mapped points.
  std::vector<Point>& owned() { return owned_; }

  friend bool operator==(const PointArray& a, const PointArray& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::vector<Point> owned_;
  std::span<const Point> mapped_;
  std::shared_ptr<const void> memory_;
};

/// The sites of a file.
struct SiteTable {
  std::string name;                  ///< the file, for messages; "<stdin>" for "-"
  PointArray sites;                  ///< unit vectors for lon/lat input, otherwise as given;
                                     ///< of circles the polar points
  std::vector<LonLat> positions;     ///< degrees as given; empty for xyz input
  std::vector<double> radii_deg;     ///< of circles; empty without a radius column
  std::vector<Column> columns;       ///< if kept
  std::vector<std::uint64_t> lines;  ///< the line of each site; empty where every line is a site
  std::uint64_t first_line =
      1;  ///< the line of site 0 when `lines` is empty; 0: the format has none

  [[nodiscard]] bool is_lonlat() const noexcept { return !positions.empty(); }
  /// "stations.csv:17" or, for formats without lines, "sites.npy: row 16".
  [[nodiscard]] std::string where(std::size_t site) const;
};

/// Reads .csv .tsv .xyz .txt .npy .geojson; "-" is CSV from standard input. The numbers of a large
/// .npy file, (n, 3) float64 little-endian in C order, are not copied: the sites are the mapped
/// file, which must not be cut or changed as long as they are used.
RONDEL_API SiteTable read_sites(const std::string& path, const ReadOptions& options = {});

/// Reads the faces (m, 3) of .npy .off .ply .obj .vtp.
RONDEL_API std::vector<Triple> read_triangles(const std::string& path);

/// Whether the format that the name's ending tells can hold triangles (.npy
/// .off .ply .obj .stl .vtp .geojson), cells (.geojson .vtp .npz), sites (.csv .xyz .npy ...).
RONDEL_API bool can_write_triangles(const std::string& path);
RONDEL_API bool can_write_cells(const std::string& path);
RONDEL_API bool can_write_sites(const std::string& path);

/// Writes the triangles; throws InvalidInput, as write_cells() does, if the arguments do not belong
/// together. .npy has input indices (m, 3) uint32; formats with vertices list every input site in
/// input order with digits that round-trip. .stl repeats the corners as 32-bit floats, the only
/// numbers that it has. GeoJSON has the solid faces: seen from the center, ghost faces are flat or
/// reversed. `triangulation.report().threads` threads at most, here and below.
RONDEL_API void write_triangles(const std::string& path, const SiteTable& table,
                                const Triangulation& triangulation, const Progress& progress = {});

/// Writes the cells. GeoJSON obeys RFC 7946 with one feature a cell: arcs are densified until the
/// straight line in longitude and latitude is within `tolerance_deg` of the arc
/// (closer between sites that are close).
RONDEL_API void write_cells(const std::string& path, const SiteTable& table,
                            const Triangulation& triangulation, const Diagram& diagram,
                            double tolerance_deg = 0.01, const Progress& progress = {});

/// Writes sites, for generators: .csv and .tsv (lon,lat or x,y,z with a header), .xyz, .txt, .npy.
/// With the radii of circles at `positions`, .csv and .tsv have lon,lat,radius, and .npy has
/// `sites`, the polar points, as .xyz and .txt always do. At most `threads` threads make the text,
/// 0: one for each core.
RONDEL_API void write_sites(const std::string& path, std::span<const Point> sites,
                            std::span<const LonLat> positions = {},
                            std::span<const double> radii_deg = {}, unsigned threads = 0);

/// Writes indices as .npy (uint32) of this shape, whose product is their number.
RONDEL_API void write_indices(const std::string& path, std::span<const Index> values,
                              std::span<const std::uint64_t> shape);

/// Writes any bytes to a temporary name and renames it to `path`: all or nothing.
RONDEL_API void write_file(const std::string& path, std::string_view bytes);

/// For programs, once, at their start: SIGHUP, SIGINT and SIGTERM will remove all temporary files
/// before they end the process, a limit on the size of files will be an error, no signal, and a
/// file that is cut while read_sites() or the use of its sites reads it (SIGBUS) ends the process
/// with status 1 and the line "rondel: sites.npy: the file was cut while it was read".
RONDEL_API void remove_temporaries_on_signal();

}  // namespace rondel::inline v0
