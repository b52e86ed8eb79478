// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// VTK's XML PolyData (.vtp), the format of ParaView: an XML head that describes the arrays, then
// their bytes ("appended raw", little-endian, each after its length in a UInt64).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/atomic_file.h"

namespace rondel::io {

struct VtpArray {
  std::string name;
  std::string type;  // Float64, Int64, UInt32, UInt8
  int components = 1;
  std::uint64_t num_bytes = 0;
  std::function<void(AtomicFile&)> write;  // writes exactly that many bytes
};

struct VtpMesh {
  std::size_t num_points = 0;
  std::size_t num_polys = 0;
  VtpArray points;        // Float64, 3 components
  VtpArray connectivity;  // Int64: the points of all polygons, one after the other
  VtpArray offsets;       // Int64: where each polygon ends in it
  std::vector<VtpArray> point_data;
  std::vector<VtpArray> cell_data;
};

void write_vtp(AtomicFile& file, const VtpMesh& mesh);

}  // namespace rondel::io
