// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// read_polygons on files of any bytes: cells whose arrays fit, or a message of one line that begins with the
// file's name; the cells have an area, and can be clipped to.
#include <cmath>
#include <numbers>
#include <string>

#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"

namespace rondel::fuzz {
namespace {

void test_cells(const PolygonTable& table) {
  const CellRings& cells = table.cells;
  require(
      cells.rings.back() == cells.corners.size() && cells.cells.back() + 1 == cells.rings.size(),
      "offsets fit");
  for (const Index corner : cells.corners) {
    require(corner < cells.points.size(), "corners are points");
  }
  for (const Column& column : table.columns) {
    require(column.ends.size() == cells.num_cells(), "a property of each cell");
  }
  for (const double area : areas(cells)) {
    require(area > -1e-9 && area < 4 * std::numbers::pi + 1e-9, "an area");
  }
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  try {
    const CellRings clipped = clip(Partition::voronoi(delaunay(sites)), Partition(cells));
    require(clipped.num_cells() == sites.size(), "a part of each cell");
  } catch (const InvalidInput&) {  // polygons that cross themselves may have no sides
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  const fuzz::ScratchFolder folder;
  const std::string path = folder.file("polygons.geojson");
  write_file(path, std::string(reinterpret_cast<const char*>(data), size));
  for (const PolygonEdges edges : {PolygonEdges::lonlat, PolygonEdges::geodesic}) {
    try {
      fuzz::test_cells(read_polygons(path, {.edges = edges, .tolerance_deg = 1}));
    } catch (const FileError& error) {
      const std::string what = error.what();
      fuzz::require(what.starts_with(path + ":") && what.find('\n') == std::string::npos,
                    "a message of one line starts with the file: " + what);
    }
  }
  return 0;
}
