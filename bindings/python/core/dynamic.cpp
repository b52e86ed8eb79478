// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/dynamic.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "query_answers.h"
#include "rondel/query.h"
#include "shared.h"

namespace rondel::python {
namespace {

class SharedDynamic : public Shared<DynamicTriangulation> {
 public:
  explicit SharedDynamic(const Options& options) : Shared(std::in_place, options) {}
  explicit SharedDynamic(const Triangulation& triangulation)
      : Shared(std::in_place, triangulation), threads_(threads_of(triangulation)) {}

  // Changes `size` sites with so many threads, by default as many as the first sites had; Ctrl-C ends
  // it.
  void change_many(
      std::size_t size,
      const std::function<void(DynamicTriangulation&, const Execution& execution)>& change,
      std::optional<unsigned> threads = {}) {
    run_watched(size, threads.value_or(threads_), nb::none(), [&](const Execution& execution) {
      const std::unique_lock lock(mutex_);
      change(value_, execution);
    });
  }

 private:
  unsigned threads_ = 0;  // for builds that changes cause; 0: one for each core
};

template <auto get>
auto number_getter() {
  return [](const SharedDynamic& self) {
    return self.ask([](const DynamicTriangulation& t) { return (t.*get)(); });
  };
}

void add_changes(nb::class_<SharedDynamic>& type) {
  type.def(
          "insert",
          [](SharedDynamic& self, const PointsIn& points) {
            std::vector<Index> ids;
            self.change_many(points.shape(0), [&](DynamicTriangulation& t, const Execution& e) {
              ids = t.insert(points_of(points), e);
            });
            return indices_out(std::move(ids));
          },
          nb::arg("points").noconvert())
      .def(
          "insert_one",
          [](SharedDynamic& self, const std::array<double, 3>& point) {
            return self.change([&](DynamicTriangulation& t) { return t.insert(point_of(point)); });
          },
          nb::arg("point"))
      .def(
          "insert_near",
          [](SharedDynamic& self, const std::array<double, 3>& point, Index hint) {
            return self.change(
                [&](DynamicTriangulation& t) { return t.insert(point_of(point), hint); });
          },
          nb::arg("point"), nb::arg("hint"))
      .def(
          "remove",
          [](SharedDynamic& self, const IndicesIn& ids) {
            self.change_many(ids.shape(0), [&](DynamicTriangulation& t, const Execution& e) {
              t.remove(rows_of<Index>(ids), e);
            });
          },
          nb::arg("ids").noconvert())
      .def(
          "move",
          [](SharedDynamic& self, const IndicesIn& ids, const PointsIn& to) {
            self.change_many(ids.shape(0), [&](DynamicTriangulation& t, const Execution& e) {
              t.move(rows_of<Index>(ids), points_of(to), e);
            });
          },
          nb::arg("ids").noconvert(), nb::arg("to").noconvert())
      .def(
          "move_all",
          [](SharedDynamic& self, const PointsIn& to, std::optional<unsigned> threads) {
            const auto change = [&](DynamicTriangulation& t, const Execution& e) {
              t.move_all(points_of(to), e);
            };
            self.change_many(to.shape(0), change, threads);
          },
          nb::arg("to").noconvert(), nb::arg("threads").none());
}

void add_sites(nb::class_<SharedDynamic>& type) {
  type.def_prop_ro("num_sites", number_getter<&DynamicTriangulation::num_sites>())
      .def_prop_ro("num_vertices", number_getter<&DynamicTriangulation::num_vertices>())
      .def_prop_ro("num_faces", number_getter<&DynamicTriangulation::num_faces>())
      .def_prop_ro("dimension", number_getter<&DynamicTriangulation::dimension>())
      .def("site_ids",
           [](const SharedDynamic& self) {
             return indices_out(self.ask([](const DynamicTriangulation& t) { return t.ids(); }));
           })
      .def("contains",
           [](const SharedDynamic& self, Index id) {
             return self.ask([&](const DynamicTriangulation& t) { return t.contains(id); });
           })
      .def("site",
           [](const SharedDynamic& self, Index id) {
             const Point p = self.ask([&](const DynamicTriangulation& t) { return t.site(id); });
             return std::tuple(p.x, p.y, p.z);
           })
      .def("representative",
           [](const SharedDynamic& self, Index id) {
             return self.ask([&](const DynamicTriangulation& t) { return t.representative(id); });
           })
      .def("is_vertex",
           [](const SharedDynamic& self, Index id) {
             return self.ask([&](const DynamicTriangulation& t) { return t.is_vertex(id); });
           })
      .def("neighbors",
           [](const SharedDynamic& self, Index id) {
             return indices_out(
                 self.ask([&](const DynamicTriangulation& t) { return t.neighbors(id); }));
           })
      .def("snapshot", [](const SharedDynamic& self) {
        Snapshot now = self.ask([](const DynamicTriangulation& t) { return t.snapshot(); });
        return std::tuple(indices_out(std::move(now.ids)), std::move(now.triangulation));
      });
}

void add_queries(nb::class_<SharedDynamic>& type) {
  type.def(
          "locate",
          [](const SharedDynamic& self, const PointsIn& queries, unsigned threads) {
            return self.ask([&](const DynamicTriangulation& t) {
              const Locator locator(t);
              std::vector<Triple> corners;
              const std::vector<Location> found =
                  locator.locate(points_of(queries), {.threads = threads});
              corners.reserve(found.size());
              for (const Location& location : found) corners.push_back(location.sites);
              const nb::gil_scoped_acquire acquired;
              return to_array<std::int32_t>(std::move(corners));
            });
          },
          nb::arg("queries").noconvert(), nb::arg("threads"))
      .def(
          "nearest",
          [](const SharedDynamic& self, const PointsIn& queries, unsigned threads) {
            return indices_out(self.ask([&](const DynamicTriangulation& t) {
              return Locator(t).nearest(points_of(queries), {.threads = threads});
            }));
          },
          nb::arg("queries").noconvert(), nb::arg("threads"))
      .def(
          "k_nearest",
          [](const SharedDynamic& self, const PointsIn& queries, std::size_t k, unsigned threads) {
            return indices_out(self.ask([&](const DynamicTriangulation& t) {
              return Locator(t).k_nearest(points_of(queries), k, {.threads = threads});
            }));
          },
          nb::arg("queries").noconvert(), nb::arg("k"), nb::arg("threads"))
      .def(
          "within",
          [](const SharedDynamic& self, const PointsIn& queries, double angle, unsigned threads) {
            return site_lists_out(self.ask([&](const DynamicTriangulation& t) {
              return Locator(t).within(points_of(queries), angle, {.threads = threads});
            }));
          },
          nb::arg("queries").noconvert(), nb::arg("angle"), nb::arg("threads"))
      .def(
          "distance",
          [](const SharedDynamic& self, const PointsIn& queries, const IndicesIn& ids) {
            return to_array<double>(self.ask([&](const DynamicTriangulation& t) {
              return distances(Locator(t), points_of(queries), rows_of<Index>(ids));
            }));
          },
          nb::arg("queries").noconvert(), nb::arg("ids").noconvert());
}

}  // namespace

void add_dynamic(nb::module_& module) {
  nb::class_<SharedDynamic> type(module, "DynamicTriangulation");
  type.def(
          "__init__",
          [](SharedDynamic* self, bool is_weighted, const std::array<double, 3>& center,
             double squared_radius) {
            new (self) SharedDynamic(make_options(is_weighted, center, squared_radius));
          },
          nb::arg("is_weighted"), nb::arg("center"), nb::arg("squared_radius"))
      .def(
          "__init__",
          [](SharedDynamic* self, const Triangulation& t) {
            const nb::gil_scoped_release released;
            new (self) SharedDynamic(t);
          },
          nb::arg("triangulation"));
  add_changes(type);
  add_sites(type);
  add_queries(type);
}

}  // namespace rondel::python
