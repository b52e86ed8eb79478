// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes a FieldSet as netCDF by the CF conventions: leading dimensions with their coordinates (CF
// section 5), the places of the points as `lat` and `lon`, with the bounds of their cells where they
// are known, then each array with its attributes, `_FillValue`, and `coordinates` where the points are no grid along axes.
#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "formats/cf_values.h"
#include "formats/field_columns.h"
#include "formats/field_formats.h"
#include "formats/weight_formats.h"
#include "formats/written_names.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_writer.h"
#include "io/number.h"

namespace rondel::formats {
namespace {

using io::NetcdfType;

NetcdfType type_of(const FieldArray& array) {
  return array.is_single ? NetcdfType::float32 : NetcdfType::float64;
}

// The attribute of variables, and of files, that lists coordinates.
constexpr std::string_view listed_coordinates = "coordinates";

// Adds attributes that are numbers, but for those whose name another one has.
void add_numbers(const std::vector<NumericAttribute>& numbers,
                 std::vector<io::NetcdfAttribute>& attributes) {
  for (const NumericAttribute& attribute : numbers) {
    if (io::find_attribute(attributes, attribute.name) != nullptr) continue;
    attributes.push_back({attribute.name, type_named(attribute.type), {}, attribute.numbers});
  }
}

// Returns the attributes of an array, as netCDF has them.
std::vector<io::NetcdfAttribute> with_attributes(const FieldArray& array) {
  std::vector<io::NetcdfAttribute> attributes;
  for (const auto& [name, text] : array.attributes) {
    attributes.push_back({name, NetcdfType::text, text, {}});
  }
  add_numbers(array.numbers, attributes);
  return attributes;
}

// Adds longitudes and latitudes to the coordinates that an array has already, such as a height.
void add_places(std::vector<io::NetcdfAttribute>& attributes) {
  const auto known = std::ranges::find(attributes, "coordinates", &io::NetcdfAttribute::name);
  if (known == attributes.end()) {
    attributes.push_back({"coordinates", NetcdfType::text, "lon lat", {}});
  } else {
    known->text.insert(0, "lon lat ");
  }
}

// Writes the points of a side, as a longitude-latitude grid or as a list, and the bounds of their
// cells (CF section 7.1).
class PointsOut {
 public:
  // The points are written as a grid if the shape has two dimensions and the places are those of a
  // latitude for each row and a longitude for each column, unless they have corners, which may be
  // those of other cells than the ones between parallels.
  PointsOut(const WeightSide& side, const FieldSet& fields)
      : side_(side), dimension_(fields.dimension) {
    const std::vector<LonLat>& points = side.points;
    has_axes_ = !side.axes.lon_deg.empty();
    has_corners_ = side.has_bounds && !side.corners.empty();
    is_grid_ = !has_corners_ && side.shape.size() == 2 && (has_axes_ || !points.empty());
    const std::size_t row = is_grid_ ? side.shape[1] : 1;
    for (std::size_t i = 0; is_grid_ && i < points.size(); ++i) {
      is_grid_ = points[i].lon_deg == points[i % row].lon_deg &&
                 points[i].lat_deg == points[i - i % row].lat_deg;
    }
    num_lon_ = is_grid_ ? row : fields.num_points;
    num_points_ = fields.num_points;
  }

  // Returns the names that its dimensions and coordinates take.
  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> names;
    if (has_places()) names = {"lat", "lon"};
    for (const std::string name : {"lat", "lon"}) {
      if (num_bounds(name) > 0) names.insert(name + bounds_ending);
    }
    if (is_grid_) return names;
    if (side_.shape.size() <= 1) {
      names.insert(dimension_);
    } else {
      for (std::size_t d = 0; d < side_.shape.size(); ++d) names.insert(name_of_axis(d));
    }
    return names;
  }
  // Defines dimensions and coordinates. `dimension(name, length)` returns the number of a dimension
  // that other variables may have, too.
  template <typename Dimension>
  void define(io::NetcdfWriter& out, Dimension dimension) {
    if (is_grid_) {
      dimensions_ = {out.add_dimension("lat", side_.shape[0]), out.add_dimension("lon", num_lon_)};
    } else if (side_.shape.size() > 1) {
      for (std::size_t d = 0; d < side_.shape.size(); ++d) {
        dimensions_.push_back(out.add_dimension(name_of_axis(d), side_.shape[d]));
      }
    } else {
      dimensions_ = {out.add_dimension(dimension_, num_points_)};
    }
    if (!has_places()) return;
    const auto of = [&](std::size_t d) {
      return is_grid_ ? std::vector<std::size_t>{dimensions_[d]} : dimensions_;
    };
    io::NetcdfVariable lat = variable("lat", NetcdfType::float64, of(0),
                                      {{"units", "degrees_north"}, {"standard_name", "latitude"}});
    io::NetcdfVariable lon = variable("lon", NetcdfType::float64, of(1),
                                      {{"units", "degrees_east"}, {"standard_name", "longitude"}});
    std::vector<io::NetcdfVariable> bounds;
    for (io::NetcdfVariable* const coordinate : {&lat, &lon}) {
      const std::size_t number = num_bounds(coordinate->name);
      if (number == 0) continue;
      std::vector<std::size_t> dimensions = coordinate->dimensions;
      dimensions.push_back(dimension(has_corners_ ? "nv" : "bnds", number));
      bounds.push_back(
          variable(coordinate->name + bounds_ending, NetcdfType::float64, std::move(dimensions)));
      coordinate->attributes.push_back({"bounds", NetcdfType::text, bounds.back().name, {}});
    }
    out.add_variable(std::move(lat));
    out.add_variable(std::move(lon));
    for (io::NetcdfVariable& each : bounds) out.add_variable(std::move(each));
  }
  // Writes the coordinates and bounds, in the order of define().
  void write(io::NetcdfWriter& out) const {
    if (!has_places()) return;
    if (has_axes_) {
      out.write(std::span<const double>(side_.axes.lat_deg));
      out.write(std::span<const double>(side_.axes.lon_deg));
      for (const std::vector<double>* const lines : {&side_.lines.lat_deg, &side_.lines.lon_deg}) {
        if (lines->empty()) continue;
        out.write_values<double>(2 * (lines->size() - 1),
                                 [&](std::size_t k) { return (*lines)[k / 2 + k % 2]; });
      }
      return;
    }
    const std::size_t step = is_grid_ ? num_lon_ : 1;
    out.write_values<double>(is_grid_ ? side_.shape[0] : num_points_,
                             [&](std::size_t i) { return side_.points[i * step].lat_deg; });
    out.write_values<double>(num_lon_, [&](std::size_t i) { return side_.points[i].lon_deg; });
    if (!has_corners_) return;
    const std::vector<LonLat>& corners = side_.corners;
    out.write_values<double>(corners.size(), [&](std::size_t k) { return corners[k].lat_deg; });
    out.write_values<double>(corners.size(), [&](std::size_t k) { return corners[k].lon_deg; });
  }
  // Returns the numbers of the dimensions of the points, after define().
  [[nodiscard]] const std::vector<std::size_t>& dimensions() const { return dimensions_; }
  // True if the points are a list, not a grid.
  [[nodiscard]] bool is_one_dimension() const { return !is_grid_ && side_.shape.size() <= 1; }
  // True if variables need the attribute `coordinates`, as the names of dimensions do not say it.
  [[nodiscard]] bool needs_coordinates() const { return !is_grid_ && !side_.points.empty(); }

 private:
  // Returns the name of a dimension of curvilinear places: y and x, of a cubed sphere behind its tiles.
  [[nodiscard]] std::string name_of_axis(std::size_t d) const {
    constexpr std::array<const char*, 3> names = {"tile", "y", "x"};
    const std::size_t rank = side_.shape.size();
    return rank <= names.size() ? names[names.size() - rank + d] : "axis_" + std::to_string(d);
  }
  [[nodiscard]] bool has_places() const { return has_axes_ || !side_.points.empty(); }
  // Returns how many bounds each number of the coordinate `lat` or `lon` has, or 0.
  [[nodiscard]] std::size_t num_bounds(std::string_view coordinate) const {
    if (has_corners_) return side_.corners.size() / num_points_;
    const LonLatGrid& lines = side_.lines;
    return !has_axes_ || (coordinate == "lat" ? lines.lat_deg : lines.lon_deg).empty() ? 0 : 2;
  }

  static constexpr const char* bounds_ending = "_bnds";

  const WeightSide& side_;
  const std::string& dimension_;
  bool has_axes_ = false;
  bool is_grid_ = false;
  bool has_corners_ = false;
  std::size_t num_lon_ = 0;
  std::size_t num_points_ = 0;
  std::vector<std::size_t> dimensions_;
};

// Writes the header and the coordinates at once, and the values as they come.
class NetcdfSink : public FieldSink {
 public:
  // Columns are texts along one dimension, so a grid of points has none.
  NetcdfSink(io::AtomicFile& file, const FieldsToWrite& job)
      : out_(file),
        points_(job.side, job.fields),
        columns_(points_.is_one_dimension() ? std::span(job.side.columns)
                                            : std::span<const Column>()) {
    define(job);
    out_.begin(job.netcdf, job.threads);
    for (const FieldArray& axis : job.fields.axes) {
      out_.write(std::span<const double>(axis.values));
    }
    for (const FieldArray& other : job.fields.others) {
      if (other.is_text) {
        out_.write(std::span<const char>(other.characters));
      } else {
        out_.write(std::span<const double>(other.values));
      }
    }
    points_.write(out_);
    columns_.write(out_);
  }
  void write(std::span<const double> values) override {
    while (!values.empty()) {
      if (sizes_.front().left == 0) {
        sizes_.pop_front();
        continue;
      }
      const std::size_t count = std::min<std::uint64_t>(values.size(), sizes_.front().left);
      const std::span<const double> part = values.first(count);
      if (sizes_.front().is_single) {
        out_.write_values<float>(count, [&](std::size_t i) { return part[i]; });
      } else {
        out_.write(part);
      }
      sizes_.front().left -= count;
      values = values.subspan(count);
    }
  }
  void finish() override { out_.finish(); }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    std::vector<std::string> remarks = out_.remarks();
    if (!renamed_.empty())
      remarks.push_back("what describes places gave way to fields: " + renamed_);
    if (!shortened_.empty()) {
      remarks.push_back("names of more than " + std::to_string(max_bytes_of_name) +
                        " bytes are shortened: " + shortened_);
    }
    return remarks;
  }

 private:
  // Defines dimensions, axes, places, columns and arrays, each with a name that is still free.
  void define(const FieldsToWrite& job) {
    const FieldSet& fields = job.fields;
    unlimited_ = fields.unlimited;
    out_.add_attribute("Conventions", "CF-1.8");
    for (const auto& [name, text] : fields.attributes) {
      if (name != "Conventions" && name != listed_coordinates) out_.add_attribute(name, text);
    }
    for (const NumericAttribute& attribute : fields.numbers) {
      if (io::find_attribute(out_.attributes(), attribute.name) != nullptr) continue;
      out_.add_attribute({attribute.name, type_named(attribute.type), {}, attribute.numbers});
    }
    taken_ = points_.names();
    // Attributes name variables that may come later, so names and dimensions are chosen first.
    std::vector<std::vector<std::size_t>> leading;
    for (const FieldArray& array : fields.arrays) leading.push_back(dimensions_of(array));
    for (const FieldArray& axis : fields.axes) {
      own_names_.emplace(axis.name, dimension(axis.dimensions[0], axis.shape[0]).own_name);
    }
    std::vector<io::NetcdfVariable> others;
    for (const FieldArray& other : fields.others) {
      others.push_back(variable({}, other.is_text ? NetcdfType::text : NetcdfType::float64,
                                dimensions_of(other)));
      // Labels along a dimension of their name share the name with it, as axes do.
      const bool is_label =
          other.is_text && !other.dimensions.empty() && other.dimensions.front() == other.name;
      others.back().name = is_label ? dimension(other.name, other.shape.front()).own_name
                                    : take_name(netcdf_name(other.name), taken_);
      own_names_.emplace(other.name, others.back().name);
    }
    const std::vector<std::string> names = take_names(fields);
    for (std::size_t a = 0; a < leading.size(); ++a) {
      own_names_.emplace(fields.arrays[a].name, names[a]);
    }
    for (const auto& [name, text] : fields.attributes) {
      const std::string listed =
          name == listed_coordinates ? with_names(name, text, names_here()) : std::string();
      if (!listed.empty()) out_.add_attribute(name, listed);
    }
    for (const FieldArray& axis : fields.axes) {
      const LeadingDimension& along = dimension(axis.dimensions[0], axis.shape[0]);
      out_.add_variable(
          {along.own_name, NetcdfType::float64, {along.number}, with_own_names(axis)});
    }
    for (std::size_t k = 0; k < others.size(); ++k) {
      others[k].attributes = with_own_names(fields.others[k]);
      out_.add_variable(std::move(others[k]));
    }
    points_.define(out_, [this](const char* name, std::uint64_t length) {
      return dimension(name, length).number;
    });
    define_values(fields, leading, names);
  }

  // Takes the names of the arrays and the columns.
  std::vector<std::string> take_names(const FieldSet& fields) {
    std::vector<VariableHeader> headers;
    for (const FieldArray& array : fields.arrays) {
      std::vector<io::NetcdfAttribute> attributes = with_attributes(array);
      remove_marks_of_coordinates(attributes);
      headers.push_back(header_with(netcdf_name(array.name), attributes));
    }
    const std::vector<VariableHeader> of_columns = columns_.headers();
    headers.insert(headers.end(), of_columns.begin(), of_columns.end());
    std::vector<std::string> names = take_names_of_fields(std::move(headers), taken_);
    for (std::size_t c = 0; c < of_columns.size(); ++c) {
      const std::string& name = names[fields.arrays.size() + c];
      // Properties of polygons and columns of tables give way without a word.
      if (name == of_columns[c].name || !columns_.has_attributes(c)) continue;
      renamed_ += (renamed_.empty() ? "" : ", ") + of_columns[c].name + " is " + name;
    }
    for (const FieldArray& array : fields.arrays) note_length(array.name);
    for (std::size_t c = 0; c < of_columns.size(); ++c) note_length(columns_.name(c));
    return names;
  }

  // Keeps the beginning of a name that is too long for netCDF, for a remark.
  void note_length(const std::string& name) {
    if (name.size() <= max_bytes_of_name) return;
    shortened_ += (shortened_.empty() ? "" : ", ") + io::in_quotes(name);
  }

  // Defines the arrays and the columns. `leading` has the dimensions of each array before those of
  // the points, and `names` the names of all.
  void define_values(const FieldSet& fields, const std::vector<std::vector<std::size_t>>& leading,
                     const std::vector<std::string>& names) {
    columns_.define(out_, points_.dimensions().front(), std::span(names).subspan(leading.size()),
                    taken_);
    for (std::size_t a = 0; a < leading.size(); ++a) {
      const FieldArray& array = fields.arrays[a];
      std::vector<std::size_t> dimensions = leading[a];
      dimensions.insert(dimensions.end(), points_.dimensions().begin(), points_.dimensions().end());
      std::vector<io::NetcdfAttribute> attributes = with_own_names(array);
      remove_marks_of_coordinates(attributes);
      if (fields.is_fill_marked) {
        attributes.push_back({"_FillValue", type_of(array), {}, {fields.fill}});
      }
      if (points_.needs_coordinates()) add_places(attributes);
      out_.add_variable({names[a], type_of(array), std::move(dimensions), attributes});
      sizes_.push_back({array.num_fields() * fields.num_points, array.is_single});
    }
  }

  // Returns what gives the names here of variables of the set, which are empty if there are none.
  [[nodiscard]] std::function<std::string(const std::string&)> names_here() const {
    return [this](const std::string& name) {
      const auto known = own_names_.find(name);
      return known == own_names_.end() ? std::string() : known->second;
    };
  }

  // Returns the attributes of an array, in which variables and dimensions have the names that they
  // get here. Those that name others are left out. Names in attributes are those of variables of the
  // set, so statistics of fields come without the names of fields.
  std::vector<io::NetcdfAttribute> with_own_names(const FieldArray& array) {
    const auto dimension_here = [&](const std::string& name) {
      const auto known = known_.lower_bound({name, 0});
      const bool is_there = known != known_.end() && known->first.first == name;
      return is_there ? known->second.own_name : std::string();
    };
    std::vector<io::NetcdfAttribute> attributes;
    for (io::NetcdfAttribute& attribute : with_attributes(array)) {
      if (is_attribute_of_names(attribute.name)) {
        attribute.text = attribute.name == "compress"
                             ? with_names(attribute.name, attribute.text, dimension_here)
                             : with_names(attribute.name, attribute.text, names_here());
        if (attribute.text.empty()) continue;
      }
      attributes.push_back(std::move(attribute));
    }
    return attributes;
  }

  // Returns the numbers of the dimensions of an array, but for those of the points.
  std::vector<std::size_t> dimensions_of(const FieldArray& array) {
    std::vector<std::size_t> numbers;
    for (std::size_t d = 0; d < array.shape.size(); ++d) {
      numbers.push_back(dimension(array.dimensions[d], array.shape[d]).number);
    }
    return numbers;
  }

  // A dimension of the file that is not one of the points.
  struct LeadingDimension {
    std::string own_name;  // differs from its name in the source where that is taken
    std::size_t number = 0;
  };

  // Returns the dimension of this name and length; two arrays may have dimensions of one name and
  // different lengths.
  const LeadingDimension& dimension(const std::string& name, std::uint64_t length) {
    const auto [at, is_new] = known_.try_emplace({name, length});
    if (!is_new) return at->second;
    at->second.own_name = take_name(netcdf_name(name), taken_);
    const bool is_unlimited = std::ranges::count(unlimited_, name) != 0;
    at->second.number = out_.add_dimension(at->second.own_name, length, is_unlimited);
    return at->second;
  }

  // The values of an array that are still to come.
  struct ValuesToCome {
    std::uint64_t left;
    bool is_single;
  };

  io::NetcdfWriter out_;
  std::deque<ValuesToCome> sizes_;
  PointsOut points_;
  ColumnsOut columns_;
  // Names of variables and dimensions that are in use.
  std::set<std::string> taken_;
  // The names that axes, arrays and others get, by the names that they have in the set.
  std::map<std::string, std::string, std::less<>> own_names_;
  // The dimensions, by their names and lengths in the source.
  std::map<std::pair<std::string, std::uint64_t>, LeadingDimension> known_;
  std::vector<std::string> unlimited_;  // names of dimensions that may grow
  std::string shortened_;               // names that are too long for netCDF, in quotes
  std::string renamed_;                 // what describes places and got other names, in words
};

}  // namespace

std::unique_ptr<FieldSink> begin_fields_netcdf(io::AtomicFile& file, const FieldsToWrite& job) {
  return std::make_unique<NetcdfSink>(file, job);
}

}  // namespace rondel::formats
