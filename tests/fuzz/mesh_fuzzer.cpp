// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes: any bytes as a file, a file of a mesh with some bytes changed, and any points as sites. Each gives a mesh
// that fits together, or one message.
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
#include "rondel/mesh_io.h"
#include "rondel/mesh_quality.h"

namespace rondel::fuzz {
namespace {

const ScratchFolder& folder() {
  static const ScratchFolder made;
  return made;
}

// What takes any mesh.
void use(const mesh::MeshArrays& arrays) {
  const mesh::Quality quality = mesh::quality(arrays, {.threads = 1});
  require(quality.num_edges == arrays.num_edges(), "a report has all edges");
  require(quality.num_vertices == arrays.num_vertices(), "a report has all vertices");
  require(!mesh::quality_text(quality).empty() && !mesh::quality_json(quality).empty(), "a report");
  require(std::isfinite(mesh::quality_value(quality, "max-angle-deg")), "an angle");
  require(mesh::cell_quality(arrays).gradient.size() == arrays.num_cells(), "all cells");
  require(!mesh::quality_picture(arrays, quality, 2).empty(), "a picture");
  const mesh::TangentialWeights rows = mesh::tangential_weights(arrays, {.threads = 1});
  require(rows.offsets.size() == arrays.num_edges() + 1, "a row an edge");
  require(arrays.max_edges() >= 3 && mesh::spacing_of(1) > 1, "cells have three edges or more");
}

void expect_mesh_or_message(const std::string& path) {
  try {
    use(mesh::read_mesh(path));
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
  mesh::MeshArrays arrays;
  try {
    arrays = mesh::arrays(delaunay(sites), {.radius = 2, .allow_zero_edges = true});
  } catch (const InvalidInput&) {
    return;
  }
  use(arrays);
  const std::string path = folder().file("mesh.nc");
  const auto format = static_cast<mesh::MeshFormat>(bytes.empty() ? 0 : bytes[0] & 3);
  mesh::write(path, arrays, {.format = format});
  mesh::write_graph(folder().file("graph.info"), arrays);
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
