// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays between NumPy and the library, without copies.
//
// 1. Input arrays are C-contiguous float64 or uint32 memory of the caller, used in place. Before
//    the call the Python package converts whatever else users pass, and copies what an object
//    keeps.
// 2. Indices are returned as int32: no index of the library reaches 2^31 (max_sites), and
//    `no_index`, all of whose bits are set, becomes -1. Offsets are returned as int64.
// 3. A returned vector moves into a capsule that owns it; an array of an object refers to the
//    object, keeps it alive and is read-only.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "rondel/sites.h"
#include "rondel/types.h"

namespace rondel::python {

namespace nb = nanobind;

using PointsIn = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using PairsIn = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using NumbersIn = nb::ndarray<const double, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using OffsetsIn = nb::ndarray<const std::int64_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using IndicesIn = nb::ndarray<const std::int32_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using TriplesIn = nb::ndarray<const std::int32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using IndexPairsIn =
    nb::ndarray<const std::int32_t, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;

template <class T>
using ArrayOut = nb::ndarray<nb::numpy, T, nb::c_contig>;

// Returns rows of an array as structures of numbers of one type.
template <class Row, class Array>
std::span<const Row> rows_of(const Array& array) {
  static_assert(sizeof(Row) % sizeof(*array.data()) == 0);
  return {reinterpret_cast<const Row*>(array.data()), array.shape(0)};
}
// Returns a copy of the same.
template <class Row, class Array>
std::vector<Row> vector_of(const Array& array) {
  const std::span<const Row> rows = rows_of<Row>(array);
  return {rows.begin(), rows.end()};
}
inline std::span<const Point> points_of(const PointsIn& array) { return rows_of<Point>(array); }

// Returns the points as sites, which keep the array alive.
inline Sites sites_of(const PointsIn& array) {
  std::shared_ptr<const PointsIn> owner(new PointsIn(array), [](const PointsIn* kept) {
    const nb::gil_scoped_acquire acquired;
    delete kept;
  });
  return Sites::view(points_of(array), std::move(owner));
}

inline Point point_of(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

// The number of columns of Row as an array of T; 0 for an array of one dimension.
template <class T, class Row>
constexpr std::size_t columns_of = sizeof(Row) == sizeof(T) ? 0 : sizeof(Row) / sizeof(T);

template <class T, class Row, class Pointer>
ArrayOut<T> make_array(Pointer data, std::size_t count, nb::handle owner) {
  static T nothing[3] = {};  // an empty array must have an address too
  const std::size_t shape[2] = {count, columns_of<T, Row>};
  T* first = count == 0 ? nothing : reinterpret_cast<T*>(data);
  return ArrayOut<T>(first, shape[1] == 0 ? 1 : 2, shape, owner);
}

// Returns the vector as an array that owns it.
template <class T, class Row>
ArrayOut<T> to_array(std::vector<Row>&& rows) {
  auto* kept = new std::vector<Row>(std::move(rows));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<Row>*>(p); });
  return make_array<T, Row>(kept->data(), kept->size(), owner);
}

// Returns an array that keeps an object of Python alive.
template <class T, class Row>
ArrayOut<const T> array_of(const nb::object& owner, std::span<const Row> rows) {
  return make_array<const T, Row>(rows.data(), rows.size(), owner);
}

// Returns a member of an object, or a member of it and so on.
template <auto member, auto... inner, class Object>
auto& part_of(Object& object) {
  if constexpr (sizeof...(inner) == 0) {
    return object.*member;
  } else {
    return part_of<inner...>(object.*member);
  }
}

// The vector that is a member of an object, or a member of its member and so on.
template <class Object, auto... members>
using PartOf = std::remove_cvref_t<decltype(part_of<members...>(std::declval<Object&>()))>;

// Returns a vector of an object as an array that refers to it.
template <class T, class Object, auto... members>
ArrayOut<const T> array_of_part(const nb::object& self) {
  const PartOf<Object, members...>& rows = part_of<members...>(nb::cast<const Object&>(self));
  return array_of<T>(self, std::span(rows));
}

// Adds a vector of an object as an array that refers to it.
template <class T, auto... members, class Object>
void add_fixed_array(nb::class_<Object>& type, const char* name) {
  type.def_prop_ro(name, &array_of_part<T, Object, members...>);
}

// Adds the same, and an assignment, which copies an array into the vector. It is for objects that
// nobody has seen yet, as they are made of what was pickled: the vector's memory may move.
template <class T, auto... members, class Object>
void add_array(nb::class_<Object>& type, const char* name) {
  using Row = typename PartOf<Object, members...>::value_type;
  using Given = nb::ndarray<const T, nb::c_contig, nb::device::cpu>;
  type.def_prop_rw(
      name, &array_of_part<T, Object, members...>, [](Object& self, const Given& given) {
        const auto* const rows = reinterpret_cast<const Row*>(given.data());
        part_of<members...>(self).assign(rows, rows + given.size() * sizeof(T) / sizeof(Row));
      });
}

inline ArrayOut<std::int32_t> indices_out(std::vector<Index>&& indices) {
  return to_array<std::int32_t>(std::move(indices));
}
inline ArrayOut<std::int64_t> offsets_out(std::vector<std::uint64_t>&& offsets) {
  return to_array<std::int64_t>(std::move(offsets));
}
inline ArrayOut<double> points_out(std::vector<Point>&& points) {
  return to_array<double>(std::move(points));
}

}  // namespace rondel::python
