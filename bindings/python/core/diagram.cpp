// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/diagram.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"

namespace rondel::python {
namespace {

using Lists = CompressedRows<Index>;
using ListsOut = std::tuple<ArrayOut<std::int64_t>, ArrayOut<std::int32_t>>;

template <class Work>
auto watched_dual(const Triangulation& t, const Work& work) {
  return watched_quietly(t.num_sites(), threads_of(t),
                         [&](const Execution& execution) { return work(t, execution); });
}

Lists ring_neighbors(const Triangulation& t) {
  const auto ring = t.ring();
  const std::size_t count = ring.size();
  std::vector<std::size_t> place(t.num_sites(), count);
  for (std::size_t j = 0; j < count; ++j) place[ring[j]] = j;
  Lists lists;
  for (const std::size_t j : place) {
    if (j < count && count > 1) {
      const auto [low, high] = std::minmax({ring[(j + 1) % count], ring[(j + count - 1) % count]});
      lists.values.push_back(low);
      if (count > 2) lists.values.push_back(high);
    }
    lists.end_row();
  }
  return lists;
}

// Appends the neighbors of a vertex, counterclockwise from the lowest index, by going around it
// through its faces. Face f has corner i; the next face counterclockwise around that corner is
// across the edge to the corner before it.
void append_star(const Triangulation& t, Index first_face, Index site, std::vector<Index>& out) {
  const auto size = static_cast<std::ptrdiff_t>(out.size());
  Index face = first_face;
  do {
    const Triple& corners = t.faces()[face];
    const auto i =
        static_cast<std::size_t>(std::find(corners.begin(), corners.end(), site) - corners.begin());
    out.push_back(corners[(i + 1) % 3]);
    face = t.neighbors()[face][(i + 1) % 3];
  } while (face != first_face);
  std::rotate(out.begin() + size, std::min_element(out.begin() + size, out.end()), out.end());
}

Lists neighbor_lists(const Triangulation& t) {
  if (t.dimension() < 2) return ring_neighbors(t);
  std::vector<Index> a_face(t.num_sites(), no_index);
  for (std::size_t f = 0; f < t.num_faces(); ++f) {
    for (const Index v : t.faces()[f]) a_face[v] = static_cast<Index>(f);
  }
  Lists lists;
  lists.offsets.reserve(t.num_sites() + 1);
  lists.values.reserve(3 * t.num_faces());
  for (std::size_t v = 0; v < t.num_sites(); ++v) {
    if (a_face[v] != no_index) {
      append_star(t, a_face[v], static_cast<Index>(v), lists.values);
    }
    lists.end_row();
  }
  return lists;
}

// Returns the largest | |p - center| - radius |; a number that is not finite counts as infinite.
double largest_discrepancy(const PointsIn& points, const std::array<double, 3>& center,
                           double radius) {
  return unlocked([&] {
    double largest = 0;
    for (const Point& p : points_of(points)) {
      const double x = p.x - center[0];
      const double y = p.y - center[1];
      const double z = p.z - center[2];
      const double off = std::abs(std::sqrt(x * x + y * y + z * z) - radius);
      if (!(off <= largest)) largest = std::isnan(off) ? HUGE_VAL : off;
    }
    return largest;
  });
}

ListsOut lists_out(Lists&& lists) {
  return {offsets_out(std::move(lists.offsets)), indices_out(std::move(lists.values))};
}

// While it lives, Python's garbage collector is off, since it would visit all lists again and again
// while they grow in number.
class NoCollection {
 public:
  NoCollection() : was_enabled_(PyGC_Disable() != 0) {}
  ~NoCollection() {
    if (was_enabled_) PyGC_Enable();
  }
  NoCollection(const NoCollection&) = delete;
  NoCollection& operator=(const NoCollection&) = delete;

 private:
  bool was_enabled_;
};

template <class T>
T checked(PyObject* object) {
  if (object == nullptr) throw nb::python_error();
  return nb::steal<T>(object);
}

// Returns compressed rows as lists of integers. Each integer is a new object; sharing one object
// for equal numbers would scatter the accesses in memory, and took twice the time.
nb::list to_lists(const IndicesIn& items, const OffsetsIn& offsets) {
  const NoCollection none;
  const auto num_rows = static_cast<Py_ssize_t>(offsets.shape(0)) - 1;
  auto result = checked<nb::list>(PyList_New(num_rows));
  for (Py_ssize_t i = 0; i < num_rows; ++i) {
    const std::int32_t* first = items.data() + offsets.data()[i];
    const auto count = static_cast<Py_ssize_t>(offsets.data()[i + 1] - offsets.data()[i]);
    auto row = checked<nb::list>(PyList_New(count));
    for (Py_ssize_t j = 0; j < count; ++j) {
      PyList_SetItem(row.ptr(), j, checked<nb::int_>(PyLong_FromLong(first[j])).release().ptr());
    }
    PyList_SetItem(result.ptr(), i, row.release().ptr());
  }
  return result;
}

void add_diagram_class(nb::module_& module) {
  nb::class_<Diagram> type(module, "Diagram");
  add_fixed_array<std::int64_t, &Diagram::cells, &Cells::rings, &Lists::offsets>(type, "offsets");
  add_fixed_array<std::int32_t, &Diagram::cells, &Cells::rings, &Lists::values>(type, "rings");
  add_fixed_array<double, &Diagram::cells, &Cells::points>(type, "points");
  add_fixed_array<double, &Diagram::areas>(type, "areas");
}

}  // namespace

void add_diagram(nb::module_& module) {
  add_diagram_class(module);
  module.def(
      "diagram", [](const Triangulation& t) { return watched_dual(t, &diagram); },
      nb::arg("triangulation"));
  module.def(
      "circumcenters",
      [](const Triangulation& t) { return points_out(watched_dual(t, &circumcenters)); },
      nb::arg("triangulation"));
  module.def(
      "centroids", [](const Triangulation& t) { return points_out(watched_dual(t, &centroids)); },
      nb::arg("triangulation"));
  module.def(
      "edges",
      [](const Triangulation& t) {
        return to_array<std::int32_t>(unlocked([&] { return edges(t); }));
      },
      nb::arg("triangulation"));
  module.def(
      "neighbor_lists",
      [](const Triangulation& t) { return lists_out(unlocked([&] { return neighbor_lists(t); })); },
      nb::arg("triangulation"));
  module.def("lists", &to_lists, nb::arg("items").noconvert(), nb::arg("offsets").noconvert());
  module.def(
      "merge_cocircular",
      [](const Triangulation& t) -> ListsOut {
        return lists_out(watched_dual(t, &merge_cocircular));
      },
      nb::arg("triangulation"));
  module.def("largest_discrepancy", &largest_discrepancy, nb::arg("points").noconvert(),
             nb::arg("center"), nb::arg("radius"));
}

}  // namespace rondel::python
