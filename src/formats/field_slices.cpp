// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads a FieldSet from netCDF by the CF conventions. The constructor finds the variables that are
// fields and the dimensions of their points (field_layout.h), and says in remarks which ones it
// leaves out. read() gets values by blocks (field_blocks.h), unpacks them (cf_values.h), and leaves
// out points without a place.
#include "formats/field_slices.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/cf_values.h"
#include "formats/field_choice.h"
#include "io/bad_value.h"
#include "io/netcdf_groups.h"
#include "io/number.h"
#include "io/wide_integers.h"
#include "rondel/delaunay.h"
#include "system/checked_product.h"
#include "system/message_text.h"
#include "system/parallel.h"
#include "system/wide_vectors.h"

namespace rondel::formats {
namespace {

// True if an attribute says how numbers are stored in a file. A text may say so, too.
bool is_of_storage(std::string_view name) {
  constexpr std::array<std::string_view, 5> names = {"scale_factor", "add_offset", "valid_min",
                                                     "valid_max", "valid_range"};
  return std::ranges::find(names, name) != names.end();
}

// Attributes belong to one of these. An array without points keeps its values: an axis, for example.
enum class AttributesOf : std::uint8_t { file, field, array_without_points };

// True if an attribute does not hold for values at other points.
bool is_lost(std::string_view name, AttributesOf of) {
  if (is_of_storage(name)) return true;
  if (of == AttributesOf::array_without_points && is_attribute_of_values(name)) return false;
  return is_attribute_of_places(name) ||
         (of == AttributesOf::field && is_attribute_of_values(name));
}

// Returns the texts that still hold for values at other points; they may be empty.
std::vector<std::pair<std::string, std::string>> kept_attributes(
    std::span<const io::NetcdfAttribute> attributes, AttributesOf of) {
  std::vector<std::pair<std::string, std::string>> kept;
  for (const io::NetcdfAttribute& attribute : attributes) {
    if (is_lost(attribute.name, of)) continue;
    const bool is_text = attribute.type == io::NetcdfType::text;
    if (is_text) kept.emplace_back(attribute.name, attribute.text);
  }
  return kept;
}

bool are_doubles(const io::NetcdfAttribute& attribute) {
  return std::ranges::all_of(attribute.integers, [&](std::int64_t integer) {
    return io::is_double(integer, attribute.type);
  });
}

// Returns the numbers that still hold. Integers of 64 bits are left out if they are no doubles.
std::vector<NumericAttribute> kept_numbers(std::span<const io::NetcdfAttribute> attributes,
                                           AttributesOf of) {
  std::vector<NumericAttribute> kept;
  for (const io::NetcdfAttribute& attribute : attributes) {
    const std::string& name = attribute.name;
    if (!is_lost(name, of) && are_doubles(attribute) && !attribute.numbers.empty()) {
      kept.push_back({name, attribute.numbers, std::string(name_of(attribute.type))});
    }
  }
  return kept;
}

// Returns a factor of packed numbers; `otherwise` if it is not there, or no number.
double packing_of(const io::NetcdfVariable& variable, std::string_view name, double otherwise) {
  const io::NetcdfAttribute* const attribute = io::find_attribute(variable.attributes, name);
  return attribute == nullptr || attribute->numbers.size() != 1 ? otherwise
                                                                : attribute->numbers.front();
}

// True if floats hold the values of a variable: it has floats, or small integers that floats still
// tell apart when they are unpacked.
bool is_of_floats(const io::NetcdfVariable& variable) {
  if (variable.type == io::NetcdfType::float32) return true;
  if (io::size_of(variable.type) >= 4) return false;
  const double step = std::abs(packing_of(variable, "scale_factor", 1));
  const double most = std::ldexp(step, static_cast<int>(8 * io::size_of(variable.type))) +
                      std::abs(packing_of(variable, "add_offset", 0));
  constexpr double precision = 0x1p-24;
  return most <= std::numeric_limits<float>::max() && step >= precision * most &&
         step >= std::numeric_limits<float>::min();
}

// The most values or characters of a variable that is kept beside the fields.
constexpr std::uint64_t most_of_other = std::uint64_t{1} << 20U;

// Returns strings in one text, `length` characters for each; zero bytes fill up what is shorter.
std::string padded(const std::vector<std::string>& strings, std::size_t length) {
  std::string text;
  text.reserve(strings.size() * length);
  for (const std::string& string : strings) {
    text += string;
    text.append(length - string.size(), '\0');
  }
  return text;
}

// Returns a name that a file can have: the name of a variable of a group has a slash.
std::string written_name(std::string name) {
  std::ranges::replace(name, '/', '_');
  return name;
}

// Returns the array without values; its dimensions are the leading ones. It is that of an axis, or of another
// variable without points, unless it is `at_points`.
FieldArray array_of(const io::NetcdfReader& file, const io::VariableInFile& variable,
                    const std::vector<std::size_t>& leading, bool at_points = false) {
  FieldArray array;
  array.name = written_name(variable.name);
  for (const std::size_t d : leading) {
    array.dimensions.push_back(written_name(file.dimensions()[variable.dimensions[d]].name));
    array.shape.push_back(variable.shape[d]);
  }
  const auto of = at_points ? AttributesOf::field : AttributesOf::array_without_points;
  array.attributes = kept_attributes(variable.attributes, of);
  array.numbers = kept_numbers(variable.attributes, of);
  array.is_single = is_of_floats(variable);
  return array;
}

// True if the numbers are a longitude, which may be some turns away, and a latitude.
bool is_place(const LonLat& place) {
  return std::abs(place.lon_deg) <= 1e6 && std::abs(place.lat_deg) <= 90;
}

// Throws BadValue for the first point of the variable that is no place.
void require_places(const io::VariableInFile& variable, const PlaceList& places) {
  const std::size_t bad = places.first_not(is_place);
  if (bad == places.size()) return;
  throw io::BadValue("place " + std::to_string(bad) + " of variable " +
                     io::in_quotes(variable.name) + " is at longitude " +
                     system::shortest_text(places[bad].lon_deg) + " and latitude " +
                     system::shortest_text(places[bad].lat_deg) + ", which is no place");
}

// Throws BadValue that names the lengths of a variable in which the points are not found.
[[noreturn]] void refuse_shape(const io::NetcdfReader& file, const io::VariableInFile& variable,
                               const FieldsToRead& wanted, std::size_t num_points) {
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
                     ") have the " + std::to_string(num_points) + " points" + grid);
}

}  // namespace

FieldSlices::FieldSlices(const io::NetcdfReader& file, const FieldsToRead& wanted,
                         std::size_t max_per_block)
    : file_(file),
      extras_(wanted.extras),
      max_per_block_(max_per_block),
      are_all_wanted_(wanted.names.empty()),
      layouts_(file, wanted, variables_to_read(file, wanted.names)) {
  fields_.num_points = wanted.num_points;
  fields_.attributes = kept_attributes(file.attributes(), AttributesOf::file);
  fields_.numbers = kept_numbers(file.attributes(), AttributesOf::file);
  for (const io::NetcdfDimension& dimension : file.dimensions()) {
    if (dimension.is_unlimited) fields_.unlimited.push_back(written_name(dimension.name));
  }
  if (extras_.has_others) tell_of_attributes(file.attributes(), "of the file");
  for (const std::string& given : wanted.names) {
    const std::string name = io::full_name(file.variables(), given);
    const io::VariableInFile* const variable = file.find(name);
    if (variable == nullptr ? add_one_of_several(name) : add(*variable)) continue;
    // For a name that is no variable this throws; others are no fields, for one of the reasons
    // below.
    const io::VariableInFile& named = file.require(name);
    if (named.type == io::NetcdfType::text) {
      throw io::BadValue("variable " + io::in_quotes(name) + " is a text, and no field");
    }
    if (!layouts_.why_not().empty()) {
      throw io::BadValue("variable " + io::in_quotes(name) + " " + layouts_.why_not());
    }
    if (fields_.num_points != 0) refuse_shape(file, named, wanted, fields_.num_points);
    throw io::BadValue("no longitudes and latitudes of variable " + io::in_quotes(named.name) +
                       remark_on_units(headers_of(file)));
  }
  require_distinct(wanted.names);
  wanted.names.empty() ? add_all() : keep_named();
  name_variables();
  if (fields_.arrays.empty()) {
    std::string why;
    if (fields_.num_points == 0) why = remark_on_units(headers_of(file));
    for (const std::string& remark : fields_.remarks) why += "; " + remark;
    const std::string number = std::to_string(fields_.num_points);
    throw io::BadValue("no variable " +
                       (!first_elsewhere_.empty() ? "is at the " + number + " wanted places"
                        : fields_.num_points == 0 ? "has longitudes and latitudes"
                                                  : "has " + number + " points") +
                       why);
  }
  const bool are_chosen = !wanted.names.empty() || !wanted.places.positions.empty();
  if (!are_chosen) fields_.remark_on_grids = layouts_.remark_on_grids();
}

// The name of a variable of a group is written with an underscore, which names it, too.
std::optional<std::size_t> FieldSlices::find(const std::string& name) const {
  const std::string full = io::full_name(file_.variables(), name);
  for (std::size_t a = 0; a < sources_.size(); ++a) {
    const bool is_whole = fields_.arrays[a].name == written_name(sources_[a].variable->name);
    if (is_whole && sources_[a].variable->name == full) return a;
  }
  const auto found = std::ranges::find(fields_.arrays, name, &FieldArray::name);
  if (found != fields_.arrays.end()) {
    return static_cast<std::size_t>(found - fields_.arrays.begin());
  }
  io::require_one_group(file_.variables(), name);
  return std::nullopt;
}

// Two names may mean one field, such as "tas[0]" and "tas_2001-07-15".
void FieldSlices::require_distinct(std::span<const std::string> names) const {
  for (std::size_t k = 1; k < names.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      if (sources_[j].variable != sources_[k].variable) continue;
      const std::size_t end_j = sources_[j].first + fields_.arrays[j].num_fields();
      const std::size_t end_k = sources_[k].first + fields_.arrays[k].num_fields();
      if (sources_[j].first >= end_k || sources_[k].first >= end_j) continue;
      const bool is_same = sources_[j].first == sources_[k].first && end_j == end_k;
      throw io::BadValue(io::in_quotes(names[j]) + " and " + io::in_quotes(names[k]) +
                         (is_same ? " are the same field" : " have a field in common"));
    }
  }
}

bool FieldSlices::add(const io::VariableInFile& variable) {
  std::optional<FieldDimensions> layout = layouts_.layout(variable);
  if (!layout) return false;
  add_with_layout(variable, std::move(*layout));
  add_axes(variable, sources_.back().layout.leading, fields_.axes);
  return true;
}

// Adds one field of several: "tas[3]" is field 3 of variable tas, "tas_2001-07-15" the field that
// has this name as a column of a table. Returns false if the name means no field.
bool FieldSlices::add_one_of_several(const std::string& name) {
  for (const io::VariableInFile* const variable : meant_variables(file_, name)) {
    std::optional<FieldDimensions> layout = layouts_.layout(*variable);
    if (!layout || layout->leading.empty()) continue;
    std::vector<FieldArray> axes;
    add_axes(*variable, layout->leading, axes);
    FieldArray several = array_of(file_, *variable, layout->leading, true);
    several.name = variable->name;
    const std::vector<std::string> names = names_of_fields(several, axes);
    const std::string rest = name.substr(variable->name.size());
    const std::size_t number =
        rest.starts_with('[')
            ? number_of_field(several, rest)
            : static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (number == names.size()) continue;
    add_with_layout(*variable, std::move(*layout));
    sources_.back().first = number;
    FieldArray& array = fields_.arrays.back();
    array.name = written_name(names[number]);
    array.dimensions.clear();
    array.shape.clear();
    return true;
  }
  return false;
}

void FieldSlices::add_with_layout(const io::VariableInFile& variable, FieldDimensions layout) {
  file_.require_room(variable);
  ValueRules rules(variable);
  if (!rules.remark().empty()) fields_.remarks.push_back(rules.remark());
  if (!layout.remark.empty()) fields_.remarks.push_back(layout.remark);
  if (layout.is_reversed) {
    fields_.remarks.push_back("variable " + io::in_quotes(variable.name) +
                              " has the lengths of the grid in reverse, and is taken so");
  }
  std::size_t num_points = 1;
  for (const std::size_t d : layout.points) num_points *= variable.shape[d];
  if (fields_.num_points == 0 || !layout.kept.empty()) require_places(variable, layout.places);
  fields_.arrays.push_back(array_of(file_, variable, layout.leading, true));
  tell_of_attributes(variable.attributes, "of variable " + io::in_quotes(variable.name));
  // All arrays are at the places of the first one that has some.
  if (fields_.shape.empty() && fields_.points.empty() &&
      layout.places.first_not(is_place) == layout.places.size()) {
    if (extras_.has_positions) {
      fields_.positions = layout.places.list();
      fields_.points = unit_vectors(fields_.positions);
    }
    if (layout.kept.empty()) {
      for (const std::size_t d : layout.points) fields_.shape.push_back(variable.shape[d]);
    } else {
      fields_.num_without_place = num_points - layout.kept.size();
    }
    if (fields_.num_points == 0) fields_.num_points = layout.places.size();
  }
  layout.places = {};
  for (const std::size_t d : layout.points) {
    if (variable.shape[d] > 1) dimensions_of_points_.insert(variable.dimensions[d]);
  }
  for (const std::size_t d : layout.leading) leading_dimensions_.insert(variable.dimensions[d]);
  dimensions_of_fields_.insert(variable.dimensions.begin(), variable.dimensions.end());
  FieldBlocks blocks(file_, variable, layout, max_per_block_);
  sources_.push_back(
      {&variable, num_points, std::move(layout), std::move(blocks), std::move(rules), 0});
}

// Adds all variables that are fields, and reports the others unless they are coordinates.
void FieldSlices::add_all() {
  std::vector<ApartVariable> apart;
  std::vector<const io::VariableInFile*> axes;
  NameList elsewhere;
  NameList measures;
  std::vector<std::string> refused;
  for (const io::VariableInFile& variable : file_.variables()) {
    if (layouts_.is_lost(variable)) apart.push_back({&variable, true});
    if (layouts_.is_plain_axis(variable)) axes.push_back(&variable);
    if (layouts_.is_measure_of_cells(variable)) measures.add(variable.name);
    if (variable.shape.empty() || layouts_.is_auxiliary(variable)) continue;
    try {
      if (add(variable)) continue;
    } catch (const SeveralReadings&) {
      throw;
    } catch (const io::BadValue& bad) {
      if (std::ranges::count(refused, bad.what()) == 0) refused.emplace_back(bad.what());
      continue;
    }
    if (layouts_.other_places().empty()) {
      // A variable at places of another number is no axis, nor bounds of one.
      apart.push_back({&variable, layouts_.why_not().empty()});
    } else {
      elsewhere.add(variable.name + " (" + layouts_.other_places() + ")");
      if (first_elsewhere_.empty()) first_elsewhere_ = layouts_.first_other();
    }
  }
  for (const std::string& why : refused) {
    fields_.remarks.push_back(why + (fields_.arrays.empty() ? "" : "; it is left out"));
  }
  if (!file_.passed_over().empty()) {
    NameList unread;
    for (const std::string& name : file_.passed_over()) unread.add(name);
    fields_.remarks.push_back("left out, as their types are those that the file defines itself: " +
                              unread.text());
  }
  if (!measures.text().empty()) {
    fields_.remarks.push_back("left out, as they are areas or volumes of cells: " +
                              measures.text());
  }
  for (const io::VariableInFile* const axis : axes) {
    const bool is_known =
        std::ranges::count(fields_.axes, written_name(axis->name), &FieldArray::name) != 0;
    if (!is_known && !depends_on_place(*axis)) apart.push_back({axis, true});
  }
  keep_others(apart);
  if (elsewhere.text().empty()) return;
  const std::string names = layouts_.names_of_places();
  fields_.remarks.push_back("left out, as they are at other places than " +
                            (names.empty() ? "those that are wanted" : names) + ": " +
                            elsewhere.text() +
                            (first_elsewhere_.empty() ? "" : "; " + first_elsewhere_));
}

// All fields are known here, and with them the dimensions of the points. A variable with some of
// these, or at other places, would be wrong beside values at new points.
void FieldSlices::keep_others(std::span<const ApartVariable> apart) {
  NameList without_points;
  NameList gathered;
  NameList texts;
  NameList large;
  NameList unknown;
  for (const ApartVariable& other : apart) {
    const io::VariableInFile& variable = *other.variable;
    const bool may_be_kept = other.may_be_kept && !depends_on_place(variable);
    if (may_be_kept && keep_other(variable)) {
      const std::string dimension = unknown_dimension(variable);
      if (!dimension.empty()) unknown.add(variable.name + " (" + dimension + ")");
    } else if (may_be_kept && extras_.has_others) {
      large.add(variable.name);
    } else if (!may_be_kept && variable.type == io::NetcdfType::text) {
      texts.add(variable.name);
    } else if (!may_be_kept && !gathered_dimension(variable).empty()) {
      gathered.add(variable.name + " (" + gathered_dimension(variable) + ")");
    } else {
      without_points.add(variable.name);
    }
  }
  const auto tell = [this](const std::string& why, const NameList& names) {
    if (!names.text().empty()) fields_.remarks.push_back("left out, as they " + why + names.text());
  };
  tell("have no values at the points: ", without_points);
  tell("are compressed by gathering: ", gathered);
  tell("are texts of places: ", texts);
  tell("have no values at the points and more than " + std::to_string(most_of_other) +
           " of their own: ",
       large);
  if (!unknown.text().empty()) {
    fields_.remarks.push_back("copied, as nothing says that their dimensions count places: " +
                              unknown.text());
  }
}

bool FieldSlices::depends_on_place(const io::VariableInFile& variable) const {
  return layouts_.is_at_places(variable) ||
         std::ranges::any_of(variable.dimensions, [&](std::size_t dimension) {
           return dimensions_of_points_.contains(dimension);
         });
}

// Fields have the dimension, too, or it has an axis, or it is that of the two bounds of a cell.
std::string FieldSlices::unknown_dimension(const io::VariableInFile& variable) const {
  const bool has_characters = variable.type == io::NetcdfType::text && !variable.has_strings;
  for (std::size_t d = 0; d + (has_characters ? 1 : 0) < variable.shape.size(); ++d) {
    const std::size_t dimension = variable.dimensions[d];
    const std::string& name = file_.dimensions()[dimension].name;
    const bool is_of_fields = dimensions_of_fields_.contains(dimension);
    if (variable.shape[d] > 2 && !is_of_fields && file_.find(name) == nullptr) return name;
  }
  return {};
}

std::string FieldSlices::gathered_dimension(const io::VariableInFile& variable) const {
  for (const std::size_t dimension : variable.dimensions) {
    const std::string& name = file_.dimensions()[dimension].name;
    const io::VariableInFile* const index = file_.find(name);
    if (index != nullptr && !io::netcdf_text(index->attributes, "compress").empty()) return name;
  }
  return {};
}

bool FieldSlices::keep_other(const io::VariableInFile& variable) {
  if (!extras_.has_others || variable.num_values > most_of_other) return false;
  if (variable.type == io::NetcdfType::text) return keep_text(variable);
  std::vector<std::size_t> all(variable.shape.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (layouts_.is_plain_axis(variable)) {
    add_axes(variable, all, fields_.axes);
    return true;
  }
  FieldArray array = array_of(file_, variable, all);
  bool is_rounded = false;
  array.values = file_.rounded_numbers(variable, is_rounded);
  if (is_rounded) tell_of_rounding(variable);
  ValueRules(variable).apply(array.values);
  fields_.others.push_back(std::move(array));
  tell_of_attributes(variable.attributes, "of variable " + io::in_quotes(variable.name));
  add_axes(variable, all, fields_.axes);
  return true;
}

void FieldSlices::tell_of_attributes(std::span<const io::NetcdfAttribute> attributes,
                                     const std::string& whose) {
  for (const io::NetcdfAttribute& attribute : attributes) {
    if (are_doubles(attribute)) continue;
    fields_.remarks.push_back("attribute " + io::in_quotes(attribute.name) + " " + whose +
                              " has integers that are no doubles; it is left out");
  }
}

void FieldSlices::tell_of_rounding(const io::VariableInFile& variable) {
  fields_.remarks.push_back("variable " + io::in_quotes(variable.name) +
                            " has integers that are no doubles, which are rounded");
}

// Strings become texts of one length.
bool FieldSlices::keep_text(const io::VariableInFile& variable) {
  std::vector<std::size_t> all(variable.shape.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  FieldArray array = array_of(file_, variable, all);
  array.is_text = true;
  if (variable.has_strings) {
    const std::vector<std::string> strings = file_.strings(variable);
    std::size_t longest = 1;
    for (const std::string& string : strings) longest = std::max(longest, string.size());
    if (strings.size() * longest > most_of_other) return false;
    array.dimensions.push_back(array.name + "_length");
    array.shape.push_back(longest);
    array.characters = padded(strings, longest);
    const auto is_encoding = [](const auto& attribute) { return attribute.first == "_Encoding"; };
    if (std::ranges::none_of(array.attributes, is_encoding)) {
      array.attributes.emplace_back("_Encoding", "utf-8");
    }
  } else {
    array.characters = file_.characters(variable);
  }
  fields_.others.push_back(std::move(array));
  tell_of_attributes(variable.attributes, "of variable " + io::in_quotes(variable.name));
  add_axes(variable, all, fields_.axes);
  return true;
}

bool FieldSlices::is_label(const io::VariableInFile& variable) const {
  return variable.type == io::NetcdfType::text && !variable.dimensions.empty() &&
         leading_dimensions_.contains(variable.dimensions.front());
}

void FieldSlices::keep_named() {
  std::vector<std::string> names;
  for (const io::VariableInFile& variable : file_.variables()) {
    if (is_label(variable)) names.push_back(variable.name);
  }
  for (const FieldArray& axis : fields_.axes) {
    const io::VariableInFile* const variable = file_.find(axis.name);
    if (variable == nullptr) continue;
    for (const char* const role : {"bounds", "climatology"}) {
      names.push_back(io::netcdf_text(variable->attributes, role));
    }
  }
  for (const SlicedVariable& source : sources_) {
    std::ranges::move(words_of(io::netcdf_text(source.variable->attributes, "coordinates")),
                      std::back_inserter(names));
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    const io::VariableInFile* const variable = file_.find(names[k]);
    const bool is_first =
        std::ranges::find(names, names[k]) - names.begin() == static_cast<std::ptrdiff_t>(k);
    const bool is_axis = std::ranges::count(fields_.axes, names[k], &FieldArray::name) != 0;
    if (variable != nullptr && is_first && !is_axis && !depends_on_place(*variable)) {
      keep_other(*variable);
    }
  }
}

// Attributes name variables as the file does; what is written has no slashes in its names.
void FieldSlices::name_variables() {
  std::map<std::string, const io::VariableInFile*, std::less<>> in_file;
  for (const io::VariableInFile& variable : file_.variables()) {
    in_file.emplace(written_name(variable.name), &variable);
  }
  std::set<std::string> names;
  std::set<std::string> dimensions;
  std::set<std::string> others;  // than axes, which need not be listed as coordinates
  const std::array<std::vector<FieldArray>*, 3> all = {&fields_.arrays, &fields_.axes,
                                                       &fields_.others};
  for (const std::vector<FieldArray>* const arrays : all) {
    for (const FieldArray& array : *arrays) {
      names.insert(array.name);
      if (arrays != &fields_.axes) others.insert(array.name);
      dimensions.insert(array.dimensions.begin(), array.dimensions.end());
    }
  }
  const auto kept_in = [](const std::set<std::string>& known) {
    return [&known](std::string name) {
      name = written_name(std::move(name));
      return known.contains(name) ? name : std::string();
    };
  };
  // xarray lists here the coordinates of no variable.
  const std::string listed = with_names(
      "coordinates", io::netcdf_text(file_.attributes(), "coordinates"), kept_in(others));
  if (!listed.empty()) fields_.attributes.emplace_back("coordinates", listed);
  for (std::vector<FieldArray>* const arrays : all) {
    for (FieldArray& array : *arrays) {
      const auto found = in_file.find(array.name);
      // A field that is one of several may have a name of its own.
      const bool is_field = arrays == &fields_.arrays;
      const io::VariableInFile* const variable =
          is_field ? sources_[static_cast<std::size_t>(&array - arrays->data())].variable
          : found == in_file.end() ? nullptr
                                   : found->second;
      if (variable == nullptr) continue;
      for (const io::NetcdfAttribute& attribute : variable->attributes) {
        const std::set<std::string>& known = attribute.name == "compress"      ? dimensions
                                             : attribute.name == "coordinates" ? others
                                                                               : names;
        const std::string text = with_names(attribute.name, attribute.text, kept_in(known));
        if (!text.empty()) array.attributes.emplace_back(attribute.name, text);
      }
    }
  }
}

// Adds the coordinates along some dimensions, unless they are known already.
void FieldSlices::add_axes(const io::VariableInFile& variable,
                           const std::vector<std::size_t>& dimensions,
                           std::vector<FieldArray>& axes) {
  for (const std::size_t d : dimensions) {
    const std::string& name = file_.dimensions()[variable.dimensions[d]].name;
    const io::VariableInFile* const axis = file_.find(name);
    const bool is_known = std::ranges::count(axes, written_name(name), &FieldArray::name) != 0;
    if (is_known || axis == nullptr || axis->type == io::NetcdfType::text ||
        axis->shape.size() != 1) {
      continue;
    }
    const ValueRules rules(*axis);
    if (!rules.remark().empty()) fields_.remarks.push_back(rules.remark());
    axes.push_back(array_of(file_, *axis, {0}));
    tell_of_attributes(axis->attributes, "of variable " + io::in_quotes(axis->name));
    bool is_rounded = false;
    axes.back().values = file_.rounded_numbers(*axis, is_rounded);
    if (is_rounded) tell_of_rounding(*axis);
    rules.apply(axes.back().values);
  }
}

// Fields are read one by one if points are left out, and otherwise several at once.
void FieldSlices::read(std::size_t array, std::size_t first, std::span<double> out,
                       unsigned threads) const {
  const SlicedVariable& source = sources_[array];
  const std::vector<std::size_t>& kept = source.layout.kept;
  if (kept.empty()) {
    read_all_points(source, first + source.first, out, threads);
    return;
  }
  std::vector<double> all(source.num_points);
  for (; !out.empty(); out = out.subspan(kept.size())) {
    read_all_points(source, source.first + first++, all, threads);
    for (std::size_t i = 0; i < kept.size(); ++i) out[i] = all[kept[i]];
  }
}

void FieldSlices::keep_chunks(std::size_t bytes) {
  bytes_kept_ = bytes;
  for (const SlicedVariable& source : sources_) file_.keep_chunks(*source.variable, bytes);
}

std::uint64_t FieldSlices::bytes_beside() const {
  std::uint64_t most = 0;
  for (const SlicedVariable& source : sources_) {
    const std::vector<std::uint64_t> chunk = file_.chunk_of(*source.variable);
    const bool has_chunks = std::ranges::any_of(chunk, [](std::uint64_t n) { return n > 1; });
    std::uint64_t of_chunk = has_chunks ? io::size_of(source.variable->type) : 0;
    for (const std::uint64_t length : chunk) {
      if (!system::multiply_checked(of_chunk, length, of_chunk)) return ~std::uint64_t{0};
    }
    const std::uint64_t of_block =
        source.blocks.are_apart()
            ? 0
            : source.blocks.block_of(0).count * source.num_points * std::uint64_t{sizeof(double)};
    most = std::max({most, of_chunk, of_block});
  }
  return most;
}

void FieldSlices::read_points(std::size_t array, std::size_t field, std::size_t first_point,
                              std::span<double> out) const {
  const SlicedVariable& source = sources_[array];
  if (source.layout.kept.empty() && source.blocks.are_apart()) {
    const std::size_t begin = (field + source.first) * source.num_points + first_point;
    file_.read_numbers(*source.variable, begin, out);
    unpack(source, out, first_point, 1);
    return;
  }
  if (whole_.empty() || array_of_whole_ != array || field_of_whole_ != field) {
    whole_.resize(fields_.num_points);
    read(array, field, whole_, 1);
    array_of_whole_ = array;
    field_of_whole_ = field;
  }
  std::copy_n(whole_.begin() + static_cast<std::ptrdiff_t>(first_point), out.size(), out.begin());
}

// Fields that are contiguous in the file, or whose chunks are kept, are read directly; others in
// blocks, of which the last one is kept.
void FieldSlices::read_all_points(const SlicedVariable& source, std::size_t first,
                                  std::span<double> out, unsigned threads) const {
  const std::size_t n = source.num_points;
  if (source.blocks.are_apart()) {
    io::read_run(file_, *source.variable, first * n, out, threads);
    unpack(source, out, 0, threads);
    return;
  }
  const bool are_kept =
      file_.has_chunks(*source.variable) && source.blocks.bytes_of_chunks() <= bytes_kept_;
  while (!out.empty()) {
    const FieldBlock next = source.blocks.part_from(first, are_kept ? out.size() / n : 0);
    const FieldBlock block = next.count > 0 ? next : source.blocks.block_of(first);
    const std::size_t wanted = std::min(out.size() / n, block.first + block.count - first);
    const std::span<double> part = out.first(wanted * n);
    if (wanted == block.count) {
      read_block(source, block, part, threads);
    } else {
      keep_block(source, block, threads);
      const auto begin = static_cast<std::ptrdiff_t>((first - block.first) * n);
      std::copy_n(block_.begin() + begin, part.size(), part.begin());
    }
    out = out.subspan(part.size());
    first += wanted;
  }
}

void FieldSlices::read_block(const SlicedVariable& source, const FieldBlock& block,
                             std::span<double> out, unsigned threads) const {
  io::read_in_order(file_, *source.variable, source.blocks.box_of(block), source.layout.order(),
                    out, threads);
  unpack(source, out, 0, threads);
}

// Applies fill values, scale and offset to the numbers of the file, some at a time, which stay in the
// cache. Infinite values are an error, as in tables.
void FieldSlices::unpack(const SlicedVariable& source, std::span<double> values,
                         std::size_t first_point, unsigned threads) const {
  constexpr std::size_t per_piece = std::size_t{1} << 16U;
  constexpr std::size_t at_a_time = std::size_t{1} << 11U;
  std::atomic<bool> are_finite = true;
  system::parallel_for(threads, values.size(), per_piece, [&](std::size_t begin, std::size_t end) {
    for (; begin < end; begin += at_a_time) {
      const auto part = values.subspan(begin, std::min(at_a_time, end - begin));
      source.rules.apply(part);
      std::uint64_t num_infinite = 0;  // without branches
      system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
        for (const double value : part) num_infinite += std::isinf(value) ? 1U : 0U;
      });
      if (num_infinite > 0) are_finite = false;
    }
  });
  if (are_finite) return;
  const auto infinite =
      std::ranges::find_if(values, [](double value) { return std::isinf(value); });
  throw io::BadValue(
      "variable " + io::in_quotes(source.variable->name) + ": value " +
      (*infinite > 0 ? "inf" : "-inf") + " at point " +
      std::to_string((first_point + static_cast<std::size_t>(infinite - values.begin())) %
                     source.num_points) +
      " is not finite" +
      (are_all_wanted_ && sources_.size() > 1
           ? "; --value NAME (names=NAME in Python) takes other variables alone"
           : ""));
}

void FieldSlices::keep_block(const SlicedVariable& source, const FieldBlock& block,
                             unsigned threads) const {
  if (source_of_block_ == &source && first_of_block_ == block.first) return;
  // If reading throws, the block must not be taken for a complete one.
  source_of_block_ = nullptr;
  block_.resize(block.count * source.num_points);
  read_block(source, block, block_, threads);
  source_of_block_ = &source;
  first_of_block_ = block.first;
}

}  // namespace rondel::formats
