// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/weight_files.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstdint>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"

namespace rondel::python {
namespace {

// Returns what a file says of places: degrees, areas, the shape of a grid and the mask. Empty
// arrays are not written.
WeightSide side_of(const PairsIn& places, const NumbersIn& areas,
                   const std::vector<std::uint64_t>& shape, const IndicesIn& mask) {
  WeightSide side;
  side.points = vector_of<LonLat>(places);
  side.areas = vector_of<double>(areas);
  side.shape = shape;
  side.mask = vector_of<std::int32_t>(mask);
  return side;
}

}  // namespace

void add_weight_files(nb::module_& module) {
  nb::class_<WeightSide> side(module, "WeightSide");
  add_fixed_array<std::int32_t, &WeightSide::mask>(side, "mask");
  add_fixed_array<double, &WeightSide::points>(side, "centers");
  add_fixed_array<double, &WeightSide::corners>(side, "corners");
  nb::class_<WeightFile>(module, "WeightFile")
      .def(
          "__init__",
          [](WeightFile* self, const Weights& weights) {
            new (self) WeightFile();
            self->weights = weights;
          },
          nb::arg("weights"))
      .def_prop_ro(
          "shape",
          [](const WeightFile& self) {
            const Weights& weights = self.weights;
            return std::array{weights.num_rows(), weights.num_columns, weights.values.size()};
          })
      .def("take_weights", [](WeightFile& self) { return std::move(self.weights); })
      .def_ro("source", &WeightFile::source)
      .def_ro("target", &WeightFile::target)
      .def_ro("method", &WeightFile::method)
      .def_ro("normalization", &WeightFile::normalization)
      .def_ro("remarks", &WeightFile::remarks);
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
  module.def(
      "read_weight_file",
      [](const std::string& path) { return unlocked([&] { return read_weights(path); }); },
      nb::arg("path"));
}

}  // namespace rondel::python
