// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/dynamic_constrained.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/tuple.h>

#include <array>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "shared.h"

namespace rondel::python {
namespace {

using Ends = std::array<Index, 2>;
using Dynamic = DynamicConstrainedTriangulation;
using SharedConstrained = Shared<Dynamic>;

Sphere sphere_around(const std::array<double, 3>& center) {
  return make_options(false, center, 1).sphere;
}

template <auto get>
auto constrained_fact_getter() {
  return [](const SharedConstrained& self) {
    return self.ask([](const Dynamic& t) { return (t.*get)(); });
  };
}

template <auto get>
auto constrained_ids_getter() {
  return [](const SharedConstrained& self) {
    return indices_out(self.ask([](const Dynamic& t) { return (t.*get)(); }));
  };
}

// Asks about one site or constraint.
template <auto get>
auto vertices_getter() {
  return [](const SharedConstrained& self, Index id) {
    return indices_out(self.ask([id](const Dynamic& t) { return (t.*get)(id); }));
  };
}

void add_changes(nb::class_<SharedConstrained>& type) {
  type.def(
          "insert",
          [](SharedConstrained& self, const std::array<double, 3>& point) {
            return self.change([&](Dynamic& t) { return t.insert(point_of(point)); });
          },
          nb::arg("point"))
      .def(
          "insert_near",
          [](SharedConstrained& self, const std::array<double, 3>& point, Index hint) {
            return self.change([&](Dynamic& t) { return t.insert(point_of(point), hint); });
          },
          nb::arg("point"), nb::arg("hint"))
      .def(
          "remove",
          [](SharedConstrained& self, Index site) {
            self.change([&](Dynamic& t) { t.remove(site); });
          },
          nb::arg("site"))
      .def(
          "insert_constraint",
          [](SharedConstrained& self, Index first, Index second) {
            return self.change([&](Dynamic& t) { return t.insert_constraint(first, second); });
          },
          nb::arg("first"), nb::arg("second"))
      .def(
          "remove_constraint",
          [](SharedConstrained& self, Index constraint) {
            self.change([&](Dynamic& t) { t.remove_constraint(constraint); });
          },
          nb::arg("constraint"));
}

void add_facts(nb::class_<SharedConstrained>& type) {
  type.def_prop_ro("num_sites", constrained_fact_getter<&Dynamic::num_sites>())
      .def_prop_ro("num_faces", constrained_fact_getter<&Dynamic::num_faces>())
      .def_prop_ro("num_vertices", constrained_fact_getter<&Dynamic::num_vertices>())
      .def_prop_ro("num_constraints", constrained_fact_getter<&Dynamic::num_constraints>())
      .def_prop_ro("dimension", constrained_fact_getter<&Dynamic::dimension>())
      .def("site_ids", constrained_ids_getter<&Dynamic::site_ids>())
      .def("constraint_ids", constrained_ids_getter<&Dynamic::constraint_ids>())
      .def("neighbors", vertices_getter<&Dynamic::neighbors>())
      .def("chain", vertices_getter<&Dynamic::chain>())
      .def("contains",
           [](const SharedConstrained& self, Index site) {
             return self.ask([&](const Dynamic& t) { return t.contains(site); });
           })
      .def("constraint",
           [](const SharedConstrained& self, Index constraint) {
             const Ends ends = self.ask([&](const Dynamic& t) { return t.constraint(constraint); });
             return std::tuple(ends[0], ends[1]);
           })
      .def("representative",
           [](const SharedConstrained& self, Index site) {
             return self.ask([&](const Dynamic& t) { return t.representative(site); });
           })
      .def("site",
           [](const SharedConstrained& self, Index site) {
             const Point p = self.ask([&](const Dynamic& t) { return t.site(site); });
             return std::tuple(p.x, p.y, p.z);
           })
      .def("snapshot", [](const SharedConstrained& self) {
        std::vector<Ends> ends;
        ConstrainedSnapshot now = self.ask([&](const Dynamic& t) {
          ConstrainedSnapshot copy = t.snapshot();
          for (const Index id : copy.constraint_ids) ends.push_back(t.constraint(id));
          return copy;
        });
        return std::tuple(indices_out(std::move(now.site_ids)),
                          indices_out(std::move(now.constraint_ids)),
                          to_array<std::int32_t>(std::move(ends)), std::move(now.result));
      });
}

}  // namespace

void add_dynamic_constrained(nb::module_& module) {
  nb::class_<SharedConstrained> type(module, "DynamicConstrainedTriangulation");
  type.def(
      "__init__",
      [](SharedConstrained* self, const PointsIn& points, const IndexPairsIn& constraints,
         const std::array<double, 3>& center, unsigned threads) {
        run_watched(points.shape(0), threads, nb::none(), [&](const Execution& execution) {
          new (self) SharedConstrained(std::in_place, points_of(points), rows_of<Ends>(constraints),
                                       sphere_around(center), execution);
        });
      },
      nb::arg("points").noconvert(), nb::arg("constraints").noconvert(), nb::arg("center"),
      nb::arg("threads"));
  add_changes(type);
  add_facts(type);
}

}  // namespace rondel::python
