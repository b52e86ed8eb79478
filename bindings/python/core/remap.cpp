// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/remap.h"

#include <nanobind/stl/string.h>

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

}  // namespace

void add_remap(nb::module_& module) {
  nb::class_<Remap> type(module, "Remap");
  type.def(nb::init<>())
      .def("take_weights", [](Remap& self) { return std::move(self.weights); })
      .def_rw("weights", &Remap::weights)
      .def_rw("order", &Remap::order)
      .def_prop_rw(
          "source", [](const Remap& self) { return self.source; },
          [](Remap& self, const CellSet& cells) { self.source = cells; })
      .def_prop_rw(
          "target", [](const Remap& self) { return self.target; },
          [](Remap& self, const CellSet& cells) { self.target = cells; })
      .def_prop_rw(
          "norm", [](const Remap& self) { return std::string(name_of(self.norm)); },
          [](Remap& self, nb::handle norm) { self.norm = named<RemapNorm>("norm", norm); });
  add_array<double, &Remap::source_areas>(type, "source_areas");
  add_array<double, &Remap::target_areas>(type, "target_areas");
  add_array<double, &Remap::source_fractions>(type, "source_fractions");
  add_array<double, &Remap::target_fractions>(type, "target_fractions");
  module.def("remap", &remap_of, nb::arg("source"), nb::arg("target"), nb::kw_only(),
             nb::arg("order"), nb::arg("norm").none(), nb::arg("source_mask").noconvert(),
             nb::arg("target_mask").noconvert(), nb::arg("overlap").none(), nb::arg("threads"),
             nb::arg("progress").none());
  module.def(
      "write_remap",
      [](const std::string& path, const std::string& format, Remap& remap) {
        unlocked([&] {
          write_weights({path, format}, weight_file(std::move(remap)));
          return 0;
        });
      },
      nb::arg("path"), nb::arg("format"), nb::arg("remap"));
}

}  // namespace rondel::python
