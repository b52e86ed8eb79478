// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Variables with any of the names, units and attributes that conventions know, and axes of any numbers. The pairs that are found are
// coordinates that belong together. Lines are as many as cells have, in order, and each coordinate of an axis lies between the two of its
// cell.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/conventions.h"
#include "rondel/error.h"

namespace rondel::fuzz {
namespace {

template <std::size_t n>
std::string one_of(ByteSource& source, const char* const (&words)[n]) {
  return words[source.below(n)];
}

constexpr const char* names[] = {
    "lon",      "lat",      "nav_lon", "nav_lat", "clon", "clat", "x",    "lon_b",       "time",
    "lon_bnds", "lat_bnds", "lonCell", "latCell", "t",    "cell", "ipix", "twelvepixels"};
// The length of a dimension is that of its name.
constexpr const char* dimension_names[] = {"lon", "lat", "time", "y", "x", "nv", "twelvepixels"};
constexpr const char* units[] = {
    "", "degrees_east", "degrees_north", "degree_E", "Radian", "rad", "degrees", "K", "degreeN",
    "m"};

std::vector<VariableHeader> headers_from(ByteSource& source) {
  std::vector<VariableHeader> headers(1 + source.below(8));
  for (VariableHeader& header : headers) {
    header.name = one_of(source, names);
    header.is_number = source.below(8) != 0;
    header.is_integer = header.is_number && source.below(2) != 0;
    header.texts.emplace_back("units", one_of(source, units));
    if (source.below(4) == 0) header.texts.emplace_back("bounds", one_of(source, names));
    if (source.below(4) == 0) {
      header.texts.emplace_back("coordinates", one_of(source, names) + " " + one_of(source, names));
    }
    if (source.below(8) == 0) header.texts.emplace_back("cell_measures", one_of(source, names));
    if (source.below(8) == 0) {
      header.texts.emplace_back("compress", one_of(source, dimension_names));
    }
    for (std::size_t rank = source.below(4); rank > 0; --rank) {
      header.dimensions.push_back(one_of(source, dimension_names));
      header.shape.push_back(header.dimensions.back().size());
    }
  }
  return headers;
}

// Attributes of a copy name nothing that is not there.
void test_names(const std::vector<VariableHeader>& headers) {
  const auto is_there = [&](const std::string& name) {
    return std::ranges::count(headers, name, &VariableHeader::name) != 0;
  };
  const auto kept = [&](const std::string& name) { return is_there(name) ? name : std::string(); };
  for (const VariableHeader& header : headers) {
    for (const auto& [attribute, text] : header.texts) {
      const std::string found = with_names(attribute, text, kept);
      require(found.empty() || is_attribute_of_names(attribute), "other attributes name nothing");
      require(with_names(attribute, found, kept) == found, "what is there is kept");
      const auto same = [](const std::string& name) { return name; };
      require(found.empty() || with_names(attribute, text, same).size() >= found.size(),
              "no name is added");
    }
  }
}

// Numbers of pixels that are found are those of a variable, each pixel once.
void test_pixels(ByteSource& source, const std::vector<VariableHeader>& headers) {
  constexpr std::uint64_t num_pixels = 12;
  std::vector<double> numbers(64);
  for (double& number : numbers) number = static_cast<double>(source.below(num_pixels + 1));
  const auto read = [&](std::size_t variable, std::uint64_t begin, std::span<double> out) {
    require(pixel_list_of(headers[variable], false) != PixelList::none, "others are not read");
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = numbers[(begin + i) % numbers.size()];
  };
  const auto found = numbered_pixels(headers, {"healpix:0:nested", num_pixels, "t", read});
  if (!found) return;
  require(headers[found->variable].shape.size() == 1, "a list has one dimension");
  const std::uint64_t size = headers[found->variable].shape.front();
  require(found->numbers.empty() ? size == num_pixels : found->numbers.size() == size,
          "a list has a number for each pixel");
  std::vector<bool> is_there(num_pixels);
  for (const Index number : found->numbers) {
    require(number < num_pixels && !is_there[number], "a pixel is there once");
    is_there[number] = true;
  }
}

// A message about two variables has no direction of its own.
void test_vectors(ByteSource& source) {
  constexpr const char* standard_names[] = {"", "eastward_wind", "northward_wind", "x_wind",
                                            "unknown"};
  constexpr const char* texts[] = {"", "m s-1", "m/s", "km.h^-1", "m s**-", "1e-3", "/ per", "^*"};
  const auto component = [&](const char* name) {
    return VectorComponent{name, one_of(source, standard_names), one_of(source, texts),
                           source.below(8) == 0};
  };
  const VectorComponent east = component("u");
  const VectorComponent north = component("v");
  const bool is_along_axes = source.below(2) == 0;
  const bool is_refused = !lack_of_vectors(east, north, is_along_axes).empty();
  require(is_refused || (!east.has_flags && !north.has_flags), "flags are no components");
  VectorComponent same = north;
  same.units = east.units;
  require(is_refused || lack_of_vectors(east, same, is_along_axes).empty(), "units agree");
}

// Latitudes stay, or are those of a pole that was near.
void test_poles(ByteSource& source) {
  std::vector<double> lat(source.below(8));
  for (double& value : lat) value = source.below(2) == 0 ? source.any_double() : 90 + 1e-6;
  const std::vector<double> before = lat;
  const std::size_t beyond = clamp_at_poles(lat);
  for (std::size_t i = 0; i < lat.size(); ++i) {
    const bool is_moved = std::abs(before[i]) > 90 && std::abs(lat[i]) == 90;
    require(is_moved || lat[i] == before[i] || std::isnan(lat[i]), "a latitude stays");
    require(!(std::abs(lat[i]) > 90) || beyond <= i, "what is beyond a pole is told");
  }
}

void test_variables(const std::vector<VariableHeader>& headers) {
  test_names(headers);
  require(are_measures_of_cells(headers).size() == headers.size(), "each variable has an answer");
  const std::vector<bool> is_part = parts_of_grids(headers);
  require(is_part.size() == headers.size(), "each variable has an answer");
  const std::vector<bool> depends_on_place = are_at_places(headers);
  for (std::size_t i = 0; i < headers.size(); ++i) {
    require(!depends_on_place[i] || !headers[i].dimensions.empty(),
            "a number has no dimension of places");
  }
  for (std::size_t i = 0; i < headers.size(); ++i) {
    const std::vector<CoordinatePair> pairs = coordinates_of(headers, i);
    const auto is_listed = [](const CoordinatePair& pair) { return pair.is_listed; };
    const auto has_it = [i](const CoordinatePair& pair) { return pair.lon == i || pair.lat == i; };
    require(std::ranges::none_of(pairs, has_it) || std::ranges::all_of(pairs, has_it),
            "a coordinate is at places that it is a part of");
    require(std::ranges::none_of(pairs, is_listed) || std::ranges::all_of(pairs, is_listed) ||
                std::ranges::all_of(pairs, has_it),
            "the attribute coordinates has the last word");
    (void)is_attribute_of_places(headers[i].name);
    require(!is_attribute_of_flags(headers[i].name) || !is_attribute_of_values(headers[i].name),
            "flags are no range");
    // Any variable may be a grid mapping.
    const std::pair<std::string, double> meridian = {headers[i].name, 7.5};
    const std::string why = remark_on_meridian(headers, headers.front().name, {&meridian, 1});
    require(why.empty() || why.find(" 7.5 degrees east") != std::string::npos,
            "a remark says which meridian it is");
    (void)is_planar(headers[i].texts);
  }
  require(!has_mesh({}), "nothing is no mesh");
  (void)has_mesh(headers);
}

void test_coordinates(ByteSource& source) {
  const std::vector<VariableHeader> headers = headers_from(source);
  test_variables(headers);
  std::vector<std::string> remarks;
  int rank = 1 << 20;
  for (const CoordinatePair& pair : find_coordinates(headers, {}, &remarks)) {
    require(pair.lon < headers.size() && pair.lat < headers.size() && pair.lon != pair.lat,
            "a pair is of two variables");
    require(pair.rank <= rank, "the best pair comes first");
    rank = pair.rank;
    const VariableHeader& lon = headers[pair.lon];
    const VariableHeader& lat = headers[pair.lat];
    require(lon.is_number && lat.is_number, "coordinates are numbers");
    require(pair.are_axes ? lon.shape.size() == 1 && lat.shape.size() == 1
                          : lon.shape.size() == lat.shape.size(),
            "a pair has the same dimensions, or one each");
    const double unit = degrees_per_unit(lon);
    require(unit == 1 || (unit > 57 && unit < 58), "a unit is degrees or radians");
    const std::string text = lon.text("units");
    require(text.empty() || degrees_per_unit(text) == unit, "units are those of the text");
  }
  test_pixels(source, headers);
}

void test_axis(ByteSource& source) {
  const bool is_longitude = source.below(2) == 0;
  std::vector<double> values(source.below(8));
  double at = 10.0 * source.small();
  const double step = source.below(3) == 0 ? 0.25 * source.small() : 1.0 + source.byte();
  for (double& value : values) {
    value = source.below(16) == 0 ? source.any_double() : at;
    at += step;
  }
  std::vector<double> bounds;
  if (source.below(2) == 0) {
    for (const double value : values) {
      const bool is_swapped = source.below(8) == 0;
      bounds.push_back(value + (is_swapped ? step : -step) / 2);
      bounds.push_back(value + (is_swapped ? -step : step) / 2);
    }
  }
  const std::vector<double> lines = axis_lines(values, bounds, is_longitude);
  require(lines.size() == values.size() + 1, "cells lie between lines");
  require(std::ranges::all_of(lines, [](double line) { return std::isfinite(line); }),
          "lines are finite");
}

// Dimensions with any names and lengths below 4.
struct AnyDimensions {
  std::vector<std::string> names;
  std::vector<std::uint64_t> shape;
  std::size_t size = 1;

  AnyDimensions(ByteSource& source, std::size_t end_of_rank) {
    for (std::size_t rank = source.below(end_of_rank); rank > 0; --rank) {
      names.push_back(one_of(source, dimension_names));
      shape.push_back(source.below(4));
      size *= shape.back();
    }
  }
};

void test_repeated(ByteSource& source) {
  const auto [of_dimensions, shape, size] = AnyDimensions(source, 4);
  std::vector<double> lon(size);
  std::vector<double> lat(size);
  for (double& value : lon) value = static_cast<double>(source.below(2));
  const std::vector<bool> repeated = repeated_dimensions(of_dimensions, shape, lon, lat);
  require(repeated.size() == shape.size(), "each dimension has an answer");
  require(shape.empty() || std::ranges::count(repeated, false) > 0, "one dimension is left");
  for (std::size_t d = 0; d < shape.size(); ++d) {
    const bool is_time = is_name_of_time(of_dimensions[d]);
    require(!repeated[d] || shape[d] != 1 || is_time, "one place is no repetition but of time");
    require(!is_time || !is_name_of_cells(of_dimensions[d]), "times are no cells");
  }
  for (const std::size_t d : dimensions_of_cells(of_dimensions, shape, 2)) {
    require(shape[d] == 2, "there are as many cells");
  }
}

// Bounds with any dimensions: along those of records they are the same, so that the first one is enough.
void test_records(ByteSource& source) {
  const auto [of_bounds, shape, size] = AnyDimensions(source, 5);
  const AnyDimensions places(source, 3);
  const std::vector<std::string> repeated(source.below(2), one_of(source, dimension_names));
  std::vector<double> bounds(size);
  const std::size_t num_values = 1 + source.below(2);
  for (double& bound : bounds) bound = static_cast<double>(source.below(num_values));
  const std::vector<bool> are_records =
      record_dimensions({of_bounds, shape, places.names, places.shape, repeated}, bounds);
  require(are_records.size() == shape.size(), "each dimension of bounds has an answer");
  std::size_t block = size;
  for (std::size_t d = 0; d < shape.size() && size > 0; ++d) {
    const std::size_t stride = block / shape[d];
    for (std::size_t i = 0; are_records[d] && i < size; ++i) {
      require(bounds[i] == bounds[i - i % block + i % stride], "records are the same");
    }
    block = stride;
  }
}

// A text of names, methods and remarks in any order; what is done is what was done last.
void test_cell_methods(ByteSource& source) {
  constexpr const char* words[] = {"area:", "lat:", "lon:",   "time:", "ncells:", "sum", "mean",
                                   "where", "land", "(area:", "sum)",  "(",       ")",   ":"};
  std::string text;
  for (std::size_t k = source.below(9); k > 0; --k) {
    text.append(text.empty() ? "" : " ").append(one_of(source, words));
  }
  require(!are_sums_over_cells(text) || text.find("sum") != std::string::npos, "sums are told");
  for (const std::string method : {"sum", "mean"}) {
    const std::string done = with_cell_method(text, method);
    require(done.starts_with(text), "what was done before stays");
    // A comment may be open, and a name may lack its method.
    const bool is_whole =
        text.find('(') == std::string::npos && text.find(':') == std::string::npos;
    require(!is_whole || with_cell_method(done, method) == done, "a method counts once");
  }
}

void test_same(ByteSource& source) {
  const LonLat a = {10.0 * source.small(), 1.0 * source.small()};
  const LonLat b = {10.0 * source.small(), 1.0 * source.small()};
  require(is_same_place(a, a, 0) && is_same_place(a, {NAN, 0}, 0), "a place is where it is");
  require(is_same_place(a, b, 1) == is_same_place(b, a, 1), "neither place is the first");
}

// Integers around those from which on not all are doubles.
std::int64_t near_power_of_two(ByteSource& source) {
  const auto power = static_cast<std::int64_t>(std::uint64_t{1} << (50U + source.below(13)));
  const std::int64_t near = static_cast<std::int64_t>(source.below(7)) - 3;
  return source.below(2) == 0 ? power + near : near - power;
}

// Integers of 64 bits stay what they are, are missing, or are refused by their digits. There is no
// scale_factor among the attributes, which would make other numbers of them.
void test_integers(ByteSource& source, std::span<const ValueAttribute> given) {
  std::vector<ValueAttribute> attributes;
  for (const ValueAttribute& attribute : given) {
    if (attribute.name == "_FillValue" || attribute.name.starts_with("valid_")) {
      attributes.push_back(attribute);
    }
  }
  const std::int64_t integer = near_power_of_two(source);
  try {
    const double found = unpack_integers({&integer, 1}, "i8", attributes).front();
    require(std::isnan(found) || static_cast<std::int64_t>(found) == integer,
            "an integer stays or is missing");
  } catch (const InvalidInput& error) {
    require(std::string(error.what()).find(std::to_string(integer)) != std::string::npos,
            "a message names the integer");
  }
}

void test_missing(ByteSource& source) {
  constexpr const char* types[] = {"i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "f4", "f8"};
  constexpr const char* attribute_names[] = {"_FillValue",   "missing_value", "valid_min",
                                             "valid_max",    "valid_range",   "_Unsigned",
                                             "scale_factor", "add_offset"};
  std::vector<ValueAttribute> attributes(source.below(4));
  for (ValueAttribute& attribute : attributes) {
    attribute.name = one_of(source, attribute_names);
    if (source.below(4) == 0) {
      attribute.text = source.below(2) == 0 ? "true" : "0.5";
      continue;
    }
    attribute.type = one_of(source, types);
    attribute.numbers.resize(1 + source.below(2));
    for (double& number : attribute.numbers) number = source.small();
    if (attribute.type.back() != '8' || attribute.type.front() == 'f') continue;
    for (double& number : attribute.numbers) {
      attribute.integers.push_back(near_power_of_two(source));
      number = static_cast<double>(attribute.integers.back());
    }
  }
  test_integers(source, attributes);
  const std::string type = one_of(source, types);
  std::vector<double> values(source.below(8));
  for (double& value : values) value = source.below(4) == 0 ? source.any_double() : source.small();
  std::vector<double> marked = values;
  mark_missing(marked, type, attributes);
  for (std::size_t i = 0; i < values.size(); ++i) {
    require(std::isnan(marked[i]) || marked[i] == values[i], "a value stays or is missing");
  }
  std::vector<double> again = marked;
  mark_missing(again, type, attributes);
  for (std::size_t i = 0; i < values.size(); ++i) {
    require(std::isnan(marked[i]) == std::isnan(again[i]), "what is there is not missing");
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rondel::fuzz::ByteSource source(data, size);
  try {
    switch (source.below(4)) {
      case 3:
        rondel::fuzz::test_missing(source);
        break;
      case 0:
        rondel::fuzz::test_coordinates(source);
        break;
      case 1:
        rondel::fuzz::test_axis(source);
        break;
      default:
        rondel::fuzz::test_repeated(source);
        rondel::fuzz::test_vectors(source);
        rondel::fuzz::test_poles(source);
        rondel::fuzz::test_same(source);
        rondel::fuzz::test_cell_methods(source);
        rondel::fuzz::test_records(source);
    }
  } catch (const rondel::InvalidInput& error) {
    const std::string what = error.what();
    rondel::fuzz::require(!what.empty() && what.find('\n') == std::string::npos,
                          "a message is one line: " + what);
  }
  return 0;
}
