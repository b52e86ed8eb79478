// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <span>

#include "io/cell_formats.h"
#include "io/npy_header.h"
#include "io/zip_file.h"

namespace rondel::io {
namespace {

template <typename T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// A point is three numbers without gaps, a row of the array.
static_assert(sizeof(Point) == 3 * sizeof(double));

}  // namespace

void write_cells_npz(AtomicFile& file, const CellsToWrite& to_write) {
  const auto& [cells, areas] = to_write.diagram;
  ZipWriter zip(file);
  const auto add = [&](const char* name, const char* dtype, std::span<const std::uint64_t> shape,
                       std::string_view bytes) {
    zip.add(name, make_npy_header(dtype, shape), bytes);
  };
  add("offsets.npy", "<u8", std::array<std::uint64_t, 1>{cells.offsets.size()},
      bytes_of(cells.offsets));
  add("rings.npy", "<u4", std::array<std::uint64_t, 1>{cells.rings.size()}, bytes_of(cells.rings));
  add("points.npy", "<f8", std::array<std::uint64_t, 2>{cells.points.size(), 3},
      bytes_of(cells.points));
  add("areas.npy", "<f8", std::array<std::uint64_t, 1>{areas.size()}, bytes_of(areas));
  zip.finish();
}

}  // namespace rondel::io
