// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Reading and writing of files (target rondel::geo; POSIX and Windows). Every function throws
/// FileError with one line that names the file and, where there is one, the line and the value.
/// Output goes to a temporary file beside the named one and is renamed when it is complete, so a
/// failure or a signal leaves the file that was there before. The library does not wait for the
/// disk: after a power failure within seconds the file may be incomplete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
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

/// The name of a file, and its format; or a string in place of a file, which every function that
/// takes a FileName reads or writes.
struct FileName {
  FileName(std::string name, std::string format_name = "")
      : path(std::move(name)), format(std::move(format_name)) {}
  FileName(const char* name, std::string format_name = "")
      : path(name), format(std::move(format_name)) {}
  FileName(const std::filesystem::path& name, std::string format_name = "")
      : path(name.string()), format(std::move(format_name)) {}

  /// Returns a string as a file. Readers copy it; writers give it the bytes of the file when these
  /// are complete, and leave it as it is if they fail.
  /// \param content  it must live as long as the result is used
  /// \param format_name  as `format`
  /// \param name  stands for the file in messages
  RONDEL_API static FileName in_memory(std::string& content, std::string format_name,
                                       std::string name = "<memory>");

  std::string path;              ///< "-" is standard input or output
  std::string format;            ///< "ply", "npy" ...; if empty, the ending of the path decides
  std::string* bytes = nullptr;  ///< the string that is read or written; null for a file
};

/// Files that appear together. What this thread writes while an object of this class exists appears
/// by commit(), and not at all without it, so that a failure leaves all files as they were. What is
/// not a regular file (standard output, a device) is written at once.
class RONDEL_API FilesTogether {
 public:
  FilesTogether();
  ~FilesTogether();
  FilesTogether(const FilesTogether&) = delete;
  FilesTogether& operator=(const FilesTogether&) = delete;

  /// Gives the files their names, in the order in which they were completed. Files that are written
  /// later appear at once. \throws FileError if the system refuses a name; the files before have it
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns the format of a file in lower case, "ply": the one that is named, or the ending of the
/// path, where slashes at the end do not count; empty if it has none.
RONDEL_API std::string format_of(const FileName& file);

/// The formats in which netCDF is written. by_name is netCDF-4 if the name of the file ends in
/// .nc4, and otherwise one of the classic formats. CDF-2 is read by every program, and its
/// variables have less than 4 GiB; netCDF-4 (HDF5) is compressed.
enum class NetcdfKind : std::uint8_t { by_name, cdf2, cdf5, netcdf4 };

/// Returns the name of a value: "by_name", "cdf2", "cdf5", "nc4"; empty for other numbers.
RONDEL_API std::string_view name_of(NetcdfKind kind) noexcept;

/// Options for writing netCDF. Equal calls give equal bytes; for netCDF-4 this holds for equal
/// versions of netCDF-C and HDF5, which are recorded in the file.
struct NetcdfOptions {
  NetcdfKind kind = NetcdfKind::by_name;
  int deflate = 1;  ///< netCDF-4: the effort of zlib, from 0 (not compressed) to 9
};

/// Sets the path or the name of the library netCDF-C, which reads and writes netCDF-4 (HDF5). It is
/// tried before the names that systems give to the library. A program that brings its own library
/// calls this before it uses the first file of netCDF-4. The environment variable RONDEL_NETCDF
/// takes precedence.
RONDEL_API void set_netcdf_library(const std::string& path);

/// True if a file is netCDF: by its format if one is named, or else by its first bytes if it can be
/// read twice, or else by the ending of its path: .nc .nc4 .cdf .ncf .ug .exo .e .g .h5.
RONDEL_API bool is_netcdf_file(const FileName& file);

/// Divides `FILE.nc:NAME`, a variable of a netCDF file, into the file and the name behind a colon;
/// the name may have colons itself. Returns the whole path and no name if there is a file of that
/// path, or if no part before a colon is a netCDF file.
RONDEL_API std::pair<FileName, std::string> file_and_variable(const FileName& file);

/// Options for reading sites.
struct ReadOptions {
  char delimiter = '\0';  ///< for .csv and .tsv; 0: a comma, or a tab
  /// Column names; if empty, found by header (lon, lng, long, longitude ...).
  std::string lon, lat;
  std::string x, y, z;  ///< column names; if empty, found by header
  /// The name of the column (or GeoJSON property) with angular radii in degrees. Each site is then
  /// the weighted site of a circle, see polar_point(). If the name is empty, sites have no radius.
  std::string radius;
  bool radians = false;       ///< longitude, latitude and radius are in radians
  bool keep_columns = false;  ///< keep the text of every column, for the properties of GeoJSON
  /// .csv and .tsv: a table without columns for places has no sites, and a row whose coordinates
  /// are all empty is a site that is not a number, in place of being left out.
  bool may_lack_places = false;
};

/// One column of a table, as text.
struct Column {
  std::string name;
  /// True if every cell that is not empty is JSON, which is written unchanged; in a file that was
  /// read, a number.
  bool is_numeric = false;
  std::string text;                 ///< all cells, one after the other, without separators
  std::vector<std::uint64_t> ends;  ///< where each cell ends in `text`
  /// Says which cells are JSON that is written unchanged, null where they are empty; the others are
  /// texts, also where they are empty. It is empty if `is_numeric` says it: then an empty cell is
  /// null, and the others are JSON or texts.
  std::vector<bool> is_json = {};
  /// Attributes of a variable of netCDF that has the cells: long_name, units ...
  std::vector<std::pair<std::string, std::string>> attributes = {};

  /// Returns the text of a cell.
  [[nodiscard]] std::string_view cell(std::size_t row) const {
    const std::uint64_t begin = row == 0 ? 0 : ends[row - 1];
    return std::string_view(text).substr(begin, ends[row] - begin);
  }
  /// Appends a cell of a column of the same kind.
  void add(const Column& column, std::size_t row) {
    text += column.cell(row);
    ends.push_back(text.size());
    if (!column.is_json.empty()) is_json.push_back(column.is_json[row]);
  }
  /// True if an integer of a column of numbers is no double, as hashes and indices of 64 bits often
  /// are. Files that store doubles have such columns as texts.
  [[nodiscard]] RONDEL_API bool has_wide_integers() const;
  /// Returns a column of this name and kind without cells.
  [[nodiscard]] Column empty_copy() const { return {name, is_numeric, {}, {}, {}, attributes}; }
};

/// Returns names that differ from each other and from those that are taken, as properties, columns
/// and variables of a file have to: in order, a name that is taken gets underscores at its end.
/// \param ignores_case  true if the letters a to z and A to Z do not make names different
[[nodiscard]] RONDEL_API std::vector<std::string> free_names(std::vector<std::string> names,
                                                             std::set<std::string> taken = {},
                                                             bool ignores_case = false);

/// The sites of a file.
struct SiteTable {
  std::string name;  ///< the file, for messages; "<stdin>" for standard input
  /// Unit vectors for longitudes and latitudes, otherwise as given; polar points for circles.
  std::vector<Point> sites;
  std::vector<LonLat> positions;  ///< degrees as given; empty for xyz input
  std::vector<double> radii_deg;  ///< the radii of circles; empty without a radius column
  std::vector<Column> columns;    ///< if they are kept; the third one without a name is "column_3"
  /// GeoJSON: the members `id` of the features, as JSON, if columns are kept. A cell is empty where
  /// a feature has none or more than one site; there are no cells if all of them would be empty.
  Column ids;
  /// The line of each site, or its row if the format has no lines; empty if every line, or row, has
  /// one site.
  std::vector<std::uint64_t> lines;
  /// The line of site 0 if `lines` is empty; 0 if the format has no lines.
  std::uint64_t first_line = 1;
  /// GeoJSON with several features in a line: the number of each site's feature, from 0; else
  /// empty.
  std::vector<std::uint64_t> features = {};
  /// The number of sites that were left out because they have no place: features of GeoJSON without a
  /// geometry, rows of .csv and .tsv whose coordinates are all empty
  std::uint64_t num_unlocated = 0;

  [[nodiscard]] bool is_lonlat() const noexcept { return !positions.empty(); }
  /// Returns the place of a site in the file: "stations.csv:17" or, for formats without lines,
  /// "sites.npy: row 16"; "stations.geojson:1: feature 16" if several features are in a line.
  [[nodiscard]] RONDEL_API std::string where(std::size_t site) const;
  /// Returns the sites i with keep[i], in their order, with all that the table has for them.
  [[nodiscard]] RONDEL_API SiteTable selection(const std::vector<bool>& keep) const;
};

/// Reads sites from .csv .tsv .xyz .txt .npy .geojson, and by GDAL from .gpkg .fgb .shp .parquet:
/// GDAL is loaded when such a file is read, and its absence is a FileError. "-" is standard input,
/// GeoJSON if it begins with "{" and no format is named, or else CSV. A file without sites gives an
/// empty table; a file without bytes is an error.
RONDEL_API SiteTable read_sites(const FileName& file, const ReadOptions& options = {},
                                const Execution& execution = {});

/// Returns the names of the columns that were kept and are no coordinates, as read_sites() finds these.
RONDEL_API std::vector<std::string> value_columns(const SiteTable& table,
                                                  const ReadOptions& options = {});

/// Reads the faces (m, 3) of a .npy .off .ply .obj or .vtp file.
RONDEL_API std::vector<Triple> read_triangles(const FileName& file);

/// True if the format can hold triangles (.npy .off .ply .obj .stl .vtp .geojson), cells
/// (.geojson .vtp .npz), or sites (.csv .xyz .npy ...).
RONDEL_API bool can_write_triangles(const FileName& file);
RONDEL_API bool can_write_cells(const FileName& file);
RONDEL_API bool can_write_sites(const FileName& file);

/// Writes the triangles. .npy has input indices (m, 3) uint32; formats with vertices list every
/// input site in input order with digits that round-trip. .stl repeats the corners as 32-bit
/// floats, the only numbers that the format has. GeoJSON has the solid faces only: seen from the
/// center, ghost faces are flat or reversed.
/// \param remarks  gets a sentence if faces have no geometry in GeoJSON: two of their corners round to
///                 opposite places, or they are narrower than what their sides may be off
/// \throws InvalidInput if the sites of the table are not those of the triangulation.
RONDEL_API void write_triangles(const FileName& file, const SiteTable& table,
                                const Triangulation& triangulation, const Execution& execution = {},
                                std::vector<std::string>* remarks = nullptr);

/// Writes some faces, such as those in polygons, in this order, as write_triangles() writes all.
/// \param faces  indices of faces
/// \throws InvalidInput as write_triangles(); (the position in `faces`) if there is no such face.
RONDEL_API void write_some_triangles(const FileName& file, const SiteTable& table,
                                     const Triangulation& triangulation,
                                     std::span<const Index> faces, const Execution& execution = {},
                                     std::vector<std::string>* remarks = nullptr);

/// The least tolerance in degrees: a tenth of a millimetre on the earth.
inline constexpr double min_tolerance_deg = 1e-9;

/// Writes the cells. GeoJSON follows RFC 7946 with one feature for each cell.
/// \param tolerance_deg  positive, degrees: arcs are densified until the straight lines in
///        longitude and latitude are within this distance of the arc (closer between sites that are
///        close). Less than min_tolerance_deg counts as that.
RONDEL_API void write_cells(const FileName& file, const SiteTable& table,
                            const Triangulation& triangulation, const Diagram& diagram,
                            double tolerance_deg = 0.01, const Execution& execution = {});

/// Writes sites, for generators: .csv and .tsv (lon,lat or x,y,z with a header), .xyz, .txt, .npy.
/// With radii of circles at `positions`, .csv and .tsv have lon,lat,radius; .npy has `sites`, the
/// polar points, as .xyz and .txt always have. GDAL writes .gpkg .fgb .parquet: points, and a field
/// "radius" if there are radii.
RONDEL_API void write_sites(const FileName& file, std::span<const Point> sites,
                            std::span<const LonLat> positions = {},
                            std::span<const double> radii_deg = {},
                            const Execution& execution = {});

/// Writes indices as .npy (uint32). \param shape its product is the number of values
RONDEL_API void write_indices(const FileName& file, std::span<const Index> values,
                              std::span<const std::uint64_t> shape);

/// Writes numbers as .npy (float64). \param shape its product is the number of values; empty: (n,)
RONDEL_API void write_numbers(const FileName& file, std::span<const double> values,
                              std::span<const std::uint64_t> shape = {});

/// Writes bytes to a file, completely or not at all.
RONDEL_API void write_file(const FileName& file, std::string_view bytes);

/// Removes the temporary files of all outputs in progress. Handlers of signals that end the program
/// call it: it may be called at any moment, and what is being written is lost.
RONDEL_API void remove_temporaries() noexcept;

}  // namespace rondel
