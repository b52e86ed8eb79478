// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes: any bytes as a file, a file of a mesh with some bytes changed, any points as sites, some cells of them removed, and
// points in any polygons. Each gives a mesh that fits together, or one message.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "fuzz/scratch_folder.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh.h"
#include "rondel/mesh_cull.h"
#include "rondel/mesh_formats.h"
#include "rondel/mesh_quality.h"

namespace rondel::fuzz {
namespace {

const ScratchFolder& folder() {
  static const ScratchFolder made;
  return made;
}

// What takes any mesh.
void use(const mesh::VoronoiMesh& arrays) {
  const mesh::Quality quality = mesh::quality(arrays, {.threads = 1});
  require(quality.num_edges == arrays.num_edges(), "a report has all edges");
  require(quality.num_vertices == arrays.num_vertices(), "a report has all vertices");
  require(!mesh::quality_text(quality).empty() && !mesh::quality_json(quality).empty(), "a report");
  require(std::isfinite(mesh::quality_value(quality, "max-angle-deg")), "an angle");
  require(mesh::cell_quality(arrays).gradient.size() == arrays.num_cells(), "all cells");
  require(!mesh::quality_picture(arrays, quality, 2).empty(), "a picture");
  const mesh::TangentialWeights rows = mesh::tangential_weights(arrays, {.threads = 1});
  require(rows.edges.size() == arrays.num_edges(), "a row an edge");
  require(arrays.max_edges() >= 3 && mesh::spacing_of(1) > 1, "cells have three edges or more");
}

void expect_mesh_or_message(const std::string& path) {
  try {
    const mesh::VoronoiMesh arrays = mesh::read_mesh(path);
    use(arrays);
    std::vector<std::uint8_t> every_other(arrays.num_cells());
    for (std::size_t i = 1; i < every_other.size(); i += 2) every_other[i] = 1;
    use(mesh::cull(arrays, every_other).arrays);
    mesh::VoronoiMesh larger = arrays;
    mesh::rescale(larger, 2 * arrays.radius);
    mesh::rescale(larger, arrays.radius);
    require(larger.cell_areas == arrays.cell_areas, "powers of 2 are exact");
  } catch (const FileError& error) {
    const std::string what = error.what();
    require(what.find('\n') == std::string::npos, "a message is one line: " + what);
  } catch (const InvalidInput&) {
    // Lists that are in range, but of an edge twice.
  }
  try {
    mesh::read_mpas(path);
  } catch (const FileError&) {
  }
}

// A mesh with a border, or none.
void test_part(const mesh::VoronoiMesh& arrays, std::string_view bytes) {
  std::vector<std::uint8_t> is_removed(arrays.num_cells());
  for (std::size_t i = 0; i < is_removed.size() && i < 8 * bytes.size(); ++i) {
    is_removed[i] = static_cast<std::uint8_t>(bytes[i / 8]) >> (i % 8) & 1U;
  }
  try {
    const mesh::Culled culled = mesh::cull(arrays, is_removed, {.threads = 1});
    use(culled.arrays);
    const std::string path = folder().file("part.nc");
    mesh::write(path, culled.arrays);
    require(mesh::read_mpas(path) == culled.arrays, "a part of a mesh comes back");
    const auto format = static_cast<mesh::MeshFormat>(1 + bytes.size() % 3);
    mesh::write(path, culled.arrays, {.format = format});
    expect_mesh_or_message(path);
  } catch (const InvalidInput&) {
    require(std::ranges::find(is_removed, 0) == is_removed.end(), "a part is a mesh");
  }
}

// Rings of any corners, which may cross: an answer for each point.
void test_regions(const std::vector<Point>& sites) {
  CellRings regions;
  for (const Point& site : sites) {
    const double length = std::sqrt(site.x * site.x + site.y * site.y + site.z * site.z);
    regions.corners.push_back(static_cast<Index>(regions.points.size()));
    regions.points.push_back({site.x / length, site.y / length, site.z / length});
    if (regions.corners.size() % 5 != 0) continue;
    regions.end_ring();
    regions.end_cell();
  }
  if (regions.rings.back() != regions.corners.size()) regions.corners.resize(regions.rings.back());
  try {
    const std::vector<std::uint8_t> found = mesh::inside(sites, regions, {.threads = 1});
    require(found.size() == sites.size(), "an answer for each point");
    require(found == mesh::inside(sites, regions, {.threads = 2}), "of any threads the same");
  } catch (const InvalidInput&) {
  }
}

std::string whole_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Sites from the input, and from a cube around the center with one corner moved.
void test_sites(std::string_view bytes) {
  std::vector<Point> sites;
  for (int i = 0; i < 8; ++i) {
    sites.push_back({i % 2 == 0 ? -1.0 : 1.0, i / 2 % 2 == 0 ? -1.0 : 1.0, i < 4 ? -1.0 : 1.125});
  }
  for (std::size_t at = 0; at + 6 <= bytes.size() && sites.size() < 40; at += 6) {
    std::array<std::int16_t, 3> xyz{};
    std::memcpy(xyz.data(), bytes.data() + at, sizeof xyz);
    if (xyz == std::array<std::int16_t, 3>{}) continue;
    sites.push_back(
        {static_cast<double>(xyz[0]), static_cast<double>(xyz[1]), static_cast<double>(xyz[2])});
  }
  mesh::VoronoiMesh arrays;
  try {
    arrays = mesh::make_mesh(delaunay(sites), {.radius = 2, .allow_zero_edges = true});
  } catch (const InvalidInput&) {
    return;
  }
  use(arrays);
  test_part(arrays, bytes);
  test_regions(sites);
  const std::string path = folder().file("mesh.nc");
  const auto format = static_cast<mesh::MeshFormat>(bytes.empty() ? 0 : bytes[0] & 3);
  mesh::write(path, arrays, {.format = format});
  mesh::write_graph(folder().file("graph.info"), arrays);
  require(!mesh::mpas_content(arrays).variables.empty(), "a mesh has variables");
  if (format != mesh::MeshFormat::mpas) {
    expect_mesh_or_message(path);
    return;
  }
  require(mesh::read_mpas(path) == arrays, "an MPAS mesh comes back");
  std::string content = whole_file(path);
  for (std::size_t at = 0; at + 4 <= bytes.size(); at += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    content[(word >> 8U) % content.size()] = static_cast<char>(word & 0xffU);
  }
  std::ofstream(path, std::ios::binary) << content;
  expect_mesh_or_message(path);
}

void test(std::string_view bytes) {
  const std::string path = folder().file("fuzzed.nc");
  std::ofstream(path, std::ios::binary) << bytes;
  expect_mesh_or_message(path);
  test_sites(bytes);
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rondel::fuzz::test({reinterpret_cast<const char*>(data), size});
  return 0;
}
