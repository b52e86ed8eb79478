// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/contours.h"

#include <cstdint>
#include <span>
#include <string>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"

namespace rondel::python {
namespace {

// Returns a getter of an array of the object `self`, which is of the class Contours.
template <class T, class Contours, auto member>
auto contour_array() {
  return [](const nb::object& self) {
    const auto& rows = nb::cast<const Contours&>(self).*member;
    return array_of<T>(self, std::span(rows));
  };
}

template <class Contours, auto trace>
Contours traced(const Triangulation& t, const NumbersIn& values, const NumbersIn& levels,
                unsigned threads) {
  return watched_quietly(t.num_sites(), threads, [&](const Execution& execution) {
    return trace(t, rows_of<double>(values), rows_of<double>(levels), execution);
  });
}

template <class Contours, auto write>
void write_contours(const std::string& path, const Contours& contours, double tolerance_deg,
                    unsigned threads) {
  run_watched(contours.points.size(), threads, nb::none(),
              [&](const Execution& execution) { write(path, contours, tolerance_deg, execution); });
}

}  // namespace

void add_contours(nb::module_& module) {
  nb::class_<Isolines>(module, "Isolines")
      .def_prop_ro("levels", contour_array<double, Isolines, &Isolines::levels>())
      .def_prop_ro("level_offsets",
                   contour_array<std::int64_t, Isolines, &Isolines::level_offsets>())
      .def_prop_ro("line_offsets", contour_array<std::int64_t, Isolines, &Isolines::line_offsets>())
      .def_prop_ro("is_closed", contour_array<std::uint8_t, Isolines, &Isolines::is_closed>())
      .def_prop_ro("points", contour_array<double, Isolines, &Isolines::points>());
  nb::class_<Bands>(module, "Bands")
      .def_prop_ro("levels", contour_array<double, Bands, &Bands::levels>())
      .def_prop_ro("band_offsets", contour_array<std::int64_t, Bands, &Bands::band_offsets>())
      .def_prop_ro("polygon_offsets", contour_array<std::int64_t, Bands, &Bands::polygon_offsets>())
      .def_prop_ro("ring_offsets", contour_array<std::int64_t, Bands, &Bands::ring_offsets>())
      .def_prop_ro("points", contour_array<double, Bands, &Bands::points>());
  module.def("isolines", &traced<Isolines, isolines>, nb::arg("triangulation"),
             nb::arg("values").noconvert(), nb::arg("levels").noconvert(), nb::arg("threads"));
  module.def("bands", &traced<Bands, bands>, nb::arg("triangulation"),
             nb::arg("values").noconvert(), nb::arg("levels").noconvert(), nb::arg("threads"));
  module.def("write_isolines", &write_contours<Isolines, write_isolines>, nb::arg("path"),
             nb::arg("isolines"), nb::arg("tolerance_deg"), nb::arg("threads"));
  module.def("write_bands", &write_contours<Bands, write_bands>, nb::arg("path"), nb::arg("bands"),
             nb::arg("tolerance_deg"), nb::arg("threads"));
}

}  // namespace rondel::python
