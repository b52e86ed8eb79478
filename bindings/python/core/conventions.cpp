// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/conventions.h"

#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "module.h"

namespace rondel::python {
namespace {

// The name of a variable, whether it holds numbers, its dimensions, their lengths, its attributes that
// are texts, and whether the numbers are integers.
using HeaderIn = std::tuple<std::string, bool, std::vector<std::string>, std::vector<std::uint64_t>,
                            std::vector<std::pair<std::string, std::string>>, bool>;
// The name of a component of vectors, its standard_name and units, and whether it has flags.
using ComponentIn = std::tuple<std::string, std::string, std::string, bool>;
// Indices of longitudes, latitudes and their bounds (-1 for none), the degrees in a unit of each,
// whether they are axes, and the rank.
using PairOut = std::tuple<std::vector<std::int64_t>, std::vector<double>, bool, int>;

std::vector<VariableHeader> headers_of(const std::vector<HeaderIn>& in) {
  std::vector<VariableHeader> headers;
  headers.reserve(in.size());
  for (const auto& [name, is_number, dimensions, shape, texts, is_integer] : in) {
    headers.push_back({name, is_number, dimensions, shape, texts, is_integer});
  }
  return headers;
}

PairOut pair_out(const std::vector<VariableHeader>& headers, const CoordinatePair& pair) {
  PairOut out;
  auto& [indices, units, are_axes, rank] = out;
  for (const std::size_t index : {pair.lon, pair.lat, pair.lon_bounds, pair.lat_bounds}) {
    indices.push_back(index == CoordinatePair::none ? -1 : static_cast<std::int64_t>(index));
  }
  const auto header_at = [&](std::size_t index) {
    return index == CoordinatePair::none ? nullptr : &headers[index];
  };
  const VariableHeader* const lon[] = {header_at(pair.lon_bounds), &headers[pair.lat]};
  const VariableHeader* const lat[] = {header_at(pair.lat_bounds), &headers[pair.lon]};
  const VariableHeader* const lon_bounds[] = {&headers[pair.lon], &headers[pair.lat]};
  const VariableHeader* const lat_bounds[] = {&headers[pair.lat], &headers[pair.lon]};
  units = {degrees_per_unit(headers[pair.lon], lon), degrees_per_unit(headers[pair.lat], lat),
           lon[0] == nullptr ? 1 : degrees_per_unit(*lon[0], lon_bounds),
           lat[0] == nullptr ? 1 : degrees_per_unit(*lat[0], lat_bounds)};
  are_axes = pair.are_axes;
  rank = pair.rank;
  return out;
}

// An attribute has a name, type, text, numbers and, of 64-bit integers, their bits.
using ValueAttributeIn = std::tuple<std::string, std::string, std::string, std::vector<double>,
                                    std::vector<std::int64_t>>;
using NumbersInOut = nb::ndarray<double, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using BitsIn = nb::ndarray<const std::int64_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

std::vector<ValueAttribute> attributes_of(const std::vector<ValueAttributeIn>& in) {
  std::vector<ValueAttribute> attributes;
  attributes.reserve(in.size());
  for (const auto& [name, type, text, numbers, integers] : in) {
    attributes.push_back({name, type, text, numbers, integers});
  }
  return attributes;
}

// Adds what says of places which are the same, and along which dimensions they repeat.
void add_repetitions(nb::module_& module) {
  module.def(
      "are_same_places",
      [](const PairsIn& a, const PairsIn& b, double max_apart_deg) {
        std::vector<std::uint8_t> are_same(a.shape(0));
        std::ranges::transform(rows_of<LonLat>(a), rows_of<LonLat>(b), are_same.begin(),
                               [&](const LonLat& p, const LonLat& q) {
                                 return is_same_place(p, q, max_apart_deg) ? 1 : 0;
                               });
        return to_array<std::uint8_t>(std::move(are_same));
      },
      nb::arg("a").noconvert(), nb::arg("b").noconvert(), nb::arg("max_apart_deg"));
  module.def(
      "is_name_of_time", [](const std::string& dimension) { return is_name_of_time(dimension); },
      nb::arg("dimension"));
  module.def(
      "repeated_dimensions",
      [](const std::vector<std::string>& names, const std::vector<std::uint64_t>& shape,
         const NumbersIn& lon, const NumbersIn& lat) {
        return repeated_dimensions(names, shape, {lon.data(), lon.size()},
                                   {lat.data(), lat.size()});
      },
      nb::arg("names"), nb::arg("shape"), nb::arg("lon").noconvert(), nb::arg("lat").noconvert());
  module.def(
      "record_dimensions",
      [](const std::vector<std::string>& names, const std::vector<std::uint64_t>& shape,
         const std::vector<std::string>& places, const std::vector<std::uint64_t>& lengths,
         const std::vector<std::string>& repeated, const NumbersIn& bounds) {
        return record_dimensions({names, shape, places, lengths, repeated},
                                 {bounds.data(), bounds.size()});
      },
      nb::arg("names"), nb::arg("shape"), nb::arg("places"), nb::arg("lengths"),
      nb::arg("repeated"), nb::arg("bounds").noconvert());
}

// Adds what says which values are missing, and reads axes.
void add_value_functions(nb::module_& module) {
  module.def(
      "mark_missing",
      [](const NumbersInOut& values, const std::string& type,
         const std::vector<ValueAttributeIn>& attributes) {
        mark_missing({values.data(), values.size()}, type, attributes_of(attributes));
      },
      nb::arg("values").noconvert(), nb::arg("type"), nb::arg("attributes"));
  module.def(
      "unpack_integers",
      [](const BitsIn& bits, const std::string& type,
         const std::vector<ValueAttributeIn>& attributes) {
        return to_array<double>(
            unpack_integers(rows_of<std::int64_t>(bits), type, attributes_of(attributes)));
      },
      nb::arg("integers").noconvert(), nb::arg("type"), nb::arg("attributes"));
  module.def(
      "clamp_at_poles",
      [](const NumbersInOut& lat_deg) {
        return clamp_at_poles({lat_deg.data(), lat_deg.size()});
      },
      nb::arg("lat_deg").noconvert());
  module.def(
      "axis_lines",
      [](const NumbersIn& values, const NumbersIn& bounds, bool is_longitude) {
        return to_array<double>(
            axis_lines(rows_of<double>(values), rows_of<double>(bounds), is_longitude));
      },
      nb::arg("values").noconvert(), nb::arg("bounds").noconvert(), nb::arg("is_longitude"));
}

// Adds what finds coordinates and lists of pixels among variables.
void add_searches(nb::module_& module) {
  module.def(
      "find_coordinates",
      [](const std::vector<HeaderIn>& in, const std::string& lon, const std::string& lat,
         const std::string& values) {
        const std::vector<VariableHeader> headers = headers_of(in);
        std::vector<std::string> remarks;
        std::vector<PairOut> pairs;
        // The units of pairs that are not the best ones do not matter.
        for (const CoordinatePair& pair : find_coordinates(headers, {lon, lat, values}, &remarks)) {
          if (!pairs.empty() && pair.rank < std::get<3>(pairs.front())) break;
          pairs.push_back(pair_out(headers, pair));
        }
        return std::pair(std::move(pairs), std::move(remarks));
      },
      nb::arg("headers"), nb::arg("lon"), nb::arg("lat"), nb::arg("values"));
  module.def(
      "coordinates_of",
      [](const std::vector<HeaderIn>& in, const std::vector<std::size_t>& variables) {
        std::vector<std::vector<std::pair<std::size_t, std::size_t>>> pairs;
        for (const std::vector<CoordinatePair>& found : coordinates_of(headers_of(in), variables)) {
          pairs.emplace_back();
          for (const CoordinatePair& pair : found) pairs.back().emplace_back(pair.lon, pair.lat);
        }
        return pairs;
      },
      nb::arg("headers"), nb::arg("variables"));
  module.def(
      "numbered_pixels",
      [](const std::vector<HeaderIn>& in, const std::string& grid, std::uint64_t num_pixels,
         const std::string& mapping, const nb::callable& numbers_of) {
        std::size_t known = CoordinatePair::none;  // the variable whose numbers are in memory
        NumbersIn numbers;
        const auto read = [&](std::size_t variable, std::uint64_t begin, std::span<double> out) {
          if (variable != known) numbers = nb::cast<NumbersIn>(numbers_of(variable));
          known = variable;
          const std::span<const double> all = rows_of<double>(numbers);
          std::ranges::copy(all.subspan(begin, out.size()), out.begin());
        };
        const auto found = numbered_pixels(headers_of(in), {grid, num_pixels, mapping, read});
        using Listed = std::pair<std::size_t, std::vector<Index>>;
        return found ? std::optional(Listed(found->variable, found->numbers)) : std::nullopt;
      },
      nb::arg("headers"), nb::arg("grid"), nb::arg("num_pixels"), nb::arg("mapping"),
      nb::arg("numbers_of"));
}

// Adds what tells the kinds of variables.
void add_kinds(nb::module_& module) {
  module.def(
      "parts_of_grids",
      [](const std::vector<HeaderIn>& in) { return parts_of_grids(headers_of(in)); },
      nb::arg("headers"));
  module.def(
      "has_mesh", [](const std::vector<HeaderIn>& in) { return has_mesh(headers_of(in)); },
      nb::arg("headers"));
  module.def(
      "are_measures_of_cells",
      [](const std::vector<HeaderIn>& in) { return are_measures_of_cells(headers_of(in)); },
      nb::arg("headers"));
  module.def(
      "are_at_places",
      [](const std::vector<HeaderIn>& in) { return are_at_places(headers_of(in)); },
      nb::arg("headers"));
  module.def(
      "lack_of_vectors",
      [](const ComponentIn& east, const ComponentIn& north, bool is_along_axes) {
        const auto component = [](const ComponentIn& in) {
          const auto& [name, standard_name, units, has_flags] = in;
          return VectorComponent{name, standard_name, units, has_flags};
        };
        return lack_of_vectors(component(east), component(north), is_along_axes);
      },
      nb::arg("east"), nb::arg("north"), nb::arg("is_along_axes"));
  module.def(
      "is_planar",
      [](const std::vector<std::pair<std::string, std::string>>& texts) {
        return is_planar(texts);
      },
      nb::arg("texts"));
  module.def(
      "dimensions_of_cells",
      [](const std::vector<std::string>& names, const std::vector<std::uint64_t>& lengths,
         std::uint64_t num_cells) { return dimensions_of_cells(names, lengths, num_cells); },
      nb::arg("names"), nb::arg("lengths"), nb::arg("num_cells"));
}

// Adds what tells the kinds of attributes, and renames what they name.
void add_attributes(nb::module_& module) {
  module.def(
      "with_names",
      [](const std::string& attribute, const std::string& text,
         const std::map<std::string, std::string>& names) {
        return with_names(attribute, text, [&](const std::string& name) {
          const auto found = names.find(name);
          return found == names.end() ? std::string() : found->second;
        });
      },
      nb::arg("attribute"), nb::arg("text"), nb::arg("names"));
  module.def(
      "are_sums_over_cells",
      [](const std::string& cell_methods, const std::vector<std::string>& places) {
        return are_sums_over_cells(cell_methods, places);
      },
      nb::arg("cell_methods"), nb::arg("places"));
  module.def(
      "with_cell_method",
      [](const std::string& cell_methods, const std::string& method,
         const std::vector<std::string>& places) {
        return with_cell_method(cell_methods, method, places);
      },
      nb::arg("cell_methods"), nb::arg("method"), nb::arg("places"));
  module.def(
      "is_attribute_of_places",
      [](const std::string& name) { return is_attribute_of_places(name); }, nb::arg("name"));
  module.def(
      "remark_on_meridian",
      [](const std::vector<HeaderIn>& variables, const std::string& coordinate,
         const std::vector<std::pair<std::string, double>>& meridians) {
        return remark_on_meridian(headers_of(variables), coordinate, meridians);
      },
      nb::arg("variables"), nb::arg("coordinate"), nb::arg("meridians"));
  module.def(
      "is_attribute_of_values",
      [](const std::string& name) { return is_attribute_of_values(name); }, nb::arg("name"));
  module.def(
      "is_attribute_of_flags", [](const std::string& name) { return is_attribute_of_flags(name); },
      nb::arg("name"));
}

}  // namespace

void add_conventions(nb::module_& module) {
  add_searches(module);
  add_kinds(module);
  add_attributes(module);
  add_repetitions(module);
  add_value_functions(module);
}

}  // namespace rondel::python
