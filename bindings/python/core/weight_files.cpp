// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/weight_files.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"

namespace rondel::python {
namespace {

// No points where the array has no rows.
WeightSide side_of(const PairsIn& degrees, const NumbersIn& areas,
                   std::vector<std::uint64_t> shape) {
  const auto points = rows_of<LonLat>(degrees);
  WeightSide side;
  side.points.assign(points.begin(), points.end());
  side.areas.assign(areas.data(), areas.data() + areas.size());
  side.shape = std::move(shape);
  return side;
}

}  // namespace

void add_weight_files(nb::module_& module) {
  module.def(
      "write_weights",
      [](const std::string& path, const std::string& format, const Weights& weights,
         const PairsIn& sites, const NumbersIn& site_areas, const PairsIn& targets,
         const NumbersIn& target_areas, std::vector<std::uint64_t> shape,
         const std::string& method) {
        unlocked([&] {
          const WeightFile content{.weights = weights,
                                   .source = side_of(sites, site_areas, {}),
                                   .target = side_of(targets, target_areas, std::move(shape)),
                                   .method = method,
                                   .normalization = "none"};
          write_weights({path, format}, content);
          return 0;
        });
      },
      nb::arg("path"), nb::arg("format"), nb::arg("weights"), nb::arg("sites").noconvert(),
      nb::arg("site_areas").noconvert(), nb::arg("targets").noconvert(),
      nb::arg("target_areas").noconvert(), nb::arg("shape"), nb::arg("method"));
  module.def(
      "read_weights",
      [](const std::string& path) { return unlocked([&] { return read_weights(path).weights; }); },
      nb::arg("path"));
}

}  // namespace rondel::python
