// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Decides which dimension of a grid has the longitudes where a file lacks the coordinates of its
// points (rule 4 of field_layout.h). The lengths do not say it if they are equal; names of
// dimensions and single axes do. orient() compares these with the wanted places, and reverses the
// dimensions of points if rows and columns are swapped.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/field_layout.h"
#include "io/bad_value.h"
#include "io/number.h"

namespace rondel::formats {
namespace {

// Returns the longitude or the latitude of a place in degrees.
double coordinate_of(const LonLat& place, CoordinateKind kind) {
  return kind == CoordinateKind::lon ? place.lon_deg : place.lat_deg;
}

// True if two coordinates of one kind differ by at most `max_apart_deg`. Missing numbers fit all
// others.
bool is_near_deg(double a, double b, CoordinateKind kind, double max_apart_deg) {
  const double away = kind == CoordinateKind::lon ? std::remainder(a - b, 360) : a - b;
  return !(std::abs(away) > max_apart_deg);
}

// True for names that models give to the dimensions of grids, whose columns follow each other eastward and
// rows northward: ROMS (xi_rho), WRF (west_east), rotated poles (rlon), cubed spheres (Xdim, grid_xt).
bool is_name_of_rows_or_columns(std::string_view name, CoordinateKind kind) {
  constexpr std::array<std::string_view, 6> columns = {"x", "nx", "xc", "rlon", "xdim", "grid_xt"};
  constexpr std::array<std::string_view, 6> rows = {"y", "ny", "yc", "rlat", "ydim", "grid_yt"};
  const bool is_lon = kind == CoordinateKind::lon;
  const std::string lower = lower_case(name);
  return std::ranges::count(is_lon ? columns : rows, lower) > 0 ||
         lower.starts_with(is_lon ? "xi_" : "eta_") ||
         lower.starts_with(is_lon ? "west_east" : "south_north");
}

// Returns longitudes for latitudes and latitudes for longitudes.
CoordinateKind other_kind(CoordinateKind kind) {
  return kind == CoordinateKind::lat ? CoordinateKind::lon : CoordinateKind::lat;
}

}  // namespace

// The places of a grid along one of its two dimensions: index i has place i * step, and those that
// follow it in steps of `across`.
struct FieldDimensionFinder::PlacesAlong {
  std::size_t length;
  std::size_t step;
  std::size_t across;
  std::size_t num_across;
};

// True if the coordinate depends on the index along the line alone.
bool FieldDimensionFinder::changes_along(const PlacesAlong& line, CoordinateKind kind) const {
  for (std::size_t i = 0; i < line.length; ++i) {
    const double first = coordinate_of(wanted_.positions[i * line.step], kind);
    for (std::size_t k = 1; k < line.num_across; ++k) {
      const LonLat& place = wanted_.positions[i * line.step + k * line.across];
      if (!is_near_deg(coordinate_of(place, kind), first, kind, wanted_.max_apart_deg)) {
        return false;
      }
    }
  }
  return true;
}

// Returns the axis along the dimension, and which coordinate it is; without an axis the dimension's
// name may say it.
FieldDimensionFinder::NamedDirection FieldDimensionFinder::direction_of(
    std::size_t dimension) const {
  const std::string& name = file_.dimensions()[dimension].name;
  for (const CoordinateKind kind : {CoordinateKind::lon, CoordinateKind::lat}) {
    for (std::size_t v = 0; v < headers_.size(); ++v) {
      const VariableHeader& header = headers_[v];
      if (header.dimensions.size() == 1 && header.dimensions[0] == name &&
          coordinate_evidence(header, kind) > 0) {
        return {kind, &file_.variables()[v]};
      }
    }
  }
  for (const CoordinateKind kind : {CoordinateKind::lon, CoordinateKind::lat}) {
    const std::size_t slash = name.rfind('/');
    const std::string own = slash == std::string::npos ? name : name.substr(slash + 1);
    if (is_name_of_rows_or_columns(own, kind) || is_known_name(own, kind)) return {kind, nullptr};
  }
  return {};
}

// True if the axis has the coordinates of the wanted places along the line.
bool FieldDimensionFinder::fits_line(const NamedDirection& direction,
                                     const PlacesAlong& line) const {
  if (direction.axis == nullptr || direction.axis->num_values != line.length) return true;
  std::vector<double> degrees;
  try {
    degrees = degrees_of(file_, *direction.axis);
  } catch (const io::BadValue&) {
    return true;  // no coordinates
  }
  for (std::size_t i = 0; i < line.length; ++i) {
    const double wanted = coordinate_of(wanted_.positions[i * line.step], *direction.kind);
    if (!is_near_deg(degrees[i], wanted, *direction.kind, wanted_.max_apart_deg)) return false;
  }
  return true;
}

// Returns the coordinate that changes from row to row, if the wanted places are a grid of so many
// rows.
std::optional<CoordinateKind> FieldDimensionFinder::kind_of_rows(std::size_t rows,
                                                                 std::size_t columns) const {
  const PlacesAlong down{rows, columns, 1, columns};
  const PlacesAlong right{columns, 1, columns, rows};
  for (const CoordinateKind kind : {CoordinateKind::lat, CoordinateKind::lon}) {
    if (changes_along(down, kind) && changes_along(right, other_kind(kind))) return kind;
  }
  return std::nullopt;
}

// Says that nothing tells rows from columns.
std::string FieldDimensionFinder::remark_on_order(const io::VariableInFile& variable,
                                                  std::size_t rows, std::size_t columns) const {
  const auto name_of = [&](std::size_t d) {
    return io::in_quotes(file_.dimensions()[variable.dimensions[d]].name);
  };
  return "variable " + io::in_quotes(variable.name) + ": nothing says which of the dimensions " +
         name_of(rows) + " and " + name_of(columns) +
         " has the longitudes: they are taken in this order";
}

// Puts the dimensions of a grid of faces with as many rows as columns, as of a cubed sphere, in the
// order of the grid: faces, rows, columns.
void FieldDimensionFinder::orient_faces(const io::VariableInFile& variable,
                                        std::span<const std::size_t> places,
                                        FieldDimensions& layout) const {
  std::array<std::size_t, 3> order{};  // of `places`
  std::array<int, 3> counts{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto kind = direction_of(variable.dimensions[places[k]]).kind;
    const std::size_t at = !kind ? 0 : (*kind == CoordinateKind::lat ? 1 : 2);
    order.at(at) = places[k];
    ++counts.at(at);
  }
  const auto length = [&](std::size_t d) { return variable.shape[d]; };
  const bool is_named = counts == std::array{1, 1, 1} && length(order[0]) == length(places[0]);
  if (!is_named) {
    layout.remark = remark_on_order(variable, places[1], places[2]);
    return;
  }
  layout.is_reversed = false;  // names say the order, whatever it is
  auto next = order.begin();
  for (std::size_t& d : layout.points) {
    if (length(d) > 1) d = *next++;
  }
}

bool FieldDimensionFinder::orient(const io::VariableInFile& variable, FieldDimensions& layout) {
  std::vector<std::size_t> places;
  for (const std::size_t d : layout.points) {
    if (variable.shape[d] > 1) places.push_back(d);
  }
  if (places.size() == 3 && shape_.size() > 1 &&
      variable.shape[places[1]] == variable.shape[places[2]]) {
    orient_faces(variable, places, layout);
  }
  // Only two dimensions that are longer than 1 can be taken in the wrong order otherwise.
  if (places.size() != 2) return true;
  std::size_t rows = variable.shape[places[0]];
  std::size_t columns = variable.shape[places[1]];
  NamedDirection first = direction_of(variable.dimensions[places[0]]);
  NamedDirection second = direction_of(variable.dimensions[places[1]]);
  const bool are_known = wanted_.positions.size() == rows * columns;
  const bool has_lengths = shape_.size() > 1;
  // The longitudes of places change fastest where nothing says otherwise, as in every format.
  std::optional<CoordinateKind> of_rows = CoordinateKind::lat;
  if (are_known) of_rows = kind_of_rows(rows, columns);
  const bool are_named = first.kind != second.kind;  // one of them, or both and differently
  bool is_turned = false;
  bool is_decided = has_lengths && rows != columns;
  if (!is_decided && are_known && rows != columns) {
    if (!of_rows) {
      of_rows = kind_of_rows(columns, rows);
      is_turned = of_rows.has_value();
    }
    is_decided = of_rows.has_value();
  } else if (!is_decided && of_rows && are_named) {
    is_turned = first.kind ? *first.kind != *of_rows : *second.kind == *of_rows;
    is_decided = true;
  }
  if (!is_decided) {
    layout.remark = remark_on_order(variable, places[0], places[1]);
  }
  // From here on rows, columns and both directions are in the order of the points.
  if (is_turned) {
    std::ranges::reverse(layout.points);
    std::swap(rows, columns);
    std::swap(first, second);
  }
  if (!are_known || !of_rows) return true;
  const PlacesAlong down{rows, columns, 1, columns};
  const PlacesAlong right{columns, 1, columns, rows};
  for (const auto& [direction, line, kind] :
       {std::tuple(first, down, *of_rows), std::tuple(second, right, other_kind(*of_rows))}) {
    if (direction.kind != kind || fits_line(direction, line)) continue;
    why_not_ = "has " + io::in_quotes(direction.axis->name) +
               ", which is not the axis of the places that are wanted";
    return false;
  }
  return true;
}

}  // namespace rondel::formats
