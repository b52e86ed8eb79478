// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "rondel/named_grids.h"
#include "rondel/remap.h"
#include "rondel/weight_check.h"
#include "rondel/weight_comparison.h"
#include "rondel/weight_files.h"

namespace rondel::python {
namespace {

void add_reports(nb::module_& module) {
  nb::class_<WeightFault>(module, "WeightFault")
      .def_ro("kind", &WeightFault::kind)
      .def_ro("count", &WeightFault::count)
      .def_ro("what", &WeightFault::what);
  nb::class_<WeightReport>(module, "WeightReport")
      .def_ro("faults", &WeightReport::faults)
      .def_ro("empty_rows", &WeightReport::empty_rows)
      .def_ro("least", &WeightReport::least)
      .def_ro("greatest", &WeightReport::greatest)
      .def_ro("row_sums", &WeightReport::worst_row)
      .def_ro("column_sums", &WeightReport::worst_column);
  nb::class_<ComparedRow>(module, "ComparedRow")
      .def_ro("target", &ComparedRow::target)
      .def_prop_ro("lon", [](const ComparedRow& row) { return row.place.lon_deg; })
      .def_prop_ro("lat", [](const ComparedRow& row) { return row.place.lat_deg; })
      .def_ro("error", &ComparedRow::error)
      .def_ro("wrong", &ComparedRow::wrong)
      .def_ro("sum", &ComparedRow::sum)
      .def_ro("exact_sum", &ComparedRow::exact_sum)
      .def_prop_ro("source", [](const ComparedRow& row) { return row.worst.source; })
      .def_prop_ro("given", [](const ComparedRow& row) { return row.worst.given; })
      .def_prop_ro("exact", [](const ComparedRow& row) { return row.worst.exact; });
  nb::class_<WeightComparison>(module, "WeightComparison")
      .def_ro("faults", &WeightComparison::faults)
      .def_prop_ro("norm",
                   [](const WeightComparison& self) { return std::string(name_of(self.norm)); })
      .def_ro("sums_only", &WeightComparison::are_sums)
      .def_ro("pieces", &WeightComparison::pieces)
      .def_ro("max_error", &WeightComparison::max_error)
      .def_ro("mean_error", &WeightComparison::mean_error)
      .def_ro("rms_error", &WeightComparison::rms_error)
      .def_prop_ro("errors", [](const WeightComparison& self) { return self.errors.counts; })
      .def_ro("row_sums", &WeightComparison::row_sums)
      .def_ro("local_conservation", &WeightComparison::local_conservation)
      .def_ro("global_conservation", &WeightComparison::global_conservation)
      .def_ro("source_areas", &WeightComparison::source_areas)
      .def_ro("target_areas", &WeightComparison::target_areas)
      .def_ro("worst_rows", &WeightComparison::worst_rows);
}

}  // namespace

void add_weight_checks(nb::module_& module) {
  add_reports(module);
  module.def(
      "is_grid_name", [](const std::string& text) { return NamedGrid::is_name(text); },
      nb::arg("text"));
  module.def(
      "read_weights_to_check",
      [](const std::string& path, std::uint64_t num_sources, std::uint64_t num_targets) {
        const WeightReadOptions options{num_sources, num_targets, true};
        return unlocked([&] { return read_weights(path, options); });
      },
      nb::arg("path"), nb::arg("num_sources"), nb::arg("num_targets"));
  module.def(
      "weight_file",
      [](Remap& remap) { return unlocked([&] { return weight_file(std::move(remap)); }); },
      nb::arg("remap"));
  module.def(
      "check_weights",
      [](const WeightFile& file, bool allow_negative, bool is_conservative, bool targets_overlap) {
        return unlocked([&] {
          return check_weights(file, {allow_negative, is_conservative, targets_overlap});
        });
      },
      nb::arg("file"), nb::arg("allow_negative"), nb::arg("is_conservative"),
      nb::arg("targets_overlap"));
  module.def(
      "compare_weights",
      [](const WeightFile& file, const CellSet& source, const CellSet& target, double tolerance,
         nb::handle overlap, unsigned threads, const nb::object& progress) {
        WeightComparisonOptions options;
        options.tolerance = tolerance;
        options.overlap = named<CellOverlap>("overlap", overlap);
        return watched(source.num_cells() + target.num_cells(), threads, progress,
                       [&](const Execution& execution) {
                         return compare_weights(file, source, target, options, execution);
                       });
      },
      nb::arg("file"), nb::arg("source"), nb::arg("target"), nb::arg("tolerance"),
      nb::arg("overlap").none(), nb::arg("threads"), nb::arg("progress").none());
}

}  // namespace rondel::python
