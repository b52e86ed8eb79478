// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Files in and out (target rondel::io; POSIX and Windows). Every function throws FileError with one line
/// that names the file and, where there is one, the line and the value. Output goes to a temporary
/// file beside the named one and is renamed when it is complete: a failure or a signal leaves what
/// was there before. A power failure soon after may not: nothing waits for the disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rondel/diagram.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// A file and its format.
struct FileName {
  FileName(std::string name, std::string format_name = "")
      : path(std::move(name)), format(std::move(format_name)) {}
  FileName(const char* name, std::string format_name = "")
      : path(name), format(std::move(format_name)) {}
  FileName(const std::filesystem::path& name, std::string format_name = "")
      : path(name.string()), format(std::move(format_name)) {}

  std::string path;    ///< "-" is standard input or output
  std::string format;  ///< "ply", "npy" ...; empty: by the ending of the path
};

/// The formats in which netCDF is written. by_name: netCDF-4 where the name of the file ends in .nc4, otherwise one of the classic
/// formats. CDF-2 is read by every program, and its variables have less than 4 GiB; netCDF-4 (HDF5) is compressed.
enum class NetcdfKind : std::uint8_t { by_name, cdf2, cdf5, netcdf4 };

/// Options of writing netCDF. Equal calls give equal bytes; for netCDF-4 this holds with equal versions of netCDF-C and HDF5, which are
/// named in the file.
struct NetcdfOptions {
  NetcdfKind kind = NetcdfKind::by_name;
  int deflate = 1;  ///< netCDF-4: how much effort zlib takes, 0 (not compressed) to 9
};

/// Says where the library netCDF-C is, which reads and writes netCDF-4 (HDF5): the path or the name of its file, which is tried before
/// the names under which systems have it. A program that brings the library calls this before the first file of netCDF-4. The
/// variable RONDEL_NETCDF of the environment takes precedence.
RONDEL_API void set_netcdf_library(const std::string& path);

/// Whether a file is netCDF. Its format says so if one is named; otherwise its first bytes do, where it can be read twice; otherwise the
/// ending of its path: .nc .nc4 .cdf .ncf .ug .exo .e .g .h5.
RONDEL_API bool is_netcdf_file(const FileName& file);

/// How to read sites.
struct ReadOptions {
  char delimiter = '\0';  ///< of .csv and .tsv; 0: a comma, a tab
  std::string lon, lat;   ///< column names; empty: found by header (lon, lng, long, longitude ...)
  std::string x, y, z;    ///< column names; empty: found by header
  /// Column of the angular radius in degrees, for GeoJSON a property: each site is then the
  /// weighted site of a circle, see polar_point(). Empty: sites have no radius.
  std::string radius;
  bool radians = false;       ///< longitude, latitude and radius are in radians
  bool keep_columns = false;  ///< keep the text of every column, for the properties of GeoJSON
};

/// One column of a table, as text.
struct Column {
  std::string name;
  /// Every cell that is not empty is JSON, which is written as it is; of a file, a number.
  bool is_numeric = false;
  std::string text;                 ///< all cells, one after the other
  std::vector<std::uint64_t> ends;  ///< where each cell ends in `text`
  /// Which cells are numbers, where a GeoJSON property is here a number and there a text; else empty.
  std::vector<bool> is_number = {};
};

/// The sites of a file.
struct SiteTable {
  std::string name;               ///< the file, for messages; "<stdin>" for standard input
  std::vector<Point> sites;       ///< unit vectors for lon/lat input, otherwise as given;
                                  ///< of circles the polar points
  std::vector<LonLat> positions;  ///< degrees as given; empty for xyz input
  std::vector<double> radii_deg;  ///< of circles; empty without a radius column
  std::vector<Column> columns;    ///< if kept; one without a name is "column_3" by its place
  /// The line of each site, or its row where the format has no lines; empty where every line, or row, is a site.
  std::vector<std::uint64_t> lines;
  /// The line of site 0 when `lines` is empty; 0: the format has none.
  std::uint64_t first_line = 1;
  std::uint64_t num_unlocated = 0;  ///< GeoJSON: features left out, as they have no geometry

  [[nodiscard]] bool is_lonlat() const noexcept { return !positions.empty(); }
  /// "stations.csv:17" or, for formats without lines, "sites.npy: row 16".
  [[nodiscard]] RONDEL_API std::string where(std::size_t site) const;
  /// The sites i with keep[i], in their order, with all that the table says of them.
  [[nodiscard]] RONDEL_API SiteTable selection(const std::vector<bool>& keep) const;
};

/// Reads .csv .tsv .xyz .txt .npy .geojson; "-" is standard input, CSV where no format is named. A
/// file without sites is an answer; one without a byte is an error.
RONDEL_API SiteTable read_sites(const FileName& file, const ReadOptions& options = {},
                                const Execution& execution = {});

/// Reads the faces (m, 3) of .npy .off .ply .obj .vtp.
RONDEL_API std::vector<Triple> read_triangles(const FileName& file);

/// Whether the format can hold triangles (.npy .off .ply .obj .stl .vtp .pvtp .geojson .zarr), cells (.geojson
/// .vtp .npz), sites (.csv .xyz .npy ...).
RONDEL_API bool can_write_triangles(const FileName& file);
RONDEL_API bool can_write_cells(const FileName& file);
RONDEL_API bool can_write_sites(const FileName& file);

/// Writes the triangles; throws InvalidInput, as write_cells() does, if the sites of the table are
/// not those of the triangulation. .npy has input indices (m, 3) uint32; formats with vertices list
/// every input site in input order with digits that round-trip.
/// .zarr is a folder (write_zarr()), and .pvtp a file beside a folder with .vtp files of 2^20 faces or fewer.
/// .stl repeats the corners as 32-bit floats, the only numbers that it has. GeoJSON has the solid
/// faces: seen from the center, ghost faces are flat or reversed.
RONDEL_API void write_triangles(const FileName& file, const SiteTable& table,
                                const Triangulation& triangulation,
                                const Execution& execution = {});

/// What a Zarr group has beside sites and faces, if it is wanted.
struct ZarrContent {
  bool neighbors = false;   ///< (m, 3): faces, opposite to each corner
  bool areas = false;       ///< (n,): steradians, as areas()
  bool duplicates = false;  ///< (k, 2): site and representative
};

/// Writes the triangulation as a Zarr group of version 3, a folder, with the conventions of UGRID: arrays
/// `faces`, `sites`, `node_lon`, `node_lat` (degrees) and, if there are some, `ghost_faces`. Nothing is
/// compressed. A folder that exists is replaced if it was made by this function and nothing was added.
/// write_triangles() to a name that ends in .zarr does the same.
RONDEL_API void write_zarr(const std::string& path, const SiteTable& table,
                           const Triangulation& triangulation, const ZarrContent& content = {},
                           const Execution& execution = {});

/// A tenth of a millimetre on the earth.
inline constexpr double least_tolerance_deg = 1e-9;

/// Writes the cells. GeoJSON obeys RFC 7946 with one feature a cell: arcs are densified until the
/// straight line in longitude and latitude is within `tolerance_deg` of the arc
/// (closer between sites that are close). It is positive; less than least_tolerance_deg counts as
/// that.
RONDEL_API void write_cells(const FileName& file, const SiteTable& table,
                            const Triangulation& triangulation, const Diagram& diagram,
                            double tolerance_deg = 0.01, const Execution& execution = {});

/// Writes sites, for generators: .csv and .tsv (lon,lat or x,y,z with a header), .xyz, .txt, .npy.
/// With the radii of circles at `positions`, .csv and .tsv have lon,lat,radius, and .npy has
/// `sites`, the polar points, as .xyz and .txt always do.
RONDEL_API void write_sites(const FileName& file, std::span<const Point> sites,
                            std::span<const LonLat> positions = {},
                            std::span<const double> radii_deg = {},
                            const Execution& execution = {});

/// Writes indices as .npy (uint32) of this shape, whose product is their number.
RONDEL_API void write_indices(const std::string& path, std::span<const Index> values,
                              std::span<const std::uint64_t> shape);

/// Writes numbers as .npy (float64) of this shape, whose product is their number; of none, (n,).
RONDEL_API void write_numbers(const std::string& path, std::span<const double> values,
                              std::span<const std::uint64_t> shape = {});

/// Writes any bytes: all or nothing.
RONDEL_API void write_file(const std::string& path, std::string_view bytes);

/// Removes the temporary files of all outputs in work. For handlers of signals that end the
/// program: it may be called at any moment, and what is being written is then lost.
RONDEL_API void remove_temporaries() noexcept;

}  // namespace rondel
