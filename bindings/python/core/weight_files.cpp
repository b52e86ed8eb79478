// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/weight_files.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "columns.h"
#include "interrupt.h"
#include "module.h"

namespace rondel::python {
namespace {

// Degrees, areas, fractions, the shape of a grid, the mask, the corners and the properties of
// cells; empty ones are not written.
using SideIn = std::tuple<PairsIn, NumbersIn, NumbersIn, std::vector<std::uint64_t>, IndicesIn,
                          PairsIn, std::optional<CellColumns>>;

std::vector<double> vector_of(const NumbersIn& numbers) {
  return {numbers.data(), numbers.data() + numbers.size()};
}

WeightSide side_of(const SideIn& in) {
  const auto& [degrees, areas, fractions, shape, mask, corners, columns] = in;
  const auto points = rows_of<LonLat>(degrees);
  WeightSide side;
  side.points.assign(points.begin(), points.end());
  side.areas = vector_of(areas);
  side.fractions = vector_of(fractions);
  side.shape = shape;
  side.mask = {mask.data(), mask.data() + mask.size()};
  const auto places = rows_of<LonLat>(corners);
  side.corners.assign(places.begin(), places.end());
  if (columns) side.columns = columns->columns;
  return side;
}

// Returns the mask, empty if all take part, the centers in degrees, and the corners, those of a cell one after the other.
nb::tuple side_out(WeightSide& side) {
  return nb::make_tuple(to_array<std::int32_t>(std::move(side.mask)),
                        to_array<double>(std::move(side.points)),
                        to_array<double>(std::move(side.corners)));
}

}  // namespace

void add_weight_files(nb::module_& module) {
  module.def(
      "write_weights",
      [](const std::string& path, const std::string& format, const Weights& weights,
         const SideIn& source, const SideIn& target, const std::string& method,
         const std::string& normalization) {
        unlocked([&] {
          const WeightFile content{.weights = weights,
                                   .source = side_of(source),
                                   .target = side_of(target),
                                   .method = method,
                                   .normalization = normalization,
                                   .remarks = {}};
          write_weights({path, format}, content);
          return 0;
        });
      },
      nb::arg("path"), nb::arg("format"), nb::arg("weights"), nb::arg("source"), nb::arg("target"),
      nb::arg("method"), nb::arg("normalization"));
  module.def(
      "read_weights",
      [](const std::string& path) {
        WeightFile file = unlocked([&] { return read_weights(path); });
        return std::tuple(std::move(file.weights), std::move(file.remarks));
      },
      nb::arg("path"));
  // Returns the weights, the method, its normalization, what the reader remarks, and the sides of sources and targets.
  module.def(
      "read_weight_file",
      [](const std::string& path) {
        WeightFile file = unlocked([&] { return read_weights(path); });
        return std::tuple(std::move(file.weights), file.method, file.normalization, file.remarks,
                          side_out(file.source), side_out(file.target));
      },
      nb::arg("path"));
}

}  // namespace rondel::python
