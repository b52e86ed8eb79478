// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads and writes triangles as arrays (m, 3) of indices of sites.
#include <array>

#include "io/npy_header.h"
#include "io/number.h"
#include "io/triangle_formats.h"

namespace rondel::io {
namespace {

constexpr std::array<std::string_view, 4> index_types = {"u4", "i4", "u8", "i8"};

// Returns the rows of an array whose integers have the type T.
template <typename Integer>
std::vector<Triple> rows_of(const NpyTable& array) {
  std::vector<Triple> triangles;
  triangles.reserve(array.num_rows());
  for (std::size_t i = 0; i < array.num_rows(); ++i) {
    const auto corner = [&](std::size_t k) { return checked_index(array.at<Integer>(i, k)); };
    triangles.push_back(at_item("row", i, [&] { return Triple{corner(0), corner(1), corner(2)}; }));
  }
  return triangles;
}

// Returns the array if it has three columns of integers.
NpyTable checked_triangles(std::string_view bytes, std::uint64_t file_size) {
  NpyTable array(bytes, file_size, index_types, "an integer of 32 or 64 bits");
  if (array.num_columns() != 3) {
    throw BadValue("shape " + array.shape() + " where (m, 3) is needed");
  }
  if (array.num_rows() > 2 * max_sites) {
    throw BadValue(std::to_string(array.num_rows()) + " triangles are more than the " +
                   std::to_string(2 * max_sites) + " that one triangulation can hold");
  }
  return array;
}

}  // namespace

void check_npy(std::string_view head, std::uint64_t file_size) {
  if (file_size > head.size()) checked_triangles(head, file_size);
}

std::vector<Triple> read_npy(std::string_view bytes) {
  const NpyTable array = checked_triangles(bytes, bytes.size());
  if (array.type() == "u4") return rows_of<std::uint32_t>(array);
  if (array.type() == "i4") return rows_of<std::int32_t>(array);
  if (array.type() == "u8") return rows_of<std::uint64_t>(array);
  return rows_of<std::int64_t>(array);
}

void write_npy(AtomicFile& file, const MeshToWrite& mesh) {
  const std::span<const Triple> faces = mesh.faces;
  file.write(make_npy_header("<u4", std::array<std::uint64_t, 2>{faces.size(), 3}));
  file.write(NumberBytes(faces));
}

}  // namespace rondel::io
