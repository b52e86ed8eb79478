// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "io/npy_header.h"
#include "io/number.h"
#include "io/triangle_formats.h"
#include "rondel/error.h"

namespace rondel::io {
namespace {

constexpr std::array<std::string_view, 4> index_types = {"u4", "i4", "u8", "i8"};

template <typename Integer>
std::vector<Triple> rows_of(const NpyTable& array, const std::string& name) {
  std::vector<Triple> triangles;
  triangles.reserve(array.num_rows());
  for (std::size_t i = 0; i < array.num_rows(); ++i) {
    try {
      triangles.push_back({checked_index(array.at<Integer>(i, 0)),
                           checked_index(array.at<Integer>(i, 1)),
                           checked_index(array.at<Integer>(i, 2))});
    } catch (const BadValue& bad) {
      throw FileError(name + ": row " + std::to_string(i) + ": " + bad.what());
    }
  }
  return triangles;
}

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

std::vector<Triple> read_table(const NpyTable& array, const std::string& name) {
  if (array.type() == "u4") return rows_of<std::uint32_t>(array, name);
  if (array.type() == "i4") return rows_of<std::int32_t>(array, name);
  if (array.type() == "u8") return rows_of<std::uint64_t>(array, name);
  return rows_of<std::int64_t>(array, name);
}

}  // namespace

void check_npy(std::string_view head, std::uint64_t file_size, const std::string& name) {
  if (file_size <= head.size()) return;
  try {
    checked_triangles(head, file_size);
  } catch (const BadValue& bad) {
    throw FileError(name + ": " + bad.what());
  }
}

std::vector<Triple> read_npy(std::string_view bytes, const std::string& name) {
  try {
    return read_table(checked_triangles(bytes, bytes.size()), name);
  } catch (const BadValue& bad) {
    throw FileError(name + ": " + bad.what());
  }
}

void write_npy(AtomicFile& file, const MeshToWrite& mesh) {
  const std::span<const Triple> faces = mesh.triangulation.faces();
  file.write(make_npy_header("<u4", std::array<std::uint64_t, 2>{faces.size(), 3}));
  file.write({reinterpret_cast<const char*>(faces.data()), faces.size_bytes()});
}

}  // namespace rondel::io
