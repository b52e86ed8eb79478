// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Reading and writing of values at points (target rondel::geo). Every function throws FileError
/// with one line that names the file.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"
#include "rondel/weight_files.h"

namespace rondel {

/// An attribute of netCDF that is a list of numbers.
struct NumericAttribute {
  std::string name;
  std::vector<double> numbers;
  std::string type = "f8";  ///< NumPy's name of the type in the file, "f4", "i2" ...
};

/// An array of a file: values at points, or the numbers of an axis such as time.
struct FieldArray {
  std::string name;
  /// The names of the dimensions before that of the points (or, for an axis, of its only
  /// dimension).
  std::vector<std::string> dimensions;
  std::vector<std::uint64_t> shape;
  std::vector<double> values;  ///< the points change fastest; NaN is missing
  /// units, long_name ...: attributes of netCDF that still hold for values at other points
  std::vector<std::pair<std::string, std::string>> attributes;
  /// Further attributes of netCDF, which are numbers: flag_values, level ...
  std::vector<NumericAttribute> numbers = {};
  /// True if single precision holds the values: netCDF has floats, or packed integers.
  bool is_single = false;
  /// True for texts, which only FieldSet::others has. They have no values, but `characters`, of which
  /// the last dimension counts those of a text; zero bytes fill up what is shorter.
  bool is_text = false;
  std::string characters = {};

  /// Returns the number of fields at the points: the product of `shape`.
  [[nodiscard]] RONDEL_API std::size_t num_fields() const;
  /// Returns the lengths of the dimensions before that of the points, "time 12, level 3".
  [[nodiscard]] RONDEL_API std::string lengths_in_words() const;
};

/// Removes the attributes that say what values mean that stand for categories (flag_values,
/// flag_masks, flag_meanings), which means of such values do not have.
RONDEL_API void remove_flags(FieldArray& array);

/// Returns a name for each field of an array, for use as a column: the name of the array if it has
/// one field, or else that with the field's place on each axis, "tas_2001-07-15_850". An axis that
/// the file does not have, or that has a number twice, is replaced by the index.
RONDEL_API std::vector<std::string> names_of_fields(const FieldArray& array,
                                                    std::span<const FieldArray> axes);

/// The values that a file has at the same points.
struct FieldSet {
  std::size_t num_points = 0;
  std::vector<FieldArray> arrays;
  std::vector<FieldArray> axes;
  /// Arrays of netCDF that have no points, such as bounds of times, with their values; only if
  /// FieldExtras ask for them.
  std::vector<FieldArray> others = {};
  std::vector<std::pair<std::string, std::string>> attributes =
      {};                                      ///< of the file: title, history ...
  std::vector<NumericAttribute> numbers = {};  ///< attributes of the file that are numbers
  /// netCDF with longitudes and latitudes of the points: unit vectors; else empty
  std::vector<Point> points;
  std::vector<LonLat> positions;  ///< the same places in degrees, as in the file
  /// The lengths of the dimensions of the points in the file; empty if some points have no place.
  std::vector<std::uint64_t> shape;
  std::size_t num_without_place =
      0;  ///< how many points were left out because their longitude or latitude is missing
  /// The name of the dimension of points that are on no grid, in netCDF that is written.
  std::string dimension = "point";
  /// The names of the dimensions along which records may be appended to a file of netCDF, such as a
  /// time. In a classic file that is written there is one, and none on standard output.
  std::vector<std::string> unlimited = {};
  /// The number that stands for missing values in a file that is written (`_FillValue`). Values
  /// that were read have NaN.
  double fill = std::numeric_limits<double>::quiet_NaN();
  /// Whether variables of netCDF that are written have the attribute `_FillValue`. Without it no
  /// value of theirs is missing, so they must have no NaN.
  bool is_fill_marked = true;
  /// Sentences that say which variables of netCDF were left out, and why.
  std::vector<std::string> remarks;
  /// A sentence about other grids of the file, if neither a name nor places say which one is meant;
  /// else empty.
  std::string remark_on_grids;
  std::vector<std::uint64_t> lines;  ///< for a table the line of each point, from 1 on; else empty
};

/// Reads values at points:
///
/// | ending | content |
/// | --- | --- |
/// | `.csv`, `.tsv` | the columns `names`, at least one; an empty cell, `nan`, `NA` and `null` are missing |
/// | `.npy` | shape (n,) or (fields, n); no `names` |
/// | `.nc`, `.nc4`, `.cdf`, `.ncf`, or a file that begins as netCDF | the variables `names`, or all that are fields at the points |
///
/// A name may choose one field of a variable that has several: "tas[3]", "tas[-1]" and "tas[3, 0]"
/// by its place along the other dimensions, and "tas_2001-07-15" by the name that names_of_fields()
/// gives to it.
///
/// In netCDF the dimensions of the points are those of their longitudes and latitudes
/// (rondel/conventions.h), in any order and anywhere among the others. Each variable is at the
/// places that its dimensions and its own attribute `coordinates` name. All variables that are read
/// are at the places of the first one; others are left out, or an error if they are named. If the
/// file has no longitudes and latitudes, the points are along the dimension of the length n, or
/// consecutive dimensions whose product is n; it is an error if several fit. The attributes
/// `_FillValue`, `missing_value`, `valid_min`, `valid_max`, `valid_range`, `_Unsigned`,
/// `scale_factor` and `add_offset` turn the numbers of the file into values.
///
/// \param num_points  n. For tables 0 means the number of rows. For netCDF 0 means the number of
///                    longitudes and latitudes of the first variable that has them. Points whose
///                    longitude or latitude is missing are left out, unless n counts them
/// \param shape  the lengths of the grid of the points, if they are on one; a variable of netCDF
///               with other lengths is refused
RONDEL_API FieldSet read_fields(const FileName& file, std::span<const std::string> names,
                                std::uint64_t num_points, const ReadOptions& options = {},
                                std::span<const std::uint64_t> shape = {});

/// Where the points are at which fields are read.
struct WantedPlaces {
  /// A place for each point; NaN fits any place. If empty, the places are not known.
  std::span<const LonLat> positions;
  double max_apart_deg = 1e-4;  ///< how far the coordinates of the file may be from them
};

/// What a FieldFile knows of netCDF beside the fields.
struct FieldExtras {
  /// Whether FieldSet::others has the arrays without points, texts among them, unless they have more
  /// than 2^20 values or characters. Otherwise a remark names them.
  bool has_others = false;
  /// Whether FieldSet::points and positions have the places. They take 40 bytes for each.
  bool has_positions = true;
};

/// A room for FieldFile::keep_chunks() in bytes, in which chunks of 73 times on 0.25 degrees fit.
inline constexpr std::size_t usual_kept_chunks = std::size_t{512} << 20U;

/// A file of fields whose values are read in slices, so that it may be larger than the memory if it
/// is netCDF. Files of other formats are read whole.
class FieldFile {
 public:
  /// Opens a file; the parameters are those of read_fields(), and
  /// \param places  where the points are: variables of netCDF at other places are left out, or an
  ///                error if they are named
  RONDEL_API FieldFile(const FileName& file, std::span<const std::string> names,
                       std::uint64_t num_points, const ReadOptions& options = {},
                       std::span<const std::uint64_t> shape = {}, const WantedPlaces& places = {},
                       const FieldExtras& extras = {});
  RONDEL_API ~FieldFile();
  FieldFile(const FieldFile&) = delete;
  FieldFile& operator=(const FieldFile&) = delete;

  /// Returns the result of read_fields() without the values of the arrays.
  [[nodiscard]] RONDEL_API const FieldSet& fields() const;

  /// Returns the index of the array that a name means, as the names of read_fields() do: the variable
  /// of a group of netCDF is `group/name`, `/group/name`, or `name` where no other group has one.
  /// \returns nothing if it is none of the arrays
  /// \throws FileError if several groups have one
  [[nodiscard]] RONDEL_API std::optional<std::size_t> find(const std::string& name) const;

  /// Reads the values of consecutive points of one field, as many as `out` has room for.
  /// \param first_point  where they begin; values of netCDF are read from the file if they are
  ///                     contiguous there, and otherwise those of the whole field are
  RONDEL_API void read_points(std::size_t array, std::size_t field, std::size_t first_point,
                              std::span<double> out) const;

  /// Lets read() keep uncompressed chunks of netCDF-4 of which it has read a part, in so many bytes
  /// for each array; it is 0 before. A chunk that has many times, read some times at a time, is
  /// uncompressed once then.
  RONDEL_API void keep_chunks(std::size_t bytes) const;

  /// Returns how many bytes read() takes beside its result at least: those of the largest chunk of
  /// netCDF-4, which is uncompressed as a whole, or of a block where the fields of a file are
  /// interleaved. It is 0 for other formats, which are in memory.
  [[nodiscard]] RONDEL_API std::uint64_t bytes_beside() const;

  /// Reads consecutive fields of an array, beginning with field `first`, as many as `out` has room
  /// for.
  /// \param array  its index in fields().arrays
  /// \param out  its size is a multiple of the number of points, which change fastest; NaN is
  ///             missing
  /// \param execution  how many threads decompress the chunks of netCDF-4
  RONDEL_API void read(std::size_t array, std::size_t first, std::span<double> out,
                       const Execution& execution = {}) const;

 private:
  struct OpenFields;
  std::unique_ptr<OpenFields> content_;
};

/// Says which cells are around the points of a target, for netCDF that is to be written: by the
/// name of a grid (NamedGrid::mapping()), which may be in a file, or by the bounds of the cells
/// that the file has, if these are around its points.
/// \param target  the name of a grid, or the file that the points are from; nothing is said of others
/// \param fields  gets the name, and a remark on what the file says of its points beside longitudes
///                and latitudes, such as names of stations, which no field gets
/// \param points  has the points, and gets the bounds: `corners`, or `axes` and `lines`
/// \throws FileError for a file that names a grid which is none
RONDEL_API void describe_cells(const FileName& target, FieldSet& fields, WeightSide& points,
                               const Execution& execution = {});

/// Writes values at the points of a side: `.csv` and `.tsv` with lon, lat, the columns of the side,
/// and one column for each field, named by its time or place on other axes ("tas_2001-07-15",
/// "tas_850"); `.npy` of shape (n,) or (fields, n); `.nc` and `.nc4` on the grid of the side if it
/// has one, or else along one dimension. If two columns or variables would have the same name,
/// coordinates come before fields, and these before columns of the side: what comes later gets an
/// underscore, "lat_".
RONDEL_API void write_fields(const FileName& file, const FieldSet& fields, const WeightSide& points,
                             const NetcdfOptions& netcdf = {});

/// Writes the file of write_fields() in slices. Tables are kept in memory until finish(), files of
/// other formats are not. The file appears when it is complete.
class FieldWriter {
 public:
  /// \param fields  the arrays without values, the axes with theirs; `fields` and `points` must
  ///                stay valid until finish()
  /// \param execution  how many threads compress the chunks of netCDF-4
  RONDEL_API FieldWriter(const FileName& file, const FieldSet& fields, const WeightSide& points,
                         const NetcdfOptions& netcdf = {}, const Execution& execution = {});
  RONDEL_API ~FieldWriter();
  FieldWriter(const FieldWriter&) = delete;
  FieldWriter& operator=(const FieldWriter&) = delete;

  /// Writes the next values: first those of the first array, field by field, then those of the
  /// second one, and so on.
  RONDEL_API void write(std::span<const double> values);
  /// Completes the file. \pre All values are written.
  RONDEL_API void finish();
  /// Returns sentences, with the name of the file, about what it does not have, though the fields do:
  /// dimensions along which records can be appended, in classic netCDF that is written to a pipe.
  [[nodiscard]] RONDEL_API std::vector<std::string> remarks() const;

 private:
  struct BegunFields;
  std::unique_ptr<BegunFields> output_;
};

/// True if the format can hold fields.
RONDEL_API bool can_write_fields(const FileName& file);

}  // namespace rondel
