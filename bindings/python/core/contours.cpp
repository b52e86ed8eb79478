// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/contours.h"

#include <cstdint>
#include <type_traits>

#include "arrays.h"
#include "file_name.h"
#include "interrupt.h"
#include "module.h"

namespace rondel::python {
namespace {

template <class Contours>
Contours traced(const Triangulation& t, const NumbersIn& values, const NumbersIn& levels,
                unsigned threads) {
  return watched_quietly(t.num_sites(), threads, [&](const Execution& execution) {
    if constexpr (std::is_same_v<Contours, Isolines>) {
      return isolines(t, rows_of<double>(values), rows_of<double>(levels), execution);
    } else {
      return bands(t, rows_of<double>(values), rows_of<double>(levels), execution);
    }
  });
}

std::size_t num_points(const Isolines& isolines) { return isolines.lines.rows.values.size(); }
std::size_t num_points(const Bands& bands) { return bands.rings().values.size(); }

template <class Contours, auto write>
std::optional<nb::bytes> write_contours(const PathOut& path, const Contours& contours,
                                        double tolerance_deg) {
  return written(path, [&](const FileName& file) {
    run_watched(num_points(contours), 0, nb::none(), [&](const Execution& execution) {
      write(file, contours, tolerance_deg, execution);
    });
  });
}

}  // namespace

void add_contours(nb::module_& module) {
  nb::class_<Isolines> lines(module, "Isolines");
  lines.def(nb::init<>());
  add_array<double, &Isolines::levels>(lines, "levels");
  using Rows = CompressedRows<Point>;
  using Groups = RowGroups<Rows>;
  add_array<std::int64_t, &Isolines::lines, &Groups::offsets>(lines, "level_offsets");
  add_array<std::int64_t, &Isolines::lines, &Groups::rows, &Rows::offsets>(lines, "line_offsets");
  add_array<std::uint8_t, &Isolines::is_closed>(lines, "is_closed");
  add_array<double, &Isolines::lines, &Groups::rows, &Rows::values>(lines, "points");
  nb::class_<Bands> regions(module, "Bands");
  regions.def(nb::init<>());
  add_array<double, &Bands::levels>(regions, "levels");
  constexpr auto polygons = &RowGroups<Groups>::rows;
  add_array<std::int64_t, &Bands::bands, &RowGroups<Groups>::offsets>(regions, "band_offsets");
  add_array<std::int64_t, &Bands::bands, polygons, &Groups::offsets>(regions, "polygon_offsets");
  add_array<std::int64_t, &Bands::bands, polygons, &Groups::rows, &Rows::offsets>(regions,
                                                                                  "ring_offsets");
  add_array<double, &Bands::bands, polygons, &Groups::rows, &Rows::values>(regions, "points");
  module.def("isolines", &traced<Isolines>, nb::arg("triangulation"), nb::arg("values").noconvert(),
             nb::arg("levels").noconvert(), nb::arg("threads"));
  module.def("bands", &traced<Bands>, nb::arg("triangulation"), nb::arg("values").noconvert(),
             nb::arg("levels").noconvert(), nb::arg("threads"));
  module.def("write_isolines", &write_contours<Isolines, write_isolines>, nb::arg("path").none(),
             nb::arg("isolines"), nb::arg("tolerance_deg"));
  module.def("write_bands", &write_contours<Bands, write_bands>, nb::arg("path").none(),
             nb::arg("bands"), nb::arg("tolerance_deg"));
}

}  // namespace rondel::python
