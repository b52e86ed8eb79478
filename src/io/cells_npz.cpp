// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <span>

#include "io/binary.h"
#include "io/cell_formats.h"
#include "io/npy_header.h"
#include "io/zip_file.h"

namespace rondel::io {

void write_cells_npz(AtomicFile& file, const CellsToWrite& to_write) {
  const auto& [cells, areas] = to_write.diagram;
  ZipWriter zip(file);
  const auto add = [&](const char* name, const char* dtype, std::span<const std::uint64_t> shape,
                       std::string_view bytes) {
    zip.add(name, make_npy_header(dtype, shape), bytes);
  };
  add("offsets.npy", "<u8", std::array<std::uint64_t, 1>{cells.rings.offsets.size()},
      NumberBytes(cells.rings.offsets));
  add("rings.npy", "<u4", std::array<std::uint64_t, 1>{cells.rings.values.size()},
      NumberBytes(cells.rings.values));
  add("points.npy", "<f8", std::array<std::uint64_t, 2>{cells.points.size(), 3},
      NumberBytes(cells.points));
  add("areas.npy", "<f8", std::array<std::uint64_t, 1>{areas.size()}, NumberBytes(areas));
  const std::span<const Triple> faces = to_write.triangulation.faces();
  const std::span<const Hidden> hidden = to_write.triangulation.hidden();
  add("faces.npy", "<u4", std::array<std::uint64_t, 2>{faces.size(), 3}, NumberBytes(faces));
  add("hidden.npy", "<u4", std::array<std::uint64_t, 2>{hidden.size(), 2}, NumberBytes(hidden));
  zip.finish();
}

}  // namespace rondel::io
