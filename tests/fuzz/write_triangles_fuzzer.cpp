// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_triangles, can_write_triangles against read_triangles, face_polygons: the triangles survive every format that can be
// read; .geojson is JSON with a feature for each solid face, and .stl has their number.
#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "fuzz/json_check.h"
#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "rondel/error.h"
#include "rondel/polygons.h"

namespace rondel::fuzz {
namespace {

constexpr std::array triangle_endings = {".npy", ".off", ".ply", ".obj", ".vtp", ".stl"};

// A map takes a thousand times longer than a list, so that one of 16 inputs makes one.
std::string next_triangle_ending(ByteSource& source) {
  const std::size_t which = source.below(16);
  if (which == 15) return ".geojson";
  return triangle_endings[which % triangle_endings.size()];
}

void test_stl(const std::string& path, const SiteTable& table, const Triangulation& t) {
  try {
    write_triangles(path, table, t);
  } catch (const FileError& error) {
    require(std::string(error.what()).ends_with("does not fit the 32-bit floats of .stl"),
            "only the range of .stl is limited");
    return;
  }
  require(content(path).size() == 84 + 50 * t.num_faces(), "50 bytes for each triangle");
}

void test_geojson(const std::string& path, const SiteTable& table, const Triangulation& t) {
  write_triangles(path, table, t);
  const FeatureCount found = check_geojson(content(path));
  require(found.features == t.num_faces() - t.num_ghost_faces(), "a feature for each solid face");
  const LonLatPolygons all = face_polygons(t);
  const std::set<Index> drawn(all.owners.begin(), all.owners.end());
  require(drawn.size() + found.not_drawn.size() == found.features, "the same faces are drawn");
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  static const fuzz::ScratchFolder folder;
  fuzz::ByteSource source(data, size);
  const std::string ending = fuzz::next_triangle_ending(source);
  const std::string path = folder.file("triangles" + ending);
  Options options;
  const SiteTable table = fuzz::next_table(source, 40, ending);
  const Triangulation t = delaunay(table.sites, options);
  fuzz::require(can_write_triangles(path), "a format of triangles can be written");
  fuzz::require(!can_write_triangles(folder.file("triangles.csv")), "other formats cannot");
  if (ending == ".stl") {
    fuzz::test_stl(path, table, t);
  } else if (ending == ".geojson") {
    fuzz::test_geojson(path, table, t);
  } else {
    write_triangles(path, table, t);
    std::vector<Index> every(t.num_faces());
    std::iota(every.begin(), every.end(), 0);
    const std::string whole = fuzz::content(path);
    write_some_triangles(path, table, t, every);
    fuzz::require(fuzz::content(path) == whole, "all of the faces are some of them");
    if (t.num_faces() == 0) return 0;  // some formats refuse to be read without triangles
    fuzz::require(std::ranges::equal(read_triangles(path), t.faces()), "triangles survive");
  }
  return 0;
}
