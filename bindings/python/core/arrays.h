// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays between NumPy and the library, without copies.
//
// 1. What comes in is C-contiguous float64 or uint32 memory of the caller, used where it lies. The
//    package converts whatever else users pass before it calls, and copies what an object keeps.
// 2. Indices go out as int32: no index of the library reaches 2^31 (max_sites), and `no_index`, all
//    bits set, is -1. Offsets go out as int64.
// 3. A vector that goes out moves into a capsule that owns it; an array of an object refers to the
//    object, keeps it alive and cannot be written to.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
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

// Structures of numbers of one type lie in memory as rows of an array.
template <class Row, class Array>
std::span<const Row> rows_of(const Array& array) {
  static_assert(sizeof(Row) % sizeof(*array.data()) == 0);
  return {reinterpret_cast<const Row*>(array.data()), array.shape(0)};
}
inline std::span<const Point> points_of(const PointsIn& array) { return rows_of<Point>(array); }

// The points as sites, which keep the array.
inline Sites sites_of(const PointsIn& array) {
  std::shared_ptr<const PointsIn> owner(new PointsIn(array), [](const PointsIn* kept) {
    const nb::gil_scoped_acquire acquired;
    delete kept;
  });
  return Sites::view(points_of(array), std::move(owner));
}

inline Point point_of(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

// Columns of Row as an array of T; 0 for an array of one dimension.
template <class T, class Row>
constexpr std::size_t columns_of = sizeof(Row) == sizeof(T) ? 0 : sizeof(Row) / sizeof(T);

template <class T, class Row, class Pointer>
ArrayOut<T> make_array(Pointer data, std::size_t count, nb::handle owner) {
  static T nothing[3] = {};  // an empty array, too, has an address
  const std::size_t shape[2] = {count, columns_of<T, Row>};
  T* first = count == 0 ? nothing : reinterpret_cast<T*>(data);
  return ArrayOut<T>(first, shape[1] == 0 ? 1 : 2, shape, owner);
}

// The vector as an array that owns it.
template <class T, class Row>
ArrayOut<T> to_array(std::vector<Row>&& rows) {
  auto* kept = new std::vector<Row>(std::move(rows));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<Row>*>(p); });
  return make_array<T, Row>(kept->data(), kept->size(), owner);
}

// The array of an object that lives in Python.
template <class T, class Row>
ArrayOut<const T> array_of(const nb::object& owner, std::span<const Row> rows) {
  return make_array<const T, Row>(rows.data(), rows.size(), owner);
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
