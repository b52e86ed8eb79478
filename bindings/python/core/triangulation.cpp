// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/triangulation.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "rondel/check.h"
#include "rondel/delaunay.h"
#include "rondel/hull.h"
#include "rondel/weight_files.h"

namespace rondel::python {
namespace {

using Center = std::array<double, 3>;

Triangulation build(const PointsIn& points, bool is_weighted, const Center& center,
                    double squared_radius, unsigned threads, const nb::object& listener) {
  Sites sites = sites_of(points);
  return watched(points.shape(0), threads, listener, [&](const Execution& execution) {
    return delaunay(std::move(sites), make_options(is_weighted, center, squared_radius), execution);
  });
}

Triangulation build_hull(const PointsIn& points, unsigned threads, const nb::object& listener) {
  Sites sites = sites_of(points);
  return watched(points.shape(0), threads, listener, [&](const Execution& execution) {
    return convex_hull(std::move(sites), execution);
  });
}

// Makes a triangulation of the arrays of a pickle, which may have been changed.
Triangulation from_arrays(const PointsIn& points, int dimension, bool is_weighted,
                          const Center& center, double squared_radius, const TriplesIn& faces,
                          const TriplesIn& neighbors, const IndicesIn& ghost_faces,
                          const IndicesIn& ring, const IndexPairsIn& duplicates,
                          const IndexPairsIn& hidden) {
  return Triangulation::from_arrays(sites_of(points),
                                    {.dimension = dimension,
                                     .faces = rows_of<Triple>(faces),
                                     .neighbors = rows_of<Triple>(neighbors),
                                     .ghost_faces = rows_of<Index>(ghost_faces),
                                     .ring = rows_of<Index>(ring),
                                     .duplicates = rows_of<Duplicate>(duplicates),
                                     .hidden = rows_of<Hidden>(hidden)},
                                    make_options(is_weighted, center, squared_radius));
}

nb::dict report_of(const Triangulation& t) {
  const BuildReport& report = t.report();
  nb::dict rungs;
  rungs["filter"] = report.rungs.filter;
  rungs["extended"] = report.rungs.extended;
  rungs["double_double"] = report.rungs.double_double;
  rungs["close"] = report.rungs.close;
  rungs["exact"] = report.rungs.exact;
  rungs["perturbed"] = report.rungs.perturbed;
  nb::dict result;
  result["builder"] = name_of(report.builder);
  result["threads"] = report.threads;
  result["order_seconds"] = report.order_seconds;
  result["triangulate_seconds"] = report.triangulate_seconds;
  result["rungs"] = rungs;
  return result;
}

// Returns a getter of an array of the object `self`.
template <class T, auto get>
auto array_getter() {
  return [](const nb::object& self) {
    const auto rows = (nb::cast<const Triangulation&>(self).*get)();
    return array_of<T>(self, rows);
  };
}

std::tuple<double, double> volume_and_area(const Triangulation& hull) {
  const HullSize size = unlocked([&] { return size_of_hull(hull); });
  return {size.volume, size.area};
}

CheckReport check_faces(const PointsIn& points, const TriplesIn& faces, bool is_weighted,
                        const Center& center, double squared_radius, unsigned threads) {
  return watched_quietly(points.shape(0), threads, [&](const Execution& execution) {
    return check(points_of(points), rows_of<Triple>(faces),
                 make_options(is_weighted, center, squared_radius), execution);
  });
}

void add_triangulation_class(nb::module_& module) {
  nb::class_<Triangulation>(module, "Triangulation")
      .def_static("from_arrays", &from_arrays, nb::arg("points").noconvert(), nb::arg("dimension"),
                  nb::arg("is_weighted"), nb::arg("center"), nb::arg("squared_radius"),
                  nb::arg("faces").noconvert(), nb::arg("neighbors").noconvert(),
                  nb::arg("ghost_faces").noconvert(), nb::arg("ring").noconvert(),
                  nb::arg("duplicates").noconvert(), nb::arg("hidden").noconvert())
      .def_prop_ro("dimension", &Triangulation::dimension)
      .def_prop_ro("is_weighted",
                   [](const Triangulation& t) { return t.model() == Model::weighted; })
      .def_prop_ro("center",
                   [](const Triangulation& t) {
                     const Point& c = t.sphere().center;
                     return std::tuple(c.x, c.y, c.z);
                   })
      .def_prop_ro("squared_radius",
                   [](const Triangulation& t) { return t.sphere().squared_radius; })
      .def_prop_ro("num_sites", &Triangulation::num_sites)
      .def_prop_ro("num_vertices", &Triangulation::num_vertices)
      .def_prop_ro("num_faces", &Triangulation::num_faces)
      .def_prop_ro("points",
                   [](const nb::object& self) {
                     return array_of<double>(self,
                                             nb::cast<const Triangulation&>(self).sites().points());
                   })
      .def_prop_ro("faces", array_getter<std::int32_t, &Triangulation::faces>())
      .def_prop_ro("neighbors", array_getter<std::int32_t, &Triangulation::neighbors>())
      .def_prop_ro("ghost_faces", array_getter<std::int32_t, &Triangulation::ghost_faces>())
      .def_prop_ro("ring", array_getter<std::int32_t, &Triangulation::ring>())
      .def_prop_ro("duplicates", array_getter<std::int32_t, &Triangulation::duplicates>())
      .def_prop_ro("hidden", array_getter<std::int32_t, &Triangulation::hidden>())
      .def_prop_ro("report", &report_of);
}

}  // namespace

void add_triangulation(nb::module_& module) {
  add_triangulation_class(module);
  module.def("delaunay", &build, nb::arg("points").noconvert(), nb::arg("is_weighted"),
             nb::arg("center"), nb::arg("squared_radius"), nb::arg("threads"),
             nb::arg("progress").none());
  module.def("convex_hull", &build_hull, nb::arg("points").noconvert(), nb::arg("threads"),
             nb::arg("progress").none());
  module.def("size_of_hull", &volume_and_area, nb::arg("hull"));
  nb::class_<CheckReport>(module, "CheckReport")
      .def_ro("is_valid", &CheckReport::is_valid)
      .def_ro("reason", &CheckReport::reason)
      .def_ro("num_vertices", &CheckReport::num_vertices)
      .def_ro("num_edges", &CheckReport::num_edges)
      .def_ro("num_duplicates", &CheckReport::num_duplicates)
      .def_ro("num_hidden", &CheckReport::num_hidden);
  module.def("check", &check_faces, nb::arg("points").noconvert(), nb::arg("faces").noconvert(),
             nb::arg("is_weighted"), nb::arg("center"), nb::arg("squared_radius"),
             nb::arg("threads"));
  module.def(
      "unit_vectors",
      [](const PairsIn& lonlat) {
        return points_out(unlocked([&] { return unit_vectors(rows_of<LonLat>(lonlat)); }));
      },
      nb::arg("lonlat").noconvert());
  module.def(
      "lonlats",
      [](const PointsIn& points) {
        return to_array<double>(unlocked([&] { return lonlats(points_of(points)); }));
      },
      nb::arg("points").noconvert());
  module.def(
      "polar_points",
      [](const PointsIn& centers, const NumbersIn& radii_deg) {
        return points_out(
            unlocked([&] { return polar_points(points_of(centers), rows_of<double>(radii_deg)); }));
      },
      nb::arg("centers").noconvert(), nb::arg("radii_deg").noconvert());
  module.def(
      "polar_points_lonlat",
      [](const PairsIn& lonlat, const NumbersIn& radii_deg) {
        return points_out(unlocked(
            [&] { return polar_points(rows_of<LonLat>(lonlat), rows_of<double>(radii_deg)); }));
      },
      nb::arg("lonlat").noconvert(), nb::arg("radii_deg").noconvert());
}

}  // namespace rondel::python
