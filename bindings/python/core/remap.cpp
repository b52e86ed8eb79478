// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/remap.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"

namespace rondel::python {
namespace {

// The weights, the cells of both sides with the masks that count, and the areas of sources and of
// targets and the fractions of both.
using RemapOut = std::tuple<Weights, CellSet, CellSet, std::array<ArrayOut<double>, 4>>;

RemapOut remap_of(const CellSet& source, const CellSet& target, unsigned order, nb::handle norm,
                  const IndicesIn& source_mask, const IndicesIn& target_mask, nb::handle overlap,
                  unsigned threads, const nb::object& listener) {
  const RemapOptions options{
      .order = order,
      .norm = named<RemapNorm>("norm", norm),
      .source_mask = vector_of<std::int32_t>(source_mask),
      .target_mask = vector_of<std::int32_t>(target_mask),
      .overlap = named<CellOverlap>("overlap", overlap),
  };
  Remap found = watched(
      source.num_cells() + target.num_cells(), threads, listener,
      [&](const Execution& execution) { return remap(source, target, options, execution); });
  return {std::move(found.weights), std::move(found.source), std::move(found.target),
          std::array{to_array<double>(std::move(found.source_areas)),
                     to_array<double>(std::move(found.target_areas)),
                     to_array<double>(std::move(found.source_fractions)),
                     to_array<double>(std::move(found.target_fractions))}};
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
  module.def("remap", &remap_of, nb::arg("source"), nb::arg("target"), nb::arg("order"),
             nb::arg("norm").none(), nb::arg("source_mask").noconvert(),
             nb::arg("target_mask").noconvert(), nb::arg("overlap").none(), nb::arg("threads"),
             nb::arg("progress").none());
  module.def("write_remap", &write_remap, nb::arg("path"), nb::arg("format"), nb::arg("weights"),
             nb::arg("source"), nb::arg("target"), nb::arg("measures"), nb::arg("norm").none(),
             nb::arg("order"));
}

}  // namespace rondel::python
