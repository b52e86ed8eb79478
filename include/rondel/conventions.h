// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The reading of the Climate and Forecast conventions (CF 1.11) and of their relatives: where the values of a file are, and what its
/// numbers stand for (target rondel::io). The readers of files, the tool and the Python package share it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rondel/export.h"

namespace rondel {

/// The header of a variable of a file or a data set: all of it but the values.
struct VariableHeader {
  std::string name;
  bool is_number = true;
  std::vector<std::string> dimensions;                     ///< the last one changes fastest
  std::vector<std::uint64_t> shape;                        ///< the lengths of the dimensions
  std::vector<std::pair<std::string, std::string>> texts;  ///< the attributes that are texts

  /// The attribute of this name; empty if there is none.
  [[nodiscard]] RONDEL_API std::string text(std::string_view attribute) const;
};

/// Returns the number of degrees in a unit of an angle, by its spelling: UDUNITS's names for degrees (`degree`, `degrees_north`, `degreeE`,
/// `arcdeg` ..., those of west being negative), radians (`radian`, `rad`), and parts of both. Names may have any case, but
/// not the symbols `rad` and `°`. `deg`, which UDUNITS does not know, is read as degrees.
/// \returns nothing for what is no angle, and for an empty text.
RONDEL_API std::optional<double> degrees_per_unit(std::string_view units);

/// A longitude and a latitude of the same places, and the variables with the corners or sides of their cells.
struct CoordinatePair {
  static constexpr std::size_t none = ~std::size_t{0};

  std::size_t lon = none;  ///< indices of the variables
  std::size_t lat = none;
  std::size_t lon_bounds = none;
  std::size_t lat_bounds = none;
  bool are_axes = false;  ///< both have one dimension: the places are all pairs
  bool is_used = false;   ///< another variable has all of their dimensions
  /// Grows with what the variables say of themselves; of two pairs the one with the higher rank comes first.
  int rank = 0;
};

/// The coordinates that are looked for.
struct CoordinateQuery {
  std::string lon;     ///< the name of the longitudes; empty: found
  std::string lat;     ///< the name of the latitudes; empty: found
  std::string values;  ///< a variable, of which only the coordinates are wanted; empty: of all
};

/// The pairs of coordinates, best first; those of equal rank in the order of the variables.
///
/// 1. Longitudes have the standard_name `longitude`, units such as `degrees_east` (CF 4.1, 4.2), or _CoordinateAxisType `Lon`;
///    else the names that models use, as `lon`, `nav_lon`, `TLONG`, `XLONG`, `clon`, unless units or standard_name deny it.
///    Latitudes likewise.
/// 2. A pair has the same dimensions, or one dimension each. Bounds are not coordinates.
/// 3. A pair that an attribute `coordinates` lists comes before others (axes with the dimensions of such a pair only pretend to be
///    degrees), then one with bounds, then axes, then one with whose dimensions there are other variables.
/// 4. Bounds are what the attribute `bounds` names or, if that is not there, NAME_bnds, NAME_bounds, NAME_b, NAME_vertices,
///    NAME_corners, corner_NAME, if both have them.
///
/// \param remarks  gets a sentence for each attribute `bounds` that names nothing
/// \throws InvalidInput if the query names a variable that is not there
RONDEL_API std::vector<CoordinatePair> find_coordinates(
    std::span<const VariableHeader> variables, const CoordinateQuery& query = {},
    std::vector<std::string>* remarks = nullptr);

/// Returns the number of degrees in a unit of this coordinate, by its attribute `units`. Without one the convention decides: radians for the
/// names of MPAS and ICON (`lonCell`, `latVertex`, `clon`, `vlat` ...), degrees for others. But first what belongs to the same places
/// is asked: bounds without units have those of their coordinate (CF 7.1), and latitudes those of the longitudes.
/// \param relatives  variables whose units it has, if it has none: those of the first one that has any. The first is of the same kind,
///                   as the coordinate that bounds belong to; of the others the unit has no direction. Null: there is no such one
/// \throws InvalidInput if the units are neither degrees nor radians
RONDEL_API double degrees_per_unit(const VariableHeader& variable,
                                   std::span<const VariableHeader* const> relatives = {});

/// Tells which dimensions of coordinates of two or more dimensions hold no places, because neither the longitudes nor the latitudes
/// change along them, as in WRF's XLAT(Time, south_north, west_east). A dimension of length 1 is one of them only if it is called time.
/// \param names  of the dimensions
/// \throws InvalidInput if the values are not as many as the shape says, or if places of three dimensions or more move with time
RONDEL_API std::vector<bool> repeated_dimensions(std::span<const std::string> names,
                                                 std::span<const std::uint64_t> shape,
                                                 std::span<const double> lon,
                                                 std::span<const double> lat);

/// The lines between cells along one axis, in degrees, from the two bounds of each cell (n, 2) or the lines themselves (n + 1), or,
/// where there are none, half way between the coordinates.
///
/// 1. Coordinates and bounds may increase or decrease; bounds are in either order. The lines have the order of the coordinates,
///    also where they are given in reverse.
/// 2. Longitudes may jump by whole turns. Where the last one is the first one again, each of the two has half of the cell.
/// 3. Lines around the globe that miss it by rounding are closed. Without bounds the first and the last cell are as wide beyond as
///    before their coordinate, or end at the pole if that is less than a cell away.
///
/// \param values  of the axis, in degrees
/// \param bounds  in degrees, or none
/// \throws InvalidInput for less than two values without bounds, what is not finite (its index), another number of bounds,
///         cells that leave a gap (the index of the second one), and a coordinate that is farther from the middle of its cell than
///         three halves of its width (its index)
RONDEL_API std::vector<double> axis_lines(std::span<const double> values,
                                          std::span<const double> bounds, bool is_longitude);

/// An attribute of a variable that tells which numbers are missing: `_FillValue`, `missing_value`, `valid_min`, `valid_max`,
/// `valid_range`, `_Unsigned`, `scale_factor`, `add_offset`.
struct ValueAttribute {
  std::string name;
  std::string type;  ///< of NumPy, "f4", "i2" ...; empty: a text
  std::string text;
  std::vector<double> numbers;
};

/// Makes NaN of the missing among values that another reader has already unpacked, by the rules of read_fields(). Without
/// `_FillValue` the number that netCDF writes where nobody wrote is missing, too.
/// \param type  that of the numbers in the file, "f4", "i2" ...
/// \throws InvalidInput for another type, and for a scale_factor or add_offset that is not one number
RONDEL_API void mark_missing(std::span<double> values, std::string_view type,
                             std::span<const ValueAttribute> attributes);

}  // namespace rondel
