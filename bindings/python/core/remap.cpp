// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/remap.h"

#include <nanobind/stl/string.h>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"

namespace rondel::python {
namespace {

using PlainFieldsIn = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

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

// Applies weights of order 2 for several threads of Python, one after the other: it keeps the weights of the
// last field.
class SharedSecondOrder {
 public:
  SharedSecondOrder(const Remap& remap, const Weights& weights, const IndicesIn& covered,
                    nb::handle limiter)
      : second_(with_weights(remap, weights), vector_of<std::int32_t>(covered),
                named<RemapLimiter>("limiter", limiter)) {}

  void apply(std::span<const double> in, std::span<double> out, const ApplyOptions& rules,
             const Execution& execution) {
    const std::lock_guard lock(mutex_);
    second_.apply(in, out, rules, execution);
  }

 private:
  static Remap with_weights(Remap remap, const Weights& weights) {
    remap.weights = weights;
    return remap;
  }

  SecondOrderRemap second_;
  std::mutex mutex_;
};

ArrayOut<double> apply_second(SharedSecondOrder& self, const PlainFieldsIn& fields,
                              std::size_t num_targets, double fill, double max_missing,
                              unsigned threads, bool keeps_sums) {
  const std::size_t count = fields.shape(0) * num_targets;
  const std::span<const double> in(fields.data(), fields.size());
  return to_array<double>(watched_quietly(count, threads, [&](const Execution& execution) {
    std::vector<double> out(count);
    self.apply(in, out, {.fill = fill, .max_missing = max_missing, .keeps_sums = keeps_sums},
               execution);
    return out;
  }));
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
  add_array<std::int64_t, &Remap::pieces, &CompressedRows<Index>::offsets>(type, "offsets");
  add_array<std::int32_t, &Remap::pieces, &CompressedRows<Index>::values>(type, "columns");
  add_array<double, &Remap::areas>(type, "areas");
  add_array<double, &Remap::moments>(type, "moments");
  add_array<double, &Remap::source_centers>(type, "source_centers");
  nb::class_<SharedSecondOrder>(module, "SecondOrderRemap")
      .def(nb::init<const Remap&, const Weights&, const IndicesIn&, nb::handle>(), nb::arg("remap"),
           nb::arg("weights"), nb::arg("covered").noconvert(), nb::arg("limiter"))
      .def("apply", &apply_second, nb::arg("fields").noconvert(), nb::arg("num_targets"),
           nb::arg("fill"), nb::arg("max_missing"), nb::arg("threads"),
           nb::arg("keeps_sums") = false);
  add_array<double, &Remap::source_areas>(type, "source_areas");
  add_array<double, &Remap::target_areas>(type, "target_areas");
  add_array<double, &Remap::source_fractions>(type, "source_fractions");
  add_array<double, &Remap::target_fractions>(type, "target_fractions");
  module.def("remap", &remap_of, nb::arg("source"), nb::arg("target"), nb::kw_only(),
             nb::arg("order"), nb::arg("norm").none(), nb::arg("source_mask").noconvert(),
             nb::arg("target_mask").noconvert(), nb::arg("overlap").none(), nb::arg("threads"),
             nb::arg("progress").none());
  module.def(
      "told_areas",
      [](const CellSet& cells, const NumbersIn& areas) {
        return to_array<double>(told_areas(cells, vector_of<double>(areas)));
      },
      nb::arg("cells"), nb::arg("areas").noconvert());
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
