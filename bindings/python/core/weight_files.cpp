// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/weight_files.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"

namespace rondel::python {
namespace {

// Returns what a file says of places: degrees, areas, the shape of a grid and the mask. Empty arrays
// are not written.
WeightSide side_of(const PairsIn& places, const NumbersIn& areas,
                   const std::vector<std::uint64_t>& shape, const IndicesIn& mask) {
  WeightSide side;
  side.points = vector_of<LonLat>(places);
  side.areas = vector_of<double>(areas);
  side.shape = shape;
  side.mask = vector_of<std::int32_t>(mask);
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
  const nb::class_<WeightSide> side(module, "WeightSide");
  module.def("weight_side", &side_of, nb::arg("places").noconvert(), nb::arg("areas").noconvert(),
             nb::arg("shape"), nb::arg("mask").noconvert());
  module.def(
      "write_weights",
      [](const std::string& path, const std::string& format, const Weights& weights,
         const WeightSide& source, const WeightSide& target, const std::string& method,
         const std::string& normalization) {
        unlocked([&] {
          write_weights({path, format},
                        WeightFile{weights, source, target, method, normalization, {}});
          return 0;
        });
      },
      nb::arg("path"), nb::arg("format"), nb::arg("weights"), nb::arg("source"), nb::arg("target"),
      nb::arg("method"), nb::arg("normalization"));
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
