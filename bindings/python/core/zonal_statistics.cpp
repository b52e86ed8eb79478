// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/zonal_statistics.h"

#include <nanobind/stl/string.h>

#include <cstddef>
#include <string>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "rondel/remap.h"

namespace rondel::python {
namespace {

using ZonalFieldsIn = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

// Returns the numbers of all statistics one after the other, each shape (fields, zones).
ArrayOut<double> statistics_of(const Remap& remap, const std::string& list,
                               const ZonalFieldsIn& fields, nb::handle weights, double max_missing,
                               unsigned threads) {
  const std::vector<ZonalStatistic> statistics = zonal_statistics_of(list);
  const ZonalOptions options{named<ZonalWeights>("weights", weights), max_missing};
  const std::size_t size = statistics.size() * fields.shape(0) * remap.target_areas.size();
  return to_array<double>(watched_quietly(fields.size(), threads, [&](const Execution& execution) {
    std::vector<double> out(size);
    zonal_statistics(remap, statistics, {fields.data(), fields.size()}, out, fields.shape(0),
                     options, execution);
    return out;
  }));
}

}  // namespace

void add_zonal_statistics(nb::module_& module) {
  module.def(
      "names_of_statistics",
      [](const std::string& list) {
        nb::list names;
        for (const ZonalStatistic& statistic : zonal_statistics_of(list)) {
          names.append(nb::str(statistic.name().c_str()));
        }
        return names;
      },
      nb::arg("list"));
  module.def("zonal_statistics", &statistics_of, nb::arg("remap"), nb::arg("list"),
             nb::arg("fields").noconvert(), nb::arg("weights").none(), nb::arg("max_missing"),
             nb::arg("threads"));
}

}  // namespace rondel::python
