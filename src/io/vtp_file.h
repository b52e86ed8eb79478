// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes VTK's XML PolyData (.vtp), the format of ParaView: an XML head that describes the arrays,
// then their bytes ("appended raw", little-endian, each array after its length as a UInt64).
//
// in    points, polygons of them, and arrays of data for each point or polygon
// out   a file
// index points, from 0; polygons in the order of their offsets
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "io/binary.h"

namespace rondel::io {

// An array of the file; its numbers are computed when they are written.
struct VtpArray {
  std::string name;
  std::string type;  // Float64, Int64, UInt8
  int components = 1;
  std::uint64_t num_bytes = 0;
  std::function<void(AtomicFile&)> write;  // writes exactly that many bytes
};

// Returns an array of `count` numbers of 8 bytes or of one; value(i) is number i.
template <typename T, typename Value>
VtpArray vtp_array(const char* name, std::size_t count, Value value) {
  constexpr bool is_real = std::is_floating_point_v<T>;
  return {name, is_real ? "Float64" : (sizeof(T) == 1 ? "UInt8" : "Int64"), 1, count * sizeof(T),
          [count, value](AtomicFile& file) { write_values<T>(file, count, value); }};
}

// Returns the array of the coordinates of points, which must live until it is written.
inline VtpArray vtp_points(std::span<const Point> points) {
  return {"Points", "Float64", 3, points.size_bytes(),
          [points](AtomicFile& file) { file.write(NumberBytes(points)); }};
}

// The arrays of a file.
struct VtpMesh {
  std::size_t num_points = 0;
  std::size_t num_polys = 0;
  VtpArray points;        // Float64, 3 components
  VtpArray connectivity;  // Int64: the points of all polygons, one after the other
  VtpArray offsets;       // Int64: the end of each polygon in `connectivity`
  std::vector<VtpArray> point_data;
  std::vector<VtpArray> cell_data;
};

void write_vtp(AtomicFile& file, const VtpMesh& mesh);

}  // namespace rondel::io
