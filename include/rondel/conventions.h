// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The interpretation of the Climate and Forecast conventions (CF 1.11) and their relatives: which
/// variables are coordinates, and what numbers stand for (target rondel::geo). The readers of files,
/// the tool and the Python package share it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel {

/// The header of a variable of a file or a data set: all of it except the values.
struct VariableHeader {
  std::string name;
  bool is_number = true;
  std::vector<std::string> dimensions;                     ///< the last one changes fastest
  std::vector<std::uint64_t> shape;                        ///< the lengths of the dimensions
  std::vector<std::pair<std::string, std::string>> texts;  ///< the attributes that are texts
  bool is_integer = false;                                 ///< true for numbers that are integers

  /// Returns the text of an attribute, or an empty text if there is no such attribute.
  [[nodiscard]] RONDEL_API std::string text(std::string_view attribute) const;
};

/// Returns the number of degrees in a unit of an angle, by its spelling: UDUNITS's names for
/// degrees (`degree`, `degrees_north`, `degreeE`, `arcdeg` ..., those of west being negative),
/// radians (`radian`, `rad`), and parts of both. Names may have any case, but not the symbols `rad`
/// and `°`. `deg`, which UDUNITS does not know, is read as degrees.
/// \returns nothing for what is no angle, and for an empty text.
RONDEL_API std::optional<double> degrees_per_unit(std::string_view units);

/// The longitudes and latitudes of the same places, with the variables that have the corners or
/// sides of their cells. The members are indices of variables.
struct CoordinatePair {
  static constexpr std::size_t none = ~std::size_t{0};

  std::size_t lon = none;  ///< the longitudes
  std::size_t lat = none;
  std::size_t lon_bounds = none;
  std::size_t lat_bounds = none;
  bool are_axes = false;   ///< true if both have one dimension; the places are then all pairs
  bool is_used = false;    ///< true if another variable has all of their dimensions
  bool is_listed = false;  ///< true if an attribute `coordinates` lists both
  /// How much the variables say of themselves; of two pairs the one with the higher rank comes
  /// first.
  int rank = 0;
};

/// The coordinates to look for.
struct CoordinateQuery {
  std::string lon;  ///< the name of the longitudes; if empty, they are found
  std::string lat;  ///< the name of the latitudes; if empty, they are found
  /// A variable whose coordinates are wanted; if empty, those of all variables are.
  std::string values;
};

/// Finds the pairs of coordinates, the best first; pairs of equal rank are in the order of the
/// variables.
///
/// 1. Longitudes have the standard_name `longitude`, units such as `degrees_east` (CF 4.1, 4.2), or
///    the _CoordinateAxisType `Lon`; or else one of the names that models use (`lon`, `nav_lon`,
///    `TLONG`, `XLONG`, `clon` ...), unless units or standard_name contradict it. Latitudes
///    likewise. A variable with the standard_name of a rotated pole or a projection
///    (`grid_longitude`, `projection_x_coordinate` ...) is neither, whatever its units are.
/// 2. The two variables of a pair have the same dimensions, or one dimension each. Bounds are no
///    coordinates.
/// 3. A pair listed by an attribute `coordinates` comes before others (axes with the dimensions of
///    such a pair only seem to be degrees); then come pairs with bounds, then axes, then pairs
///    whose dimensions other variables have, and last those that are not crossed, as ULONG and TLAT
///    are where there are TLONG and ULAT.
/// 4. The bounds are the variables that the attribute `bounds` names. Without that attribute they
///    are NAME_bnds, NAME_bounds, NAME_b, NAME_vertices, NAME_corners or corner_NAME, if both
///    coordinates have such variables.
///
/// \param remarks  gets a sentence for each attribute `bounds` that names no variable
/// \throws InvalidInput if the query names a variable that does not exist
RONDEL_API std::vector<CoordinatePair> find_coordinates(
    std::span<const VariableHeader> variables, const CoordinateQuery& query = {},
    std::vector<std::string>* remarks = nullptr);

/// Finds the pairs of coordinates that one variable may be at, the best first: the pairs that it is
/// a part of itself; or else those that its own attribute `coordinates` lists, or by UGRID its
/// `mesh` for its `location`; or else all pairs whose dimensions it has. Here vertices and edges of
/// MPAS and ICON count, too: `lonVertex`, `latEdge`, `vlon`, `elat` ...
/// \param variable  the index of the variable
/// \throws InvalidInput if there is no such variable
RONDEL_API std::vector<CoordinatePair> coordinates_of(std::span<const VariableHeader> variables,
                                                      std::size_t variable);
/// Does the same for several variables, in a time that grows with their number, and not with its
/// square.
/// \param wanted  the indices of the variables
/// \returns the pairs of each
/// \throws InvalidInput if there is no such variable
RONDEL_API std::vector<std::vector<CoordinatePair>> coordinates_of(
    std::span<const VariableHeader> variables, std::span<const std::size_t> wanted);

/// Tells which variables describe a mesh or a grid and are no fields: numbers of neighbors and
/// corners, coordinates of corners, edges and centers, and masks. It knows MPAS, ICON, UGRID (a
/// `mesh_topology`, what it names, and `cf_role`), SCRIP, ESMF, OASIS, Exodus, and pairs of NEMO such as
/// `glamu` and `gphiu`. Measures of quality are fields, and areas are are_measures_of_cells().
/// \returns true or false for each variable
RONDEL_API std::vector<bool> parts_of_grids(std::span<const VariableHeader> variables);

/// Tells which variables have the areas or volumes of cells, whose means are no areas of other cells:
/// those that an attribute `cell_measures` names, that have the standard_name `cell_area`, or that
/// models call so (`areaCell`, `areacello`, `TAREA`; `area` with units of areas).
/// \returns true or false for each variable
RONDEL_API std::vector<bool> are_measures_of_cells(std::span<const VariableHeader> variables);

/// Tells which variables have values that depend on place: those with a dimension of any longitudes
/// and latitudes, of the nodes, edges or faces of a mesh (by UGRID, or as MPAS, ICON, FESOM and FVCOM
/// call them), or of an axis x or y, as ROMS, WRF and MOM call staggered ones, too, or with one into
/// which `compress` has gathered some of these (CF 8.2); and those that say by `mesh` and `location`
/// that they are on a mesh.
/// \returns true or false for each variable
RONDEL_API std::vector<bool> are_at_places(std::span<const VariableHeader> variables);

/// How surely a variable has the numbers of those pixels of HEALPix that data are at.
enum class PixelList {
  none,     ///< it is something else
  unclear,  ///< integers without units or a meaning that is known
  named,    ///< its name says so, or it is the coordinate of its dimension
  stated    ///< its standard_name is `healpix_index` (CF 1.13)
};

/// Tells whether a variable may have the numbers of pixels, by its header:
///
/// 1. Such a variable has one dimension and numbers without units; another standard_name than
///    `healpix_index`, and flags, say that it has something else.
/// 2. Names that tools give it are `cell`, `pixel`, `pix`, `ipix`, `healpix` and `hpx`, in the plural
///    or with `id`, `index` or `number`, in any case of letters and with any underscores; a word
///    `ring` or `nest` in a name of integers says so, too, if it is the order of the pixels, and that
///    they are none if it is the other one.
/// \param is_ring  whether pixels are numbered ring by ring, and not nested
RONDEL_API PixelList pixel_list_of(const VariableHeader& variable, bool is_ring);

/// Reads numbers of a variable from one on, with NaN for missing ones.
using NumberReader =
    std::function<void(std::size_t variable, std::uint64_t begin, std::span<double> out)>;

/// Pixels of HEALPix that data are at.
struct PixelQuery {
  std::string grid;              ///< the name of the grid: `healpix:3:ring`
  std::uint64_t num_pixels = 0;  ///< those of the whole grid
  std::string mapping;           ///< the name of the variable that is the grid mapping, or empty
  NumberReader read;             ///< reads the numbers of variables that may list pixels
};

/// The numbers of pixels that a variable has.
struct NumberedPixels {
  std::size_t variable = 0;
  std::vector<Index> numbers;  ///< none if they are those of all pixels in order
};

/// Finds the variable with the numbers of the pixels that data are at.
///
/// 1. A variable that is stated to have them comes first, then one that is named so, along a dimension
///    of the data; then the coordinate of the dimension of pixels. This is as long as the grid has
///    pixels, or else the only one that all data have and that is not a time or another axis.
/// 2. The numbers of pixels differ. Those that count from another number than 0 in order are in the
///    order of the pixels.
/// 3. Where the data have no longitudes and latitudes and no other list is found, integers that are
///    unclear and might be numbers of pixels in another order are an error.
///
/// \returns nothing if no variable has them: the values are then at all pixels in order, or elsewhere
/// \throws InvalidInput for numbers of other pixels or of a pixel twice in a variable that is stated
///         or named, with its name and the number, and for unclear variables
RONDEL_API std::optional<NumberedPixels> numbered_pixels(std::span<const VariableHeader> variables,
                                                         const PixelQuery& query);

/// What a file says of a variable that is to be a component of vectors.
struct VectorComponent {
  std::string name;
  std::string standard_name;  ///< may be empty
  std::string units;          ///< may be empty
  bool has_flags = false;     ///< whether values stand for categories (CF 3.5)
};

/// Returns why two variables are not the eastward and the northward components of the same vectors, by
/// what their file says of them; an empty text if it says nothing against it.
///
/// 1. A standard_name says it that has no direction, another one, or that of a grid (`grid_eastward_wind`;
///    `x_wind`, unless the grid is along longitudes and latitudes); `eastward`, `zonal` and `u` are
///    directions to the east. A text without an underscore, as `unknown`, is no standard_name.
/// 2. Both standard_names differ in the direction alone.
/// 3. Both have the same units, in any spelling of their powers: `m s-1`, `m/s`, `m s**-1`.
/// 4. Neither has flags.
/// \param is_along_axes  whether the variables are on a grid along longitudes and latitudes
RONDEL_API std::string lack_of_vectors(const VectorComponent& east, const VectorComponent& north,
                                       bool is_along_axes);

/// True for an attribute that belongs to the places of a variable or a file, or to how numbers are
/// stored, so that values at other places do not have it: `coordinates`, `grid_mapping`, `mesh`,
/// `_FillValue` ...
RONDEL_API bool is_attribute_of_places(std::string_view name);

/// Returns a sentence if the longitudes or latitudes of a data set count from another meridian than that
/// of Greenwich (CF, appendix F): a variable with the dimensions of the coordinate has a `grid_mapping`
/// whose `longitude_of_prime_meridian` is not 0. Such places are refused; otherwise the text is empty.
/// \param coordinate  the name of the longitudes or latitudes
/// \param meridians  the names of the variables that have that attribute, and its numbers
RONDEL_API std::string remark_on_meridian(
    std::span<const VariableHeader> variables, std::string_view coordinate,
    std::span<const std::pair<std::string, double>> meridians);

/// True for an attribute that tells of the values of a field, so that a field of other values does not
/// have it: the type that they stand for (xarray's `dtype`), their range and number (`minimum`,
/// `valid_count` ...). Variables whose values stay as they are, such as axes, keep it.
RONDEL_API bool is_attribute_of_values(std::string_view name);

/// True for an attribute that says what values mean that stand for categories (CF, section 3.5):
/// `flag_values`, `flag_masks`, `flag_meanings`. Means of such values do not have it.
RONDEL_API bool is_attribute_of_flags(std::string_view name);

/// True for an attribute that names other variables, or dimensions, and that with_names() knows:
/// `coordinates`, `ancillary_variables`, `bounds`, `climatology`, `formula_terms`, `compress`.
RONDEL_API bool is_attribute_of_names(std::string_view attribute);

/// Returns an attribute that names other variables, as it holds where some of these have other names
/// or are missing. Of the lists `coordinates` and `ancillary_variables` it keeps the names that are
/// there; `bounds`, `climatology`, `formula_terms`, and `compress`, which names dimensions, hold if
/// all are there.
/// \param name_of  returns the name that a variable or dimension has there; an empty text if it is not
/// \returns an empty text if the attribute does not hold, and for one of another name
RONDEL_API std::string with_names(std::string_view attribute, const std::string& text,
                                  const std::function<std::string(const std::string&)>& name_of);

/// Tells whether the attributes of a file say that its mesh is in a plane, so that its longitudes
/// and latitudes mean nothing: `on_a_sphere = NO` of MPAS.
/// \param texts  the global attributes that are texts
RONDEL_API bool is_planar(std::span<const std::pair<std::string, std::string>> texts);

/// Returns the number of degrees in a unit of a coordinate, by its attribute `units`. A variable
/// without units gets those of variables for the same places: bounds have the units of their
/// coordinate (CF 7.1), and latitudes those of the longitudes. Otherwise the convention decides:
/// radians for the names of MPAS and ICON (`lonCell`, `latVertex`, `clon`, `vlat` ...), and degrees
/// for others.
/// \param relatives  variables whose units count if the variable has none; the first one with units
///                   decides. The first relative is of the same kind, such as the coordinate that
///                   bounds belong to; the units of the others are used without their direction
///                   (east, west, north, south). Null entries are ignored
/// \throws InvalidInput if the units are neither degrees nor radians, or the standard_name is that
///         of a rotated pole or a projection
RONDEL_API double degrees_per_unit(const VariableHeader& variable,
                                   std::span<const VariableHeader* const> relatives = {});

/// Returns which dimensions of coordinates with two or more dimensions do not count places, because
/// neither the longitudes nor the latitudes change along them, as Time in WRF's XLAT(Time,
/// south_north, west_east). A dimension of length 1 is one of them only if it is called time.
/// \param names  the names of the dimensions
/// \param shape  the lengths of the dimensions
/// \throws InvalidInput if the number of values is not that of the shape, or if places of three
///         dimensions or more move with time
RONDEL_API std::vector<bool> repeated_dimensions(std::span<const std::string> names,
                                                 std::span<const std::uint64_t> shape,
                                                 std::span<const double> lon,
                                                 std::span<const double> lat);

/// The dimensions of bounds of a coordinate, and those of the coordinate itself, by their names.
struct BoundsLayout {
  std::span<const std::string> dimensions;  ///< of the bounds
  std::span<const std::uint64_t> shape;     ///< the lengths of these
  std::span<const std::string> places;      ///< of the coordinate, along which places differ
  std::span<const std::uint64_t> lengths;   ///< the lengths of these
  std::span<const std::string> repeated;    ///< of the coordinate, along which places repeat
};

/// Returns which dimensions of bounds count no cells and no corners, because the bounds of all
/// cells only come again along them, as time in lat_bnds(time, lat, bnds), which joined files have.
/// \param values  the bounds, in the order of their dimensions
/// \throws InvalidInput if the number of values is not that of the shape, or if cells change along
///         such a dimension; its index is that of the dimension
RONDEL_API std::vector<bool> record_dimensions(const BoundsLayout& layout,
                                               std::span<const double> values);

/// True if the attribute `cell_methods` says that values are sums over cells, such as people per
/// cell, rather than densities: "area: sum", "lat: lon: sum". What was done last counts.
/// \param places  the names of the dimensions of places; usual ones are known
RONDEL_API bool are_sums_over_cells(std::string_view cell_methods,
                                    std::span<const std::string> places = {});

/// Returns the attribute `cell_methods` after a further method over the area of cells ("mean",
/// "sum"). It stays as it is if that method was the last one.
RONDEL_API std::string with_cell_method(std::string_view cell_methods, std::string_view method,
                                        std::span<const std::string> places = {});

/// True if variables are those of a mesh in a file of UGRID, SCRIP, ESMF, MPAS, ICON or Exodus.
RONDEL_API bool has_mesh(std::span<const VariableHeader> variables);

/// True if models give this name to the dimension of their cells (`nCells`, `ncol`, `cell` ...).
RONDEL_API bool is_name_of_cells(std::string_view dimension);

/// Returns the dimensions that may count cells: those that are as long and are called cells, or
/// else all that are as long, without times if there are several.
/// \param names  the names of the dimensions
/// \param lengths  by dimension
RONDEL_API std::vector<std::size_t> dimensions_of_cells(std::span<const std::string> names,
                                                        std::span<const std::uint64_t> lengths,
                                                        std::uint64_t num_cells);

/// True if two places, which may be from different files, are one: they are at most `max_apart_deg`
/// degrees apart in latitude, and along their parallel. A place that is missing (NaN) is the same
/// as any.
RONDEL_API bool is_same_place(const LonLat& a, const LonLat& b, double max_apart_deg);

/// True if the dimension has a usual name of time (`time`, `Time`, `record` ...).
RONDEL_API bool is_name_of_time(std::string_view dimension);

/// Returns the lines between the cells along an axis, in degrees: one more than cells. They come
/// from the two bounds of each cell (n, 2), or are the bounds themselves (n + 1), or, without
/// bounds, are half way between the coordinates.
///
/// 1. Coordinates and bounds ascend or descend throughout, and the two bounds of a cell may be in
///    either order. The lines have the order of the coordinates, even if bounds are given in reverse.
/// 2. Longitudes may jump by multiples of 360 degrees; unless they ascend or descend as they are,
///    each is at most 180 degrees from the one before it. If the last longitude is the first one
///    again, each of the two gets half of the cell. Of a single cell, the coordinate says from which
///    bound to which one it goes east, unless the bounds ascend by half a turn or less.
/// 3. Lines that go around the globe up to rounding are closed. Without bounds the first and the
///    last cell extend as far beyond their coordinate as before it, or to the pole if that is less
///    than a cell away. If the gap between the last and the first longitude is no wider than the
///    widest step, they end half way across it; with a step of more than half a turn only if they
///    would overlap.
///
/// \param values  the coordinates, in degrees
/// \param bounds  in degrees, or empty
/// \throws InvalidInput for less than two values without bounds, a number that is not finite, is out
///         of order or repeats the one before it (its index), another number of bounds, cells with a
///         gap between them or that overlap (the index of the second one), longitudes that go around
///         the globe more than once, a coordinate that is farther from the middle of its cell
///         than three halves of the cell's width, and a latitude or bound beyond a pole (its index)
RONDEL_API std::vector<double> axis_lines(std::span<const double> values,
                                          std::span<const double> bounds, bool is_longitude);

/// How far latitudes of files may be beyond a pole, which rounding to single precision explains: pi / 2
/// is then 90.0000025 degrees, and the number after 90 is 90.0000076.
inline constexpr double max_beyond_pole_deg = 1e-5;

/// Replaces latitudes in degrees that are at most `max_beyond_pole_deg` beyond a pole by that of the
/// pole.
/// \returns the index of the first latitude that is farther beyond, or the number of latitudes
RONDEL_API std::size_t clamp_at_poles(std::span<double> lat_deg);

/// An attribute that decides which numbers of a variable are missing and how they are unpacked:
/// `_FillValue`, `missing_value`, `valid_min`, `valid_max`, `valid_range`, `_Unsigned`,
/// `scale_factor`, `add_offset`.
struct ValueAttribute {
  std::string name;
  std::string type;  ///< NumPy's name of the type, "f4", "i2" ...; empty for a text
  std::string text;
  std::vector<double> numbers;
  /// Numbers of the types "i8" and "u8" exactly, those of "u8" as bits. May be empty.
  std::vector<std::int64_t> integers = {};
};

/// Replaces missing values by NaN, by the rules of read_fields(), among values that another reader
/// has already unpacked, in double or in single precision. Without `_FillValue`, the number that netCDF writes where no value was
/// written is missing as well.
/// \param type  NumPy's name of the type of the numbers in the file, "f4", "i2" ...
/// \throws InvalidInput for another type, and for a scale_factor or add_offset that is not one
///         number
RONDEL_API void mark_missing(std::span<double> values, std::string_view type,
                             std::span<const ValueAttribute> attributes);

/// Returns 64-bit integers of a file as the values that they are, by the rules of read_fields(): NaN
/// where they are missing, which is decided exactly.
/// \param integers  those of "u8" as bits
/// \param type  "i8" or "u8"
/// \throws InvalidInput for an integer that is neither missing nor a double, with its index, and as
///         mark_missing()
RONDEL_API std::vector<double> unpack_integers(std::span<const std::int64_t> integers,
                                               std::string_view type,
                                               std::span<const ValueAttribute> attributes);

}  // namespace rondel
