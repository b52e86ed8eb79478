// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// FieldSet in netCDF with the CF conventions.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "interpolation/field_columns.h"
#include "interpolation/field_formats.h"
#include "interpolation/field_layout.h"
#include "interpolation/weight_formats.h"
#include "io/bad_value.h"
#include "io/cf_reader.h"
#include "io/cf_values.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_writer.h"
#include "io/number.h"
#include "rondel/delaunay.h"

namespace rondel::interpolation {
namespace {

using io::NetcdfType;
using ReadVariable = io::NetcdfReader::Variable;

// What a field still is at other points.
std::vector<std::pair<std::string, std::string>> kept_attributes(const ReadVariable& variable) {
  std::vector<std::pair<std::string, std::string>> kept;
  for (const io::NetcdfAttribute& attribute : variable.attributes) {
    for (const char* name :
         {"units", "long_name", "standard_name", "calendar", "positive", "axis"}) {
      if (attribute.name == name && !attribute.text.empty()) {
        kept.emplace_back(name, attribute.text);
      }
    }
  }
  return kept;
}

// The numbers of a variable, those of its dimensions first that are `leading`, then the others.
FieldArray array_of(const io::NetcdfReader& file, const ReadVariable& variable,
                    const FieldDimensions& layout, std::vector<std::string>& remarks) {
  const io::ValueRules rules(variable);
  if (!rules.remark().empty()) remarks.push_back(rules.remark());
  if (layout.is_reversed) {
    remarks.push_back("variable " + io::in_quotes(variable.name) +
                      " has the lengths of the grid in reverse, and is taken so");
  }
  FieldArray array;
  array.name = variable.name;
  for (const std::size_t d : layout.leading) {
    array.dimensions.push_back(file.dimensions()[variable.dimensions[d]].name);
    array.shape.push_back(variable.shape[d]);
  }
  array.values = io::transposed(variable.shape, layout.order(), file.numbers(variable));
  rules.apply(array.values);
  array.attributes = kept_attributes(variable);
  return array;
}

// The coordinates along the dimensions in front of that of the points.
void add_axes(const io::NetcdfReader& file, FieldSet& fields) {
  for (const FieldArray& array : fields.arrays) {
    for (const std::string& name : array.dimensions) {
      const ReadVariable* const variable = file.find(name);
      const bool is_known = std::ranges::count(fields.axes, name, &FieldArray::name) != 0;
      if (is_known || variable == nullptr || variable->type == NetcdfType::text ||
          variable->shape.size() != 1) {
        continue;
      }
      fields.axes.push_back(array_of(file, *variable, {{0}, {}, {}, false}, fields.remarks));
    }
  }
}

bool is_place(const LonLat& place) {
  return std::abs(place.lon_deg) <= 1e6 && std::abs(place.lat_deg) <= 90;
}

[[noreturn]] void refuse_shape(const io::NetcdfReader& file, const ReadVariable& variable,
                               const FieldsToRead& wanted) {
  std::string lengths;
  for (std::size_t d = 0; d < variable.shape.size(); ++d) {
    lengths += (d == 0 ? "" : ", ") + file.dimensions()[variable.dimensions[d]].name + " " +
               std::to_string(variable.shape[d]);
  }
  std::string grid;
  for (const std::uint64_t length : wanted.shape) {
    grid += (grid.empty() ? " on a grid of " : " x ") + std::to_string(length);
  }
  throw io::BadValue("no dimensions of variable " + io::in_quotes(variable.name) + " (" + lengths +
                     ") have the " + std::to_string(wanted.num_points) + " points" + grid);
}

// All variables that are fields; of others those are told that are no coordinates.
template <class Add>
void add_all(const io::NetcdfReader& file, const FieldDimensionFinder& layouts, const Add& add,
             std::vector<std::string>& remarks) {
  std::string left_out;
  std::size_t number = 0;
  constexpr std::size_t most = 5;
  for (const ReadVariable& variable : file.variables()) {
    if (variable.shape.empty() || layouts.is_auxiliary(variable)) continue;
    try {
      if (add(variable)) continue;
    } catch (const io::BadValue& bad) {
      remarks.emplace_back(std::string(bad.what()) + "; it is left out");
      continue;
    }
    if (++number <= most) left_out += (left_out.empty() ? "" : ", ") + variable.name;
  }
  if (number > most) left_out += " and " + std::to_string(number - most) + " more";
  if (number > 0) {
    remarks.push_back("left out, as they have no values at the points: " + left_out);
  }
}

}  // namespace

FieldSet read_fields_netcdf(std::string_view bytes, const FieldsToRead& wanted) {
  const io::NetcdfReader file(bytes);
  FieldSet fields;
  fields.num_points = wanted.num_points;
  FieldDimensionFinder layouts(file, wanted.num_points, wanted.shape);
  const auto add = [&](const ReadVariable& variable) {
    const std::optional<FieldDimensions> layout = layouts.layout(variable);
    if (!layout) return false;
    fields.arrays.push_back(array_of(file, variable, *layout, fields.remarks));
    if (fields.points.empty() && std::ranges::all_of(layout->places, is_place)) {
      fields.points = unit_vectors(layout->places);
    }
    return true;
  };
  for (const std::string& name : wanted.names) {
    if (!add(file.require(name))) refuse_shape(file, file.require(name), wanted);
  }
  if (wanted.names.empty()) add_all(file, layouts, add, fields.remarks);
  if (fields.arrays.empty()) {
    std::string why;
    for (const std::string& remark : fields.remarks) why += "; " + remark;
    throw io::BadValue("no variable has " + std::to_string(wanted.num_points) + " points" + why);
  }
  add_axes(file, fields);
  return fields;
}

namespace {

std::vector<io::NetcdfAttribute> with_attributes(const FieldArray& array) {
  std::vector<io::NetcdfAttribute> attributes;
  for (const auto& [name, text] : array.attributes) {
    attributes.push_back({name, NetcdfType::text, text, {}});
  }
  return attributes;
}

// The points of a side as a grid, or one after the other.
class PointsOut {
 public:
  PointsOut(const WeightSide& side, std::size_t num_points) : side_(side) {
    const std::vector<LonLat>& points = side.points;
    is_grid_ = side.shape.size() == 2 && !points.empty();
    const std::size_t row = is_grid_ ? side.shape[1] : 1;
    for (std::size_t i = 0; is_grid_ && i < points.size(); ++i) {
      is_grid_ = points[i].lon_deg == points[i % row].lon_deg &&
                 points[i].lat_deg == points[i - i % row].lat_deg;
    }
    num_lon_ = is_grid_ ? row : num_points;
    num_points_ = num_points;
  }

  // Defines dimensions and coordinates.
  void define(io::NetcdfWriter& out) {
    if (is_grid_) {
      dimensions_ = {out.add_dimension("lat", side_.shape[0]), out.add_dimension("lon", num_lon_)};
    } else if (side_.shape.size() > 1) {
      for (std::size_t d = 0; d < side_.shape.size(); ++d) {
        dimensions_.push_back(out.add_dimension("axis_" + std::to_string(d), side_.shape[d]));
      }
    } else {
      dimensions_ = {out.add_dimension("point", num_points_)};
    }
    if (side_.points.empty()) return;
    const auto of = [&](std::size_t d) {
      return is_grid_ ? std::vector<std::size_t>{dimensions_[d]} : dimensions_;
    };
    out.add_variable(variable("lat", NetcdfType::float64, of(0),
                              {{"units", "degrees_north"}, {"standard_name", "latitude"}}));
    out.add_variable(variable("lon", NetcdfType::float64, of(1),
                              {{"units", "degrees_east"}, {"standard_name", "longitude"}}));
  }
  void write(io::NetcdfWriter& out) const {
    if (side_.points.empty()) return;
    const std::size_t step = is_grid_ ? num_lon_ : 1;
    out.write_values<double>(is_grid_ ? side_.shape[0] : num_points_,
                             [&](std::size_t i) { return side_.points[i * step].lat_deg; });
    out.write_values<double>(num_lon_, [&](std::size_t i) { return side_.points[i].lon_deg; });
  }
  [[nodiscard]] const std::vector<std::size_t>& dimensions() const { return dimensions_; }
  [[nodiscard]] bool needs_coordinates() const { return !is_grid_ && !side_.points.empty(); }

 private:
  const WeightSide& side_;
  bool is_grid_ = false;
  std::size_t num_lon_ = 0;
  std::size_t num_points_ = 0;
  std::vector<std::size_t> dimensions_;
};

std::set<std::string> names_of_variables(const FieldsToWrite& job) {
  std::set<std::string> names = {"lat", "lon", "point"};
  for (const FieldArray& array : job.fields.arrays) {
    names.insert(array.name);
    names.insert(array.dimensions.begin(), array.dimensions.end());
  }
  for (const FieldArray& axis : job.fields.axes) names.insert(axis.name);
  return names;
}

}  // namespace

void write_fields_netcdf(io::AtomicFile& file, const FieldsToWrite& job) {
  io::NetcdfWriter out(file);
  PointsOut points(job.side, job.fields.num_points);
  out.add_attribute("Conventions", "CF-1.8");
  // Dimensions by name and length: two arrays may have one.
  std::vector<std::pair<std::string, std::uint64_t>> known;
  std::vector<std::size_t> numbers;
  const auto dimension = [&](const std::string& name, std::uint64_t length) {
    for (std::size_t k = 0; k < known.size(); ++k) {
      if (known[k].first == name && known[k].second == length) return numbers[k];
    }
    known.emplace_back(name, length);
    numbers.push_back(out.add_dimension(name, length));
    return numbers.back();
  };
  std::vector<std::vector<std::size_t>> leading;
  for (const FieldArray& array : job.fields.arrays) {
    leading.emplace_back();
    for (std::size_t d = 0; d < array.shape.size(); ++d) {
      leading.back().push_back(dimension(array.dimensions[d], array.shape[d]));
    }
  }
  for (const FieldArray& axis : job.fields.axes) {
    out.add_variable({axis.name,
                      NetcdfType::float64,
                      {dimension(axis.dimensions[0], axis.shape[0])},
                      with_attributes(axis)});
  }
  points.define(out);
  const bool has_columns = points.dimensions().size() == 1;
  ColumnsOut columns(has_columns ? std::span(job.side.columns) : std::span<const Column>());
  columns.define(out, points.dimensions().front(), names_of_variables(job));
  for (std::size_t a = 0; a < leading.size(); ++a) {
    const FieldArray& array = job.fields.arrays[a];
    std::vector<std::size_t> dimensions = leading[a];
    dimensions.insert(dimensions.end(), points.dimensions().begin(), points.dimensions().end());
    std::vector<io::NetcdfAttribute> attributes = with_attributes(array);
    attributes.push_back(
        {"_FillValue", NetcdfType::float64, {}, {std::numeric_limits<double>::quiet_NaN()}});
    if (points.needs_coordinates()) {
      attributes.push_back({"coordinates", NetcdfType::text, "lon lat", {}});
    }
    out.add_variable({array.name, NetcdfType::float64, std::move(dimensions), attributes});
  }
  out.begin();
  for (const FieldArray& axis : job.fields.axes) out.write(std::span<const double>(axis.values));
  points.write(out);
  columns.write(out);
  for (const FieldArray& array : job.fields.arrays) {
    out.write(std::span<const double>(array.values));
  }
  out.finish();
}

}  // namespace rondel::interpolation
