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

// A name that a file can have: a variable of a group has one with a slash.
std::string written_name(std::string name) {
  std::ranges::replace(name, '/', '_');
  return name;
}

// Without the values: the dimensions are those that are leading.
FieldArray array_of(const io::NetcdfReader& file, const ReadVariable& variable,
                    const std::vector<std::size_t>& leading) {
  FieldArray array;
  array.name = written_name(variable.name);
  for (const std::size_t d : leading) {
    array.dimensions.push_back(written_name(file.dimensions()[variable.dimensions[d]].name));
    array.shape.push_back(variable.shape[d]);
  }
  array.attributes = kept_attributes(variable);
  return array;
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

}  // namespace

FieldSlices::FieldSlices(const io::NetcdfReader& file, const FieldsToRead& wanted)
    : file_(file), layouts_(file, wanted.num_points, wanted.shape) {
  fields_.num_points = wanted.num_points;
  for (const std::string& name : wanted.names) {
    if (add(file.require(name))) continue;
    if (fields_.num_points != 0) refuse_shape(file, file.require(name), wanted);
    throw io::BadValue("no longitudes and latitudes of variable " + io::in_quotes(name));
  }
  if (wanted.names.empty()) add_all();
  if (fields_.arrays.empty()) {
    std::string why;
    for (const std::string& remark : fields_.remarks) why += "; " + remark;
    throw io::BadValue("no variable has " +
                       (fields_.num_points == 0 ? std::string("longitudes and latitudes")
                                                : std::to_string(fields_.num_points) + " points") +
                       why);
  }
  add_axes();
}

bool FieldSlices::add(const ReadVariable& variable) {
  std::optional<FieldDimensions> layout = layouts_.layout(variable);
  if (!layout) return false;
  io::ValueRules rules(variable);
  if (!rules.remark().empty()) fields_.remarks.push_back(rules.remark());
  if (layout->is_reversed) {
    fields_.remarks.push_back("variable " + io::in_quotes(variable.name) +
                              " has the lengths of the grid in reverse, and is taken so");
  }
  fields_.arrays.push_back(array_of(file_, variable, layout->leading));
  if (fields_.points.empty() && std::ranges::all_of(layout->places, is_place)) {
    fields_.points = unit_vectors(layout->places);
    fields_.positions = std::move(layout->places);
    for (const std::size_t d : layout->points) fields_.shape.push_back(variable.shape[d]);
  }
  if (fields_.num_points == 0) fields_.num_points = fields_.points.size();
  layout->places.clear();
  sources_.push_back({&variable, std::move(*layout), std::move(rules)});
  return true;
}

// All variables that are fields; of others those are told that are no coordinates.
void FieldSlices::add_all() {
  std::string left_out;
  std::size_t number = 0;
  constexpr std::size_t most = 5;
  for (const ReadVariable& variable : file_.variables()) {
    if (variable.shape.empty() || layouts_.is_auxiliary(variable)) continue;
    try {
      if (add(variable)) continue;
    } catch (const io::BadValue& bad) {
      fields_.remarks.emplace_back(std::string(bad.what()) + "; it is left out");
      continue;
    }
    if (++number <= most) left_out += (left_out.empty() ? "" : ", ") + variable.name;
  }
  if (number > most) left_out += " and " + std::to_string(number - most) + " more";
  if (number > 0) {
    fields_.remarks.push_back("left out, as they have no values at the points: " + left_out);
  }
}

// The coordinates along the dimensions that are not those of the points.
void FieldSlices::add_axes() {
  for (const SlicedVariable& source : sources_) {
    for (const std::size_t d : source.layout.leading) {
      const std::string& name = file_.dimensions()[source.variable->dimensions[d]].name;
      const ReadVariable* const variable = file_.find(name);
      const bool is_known =
          std::ranges::count(fields_.axes, written_name(name), &FieldArray::name) != 0;
      if (is_known || variable == nullptr || variable->type == NetcdfType::text ||
          variable->shape.size() != 1) {
        continue;
      }
      const io::ValueRules rules(*variable);
      if (!rules.remark().empty()) fields_.remarks.push_back(rules.remark());
      fields_.axes.push_back(array_of(file_, *variable, {0}));
      fields_.axes.back().values = file_.numbers(*variable);
      rules.apply(fields_.axes.back().values);
    }
  }
}

// Fields that are together in the file are read as they are; others block by block, a block being what the first
// dimension has at a place, or everything where that one is of the points.
void FieldSlices::read(std::size_t array, std::size_t first, std::span<double> out) const {
  const SlicedVariable& source = sources_[array];
  const ReadVariable& variable = *source.variable;
  const std::uint64_t n = fields_.num_points;
  if (std::ranges::is_sorted(source.layout.order())) {
    file_.read_numbers(variable, first * n, out);
    source.rules.apply(out);
    return;
  }
  const std::vector<std::size_t>& leading = source.layout.leading;
  const bool is_divided = !leading.empty() && leading.front() == 0;
  const std::uint64_t size =
      is_divided ? variable.num_values / variable.shape.front() : variable.num_values;
  for (std::uint64_t at = first * n; !out.empty();) {
    read_block(source, at / size, size);
    const std::uint64_t begin = at % size;
    const std::size_t count = std::min<std::uint64_t>(size - begin, out.size());
    std::copy_n(block_.begin() + static_cast<std::ptrdiff_t>(begin), count, out.begin());
    out = out.subspan(count);
    at += count;
  }
}

void FieldSlices::read_block(const SlicedVariable& source, std::uint64_t block,
                             std::uint64_t size) const {
  if (source_of_block_ == &source && number_of_block_ == block && !block_.empty()) return;
  source_of_block_ = &source;
  number_of_block_ = block;
  block_.resize(size);
  file_.read_numbers(*source.variable, block * size, block_);
  std::vector<std::uint64_t> shape = source.variable->shape;
  if (size < source.variable->num_values) shape.front() = 1;
  block_ = io::transposed(shape, source.layout.order(), std::move(block_));
  source.rules.apply(block_);
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
  // Whether the points are one after the other.
  [[nodiscard]] bool is_one_dimension() const { return !is_grid_ && side_.shape.size() <= 1; }
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

class NetcdfSink : public FieldSink {
 public:
  NetcdfSink(io::AtomicFile& file, const FieldsToWrite& job)
      : out_(file),
        points_(job.side, job.fields.num_points),
        columns_(points_.is_one_dimension() ? std::span(job.side.columns)
                                            : std::span<const Column>()) {
    define(job);
    out_.begin(job.netcdf);
    for (const FieldArray& axis : job.fields.axes) {
      out_.write(std::span<const double>(axis.values));
    }
    points_.write(out_);
    columns_.write(out_);
  }
  void write(std::span<const double> values) override { out_.write(values); }
  void finish() override { out_.finish(); }

 private:
  void define(const FieldsToWrite& job) {
    const FieldSet& fields = job.fields;
    out_.add_attribute("Conventions", "CF-1.8");
    std::vector<std::vector<std::size_t>> leading;
    for (const FieldArray& array : fields.arrays) {
      leading.emplace_back();
      for (std::size_t d = 0; d < array.shape.size(); ++d) {
        leading.back().push_back(dimension(array.dimensions[d], array.shape[d]));
      }
    }
    for (const FieldArray& axis : fields.axes) {
      out_.add_variable({axis.name,
                         NetcdfType::float64,
                         {dimension(axis.dimensions[0], axis.shape[0])},
                         with_attributes(axis)});
    }
    points_.define(out_);
    columns_.define(out_, points_.dimensions().front(), names_of_variables(job));
    for (std::size_t a = 0; a < leading.size(); ++a) {
      const FieldArray& array = fields.arrays[a];
      std::vector<std::size_t> dimensions = leading[a];
      dimensions.insert(dimensions.end(), points_.dimensions().begin(), points_.dimensions().end());
      std::vector<io::NetcdfAttribute> attributes = with_attributes(array);
      attributes.push_back(
          {"_FillValue", NetcdfType::float64, {}, {std::numeric_limits<double>::quiet_NaN()}});
      if (points_.needs_coordinates()) {
        attributes.push_back({"coordinates", NetcdfType::text, "lon lat", {}});
      }
      out_.add_variable({array.name, NetcdfType::float64, std::move(dimensions), attributes});
    }
  }

  // Of this name and length: two arrays may have one.
  std::size_t dimension(const std::string& name, std::uint64_t length) {
    for (std::size_t k = 0; k < known_.size(); ++k) {
      if (known_[k].first == name && known_[k].second == length) return numbers_[k];
    }
    known_.emplace_back(name, length);
    numbers_.push_back(out_.add_dimension(name, length));
    return numbers_.back();
  }

  io::NetcdfWriter out_;
  PointsOut points_;
  ColumnsOut columns_;
  std::vector<std::pair<std::string, std::uint64_t>> known_;
  std::vector<std::size_t> numbers_;
};

}  // namespace

std::unique_ptr<FieldSink> begin_fields_netcdf(io::AtomicFile& file, const FieldsToWrite& job) {
  return std::make_unique<NetcdfSink>(file, job);
}

}  // namespace rondel::interpolation
