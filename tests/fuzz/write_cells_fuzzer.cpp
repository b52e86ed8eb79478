// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_cells, can_write_cells, cell_polygons: .geojson is a map of the whole sphere with a feature
// for each cell, valid and with equal borders, and cell_polygons the same map; .npz and .vtp hold the bytes of the diagram.
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "fuzz/json_check.h"
#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "fuzz/valid_polygons.h"
#include "rondel/diagram.h"
#include "rondel/polygons.h"

namespace rondel::fuzz {
namespace {

// A map takes a thousand times longer than an array, so that one of 16 inputs makes one.
std::string next_ending(ByteSource& source) {
  const std::size_t which = source.below(16);
  return which == 0 ? ".geojson" : which % 2 == 0 ? ".vtp" : ".npz";
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

void require_bytes(const std::string& file, const std::string& bytes) {
  require(file.find(bytes) != std::string::npos, "the file holds the diagram");
}

// The polygons in arrays cover as much as those of the file, of as many cells.
void test_polygons(const FeatureCount& found, const LonLatPolygons& all) {
  require(
      all.rings.size() == all.owners.size() && all.rings.offsets.back() == all.rings.values.size(),
      "the arrays fit together");
  double area = 0;
  std::size_t drawn = 0;
  for (std::size_t k = 0; k < all.owners.size(); ++k) {
    if (k == 0 || all.owners[k] != all.owners[k - 1]) ++drawn;
    const std::span<const LonLat> ring = all.rings[k];
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      const LonLat& p = ring[i];
      const LonLat& q = ring[i + 1];
      area += (p.lon_deg * q.lat_deg - q.lon_deg * p.lat_deg) / 2;
    }
  }
  require(drawn + found.not_drawn.size() == found.features, "the cells of the file are drawn");
  require(std::abs(area - found.square_degrees) < 1e-6, "the polygons are those of the file");
}

// A cell that is not drawn is thinner than the tolerance: at most a lune of that width.
void test_geojson(const FeatureCount& found, const Triangulation& t, const Diagram& both,
                  double tolerance_deg) {
  require(found.features == t.num_vertices(), "a feature for each vertex");
  std::vector<double> areas;
  for (std::size_t i = 0; i < both.areas.size(); ++i) {
    const bool has_ring = !both.cells.rings[i].empty();
    if (has_ring) areas.push_back(both.areas[i]);
  }
  for (const std::size_t i : found.not_drawn) {
    require(areas.at(i) <= 2 * tolerance_deg * std::numbers::pi / 180, "what is thin is not drawn");
  }
  const double area = std::accumulate(both.areas.begin(), both.areas.end(), 0.0);
  const double expected = area == 0 ? 0 : 360.0 * 180.0;
  require(std::abs(found.square_degrees - expected) < 1e-6,
          "the cells cover the map, not " + std::to_string(found.square_degrees));
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  static const fuzz::ScratchFolder folder;
  fuzz::ByteSource source(data, size);
  const std::string ending = fuzz::next_ending(source);
  const std::string path = folder.file("cells" + ending);
  Options options;
  options.model = source.byte() % 2 == 0 ? Model::projected : Model::weighted;
  const double tolerance_deg = source.below(4) == 0 ? 0.1 : 5;
  const SiteTable table = fuzz::next_table(source, 30, ending);
  const Triangulation t = delaunay(table.sites, options);
  const Diagram both = diagram(t);
  fuzz::require(can_write_cells(path), "a format of cells can be written");
  fuzz::require(!can_write_cells(folder.file("cells.obj")), "other formats cannot");
  write_cells(path, table, t, both, tolerance_deg);
  const std::string written = fuzz::content(path);
  if (ending == ".geojson") {
    const fuzz::FeatureCount found = fuzz::check_geojson(written);
    fuzz::test_geojson(found, t, both, tolerance_deg);
    fuzz::require_valid(nlohmann::json::parse(written), true);
    fuzz::test_polygons(found, cell_polygons(t, both, tolerance_deg));
    return 0;
  }
  fuzz::require_bytes(written, fuzz::bytes_of(both.cells.points));
  if (ending == ".npz") {
    fuzz::require_bytes(written, fuzz::bytes_of(both.cells.rings.offsets));
    fuzz::require_bytes(written, fuzz::bytes_of(both.cells.rings.values));
    fuzz::require_bytes(written, fuzz::bytes_of(both.areas));
  }
  return 0;
}
