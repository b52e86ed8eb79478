// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/remap.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"

namespace rondel::python {
namespace {

Remap remap_of(const CellSet& source, const CellSet& target, unsigned order, nb::handle norm,
               const IndicesIn& source_mask, const IndicesIn& target_mask, nb::handle overlap,
               unsigned threads, const nb::object& listener) {
  const RemapOptions options{
      .order = order,
      .norm = named<RemapNorm>("norm", norm),
      .source_mask = vector_of<std::int32_t>(source_mask),
      .target_mask = vector_of<std::int32_t>(target_mask),
      .overlap = named<CellOverlap>("overlap", overlap),
  };
  return watched(
      source.num_cells() + target.num_cells(), threads, listener,
      [&](const Execution& execution) { return remap(source, target, options, execution); });
}

void write_remap(const std::string& path, const std::string& format, const Weights& weights,
                 const CellSet& source, const CellSet& target,
                 const std::array<NumbersIn, 4>& measures, nb::handle norm, unsigned order) {
  Remap remap;
  remap.source = source;
  remap.target = target;
  remap.order = order;
  remap.norm = named<RemapNorm>("norm", norm);
  remap.weights = weights;
  remap.source_areas = vector_of<double>(measures[0]);
  remap.target_areas = vector_of<double>(measures[1]);
  remap.source_fractions = vector_of<double>(measures[2]);
  remap.target_fractions = vector_of<double>(measures[3]);
  unlocked([&] {
    write_weights({path, format}, weight_file(std::move(remap)));
    return 0;
  });
}

}  // namespace

void add_remap(nb::module_& module) {
  nb::class_<Remap> type(module, "Remap");
  type.def("take_weights", [](Remap& self) { return std::move(self.weights); })
      .def_prop_ro("source", [](const Remap& self) { return self.source; })
      .def_prop_ro("target", [](const Remap& self) { return self.target; });
  add_fixed_array<double, &Remap::source_areas>(type, "source_areas");
  add_fixed_array<double, &Remap::target_areas>(type, "target_areas");
  add_fixed_array<double, &Remap::source_fractions>(type, "source_fractions");
  add_fixed_array<double, &Remap::target_fractions>(type, "target_fractions");
  module.def("remap", &remap_of, nb::arg("source"), nb::arg("target"), nb::kw_only(),
             nb::arg("order"), nb::arg("norm").none(), nb::arg("source_mask").noconvert(),
             nb::arg("target_mask").noconvert(), nb::arg("overlap").none(), nb::arg("threads"),
             nb::arg("progress").none());
  module.def("write_remap", &write_remap, nb::arg("path"), nb::arg("format"), nb::arg("weights"),
             nb::arg("source"), nb::arg("target"), nb::arg("measures"), nb::arg("norm").none(),
             nb::arg("order"));
}

}  // namespace rondel::python
