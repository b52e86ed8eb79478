// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes without enough memory: std::bad_alloc and no leak, or the result; their files are whole or are not there.

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "faults/failing_files.h"
#include "rondel/delaunay.h"
#include "rondel/mesh.h"
#include "rondel/mesh_cull.h"
#include "rondel/mesh_equal_area.h"
#include "rondel/mesh_formats.h"
#include "rondel/mesh_quality.h"
#include "rondel/mesh_size_files.h"
#include "rondel/point_sets.h"
#include "rondel/scvt.h"

namespace rondel::test {
namespace {

const Execution one_thread{.threads = 1};

mesh::VoronoiMesh small_mesh() {
  return mesh::make_mesh(delaunay(mesh::icosahedral_points(1, one_thread), {}, one_thread), {},
                         one_thread);
}

TEST(allocation_of_meshes, arrays_and_their_quality) {
  const Triangulation built = delaunay(mesh::icosahedral_points(1));
  expect_result_or_bad_alloc([&] { return mesh::make_mesh(built, {}, one_thread); });
  const mesh::VoronoiMesh arrays = small_mesh();
  expect_result_or_bad_alloc([&] {
    const mesh::TangentialWeights rows = mesh::tangential_weights(arrays, one_thread);
    return std::tuple(rows.edges.offsets, rows.edges.values, rows.weights);
  });
  expect_result_or_bad_alloc([&] {
    const mesh::Quality quality = mesh::quality(arrays, one_thread);
    return mesh::quality_json(quality) + mesh::quality_picture(arrays, quality, 2, one_thread);
  });
}

TEST(allocation_of_meshes, tessellations_and_areas) {
  const std::vector<Point> start = mesh::poisson_disk_points(0.8);
  const auto made_of = [](const mesh::Scvt& made) {
    return std::tuple(made.sites, made.end, made.last.energy, made.repair.moved);
  };
  expect_result_or_bad_alloc([&] {
    return made_of(
        mesh::relax(start, {.mean_tolerance = 0.05, .largest_tolerance = 1}, one_thread));
  });
  expect_result_or_bad_alloc(
      [&] { return made_of(mesh::scvt({.count = 42, .max_iterations = 1}, one_thread)); });
  expect_result_or_bad_alloc([&] {
    const mesh::EqualArea made = mesh::equal_area(start, {}, {}, one_thread);
    return std::tuple(made.weights, made.areas, made.end);
  });
}

TEST(allocation_of_meshes, sizes_and_points) {
  const mesh::SizeFunction size = mesh::SizeFunction::constant(0.5, 4);
  const std::vector<Point> line = {{1, 0, 0}, {0, 1, 0}, {0, 0.6, 0.8}};
  expect_result_or_bad_alloc([&] {
    return size.refined(mesh::densified(line, 0.2), 0.1, 0.2, one_thread).limited(0.1).count();
  });
  expect_result_or_bad_alloc([&] {
    return std::tuple(mesh::icosahedral_points(1, one_thread), mesh::healpix_points(2),
                      mesh::reduced_gaussian_points(2), mesh::cubed_sphere_points(2),
                      mesh::poisson_disk_points(0.9, 1, one_thread));
  });
}

constexpr std::array formats = {mesh::MeshFormat::mpas, mesh::MeshFormat::ugrid,
                                mesh::MeshFormat::scrip, mesh::MeshFormat::esmf,
                                mesh::MeshFormat::exodus};

TEST(allocation_of_meshes, files_are_written_or_bad_alloc) {
  const mesh::VoronoiMesh arrays = small_mesh();
  for (const mesh::MeshFormat format : formats) {
    expect_file_or_bad_alloc(".nc", [&](const std::string& path) {
      mesh::write(path, arrays, {.format = format}, one_thread);
    });
  }
  expect_file_or_bad_alloc(
      ".info", [&](const std::string& path) { mesh::write_graph(path, arrays, one_thread); });
}

TEST(allocation_of_meshes, files_are_read_or_bad_alloc) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("mesh.nc");
  for (const mesh::MeshFormat format : formats) {
    if (format == mesh::MeshFormat::exodus) continue;
    const mesh::VoronoiMesh whole = small_mesh();
    std::vector<std::uint8_t> is_removed(whole.num_cells(), 0);
    is_removed[1] = 1;
    for (const auto& arrays : {whole, mesh::cull(whole, is_removed, one_thread).arrays}) {
      mesh::write(path, arrays, {.format = format}, one_thread);
      expect_result_or_bad_alloc([&] { return mesh::read_mesh(path, {}, one_thread); });
    }
  }
  expect_result_or_bad_alloc([&] {
    return mesh::read_refinement((corpus / "good" / "features.geojson").string(), 0.1, {},
                                 one_thread);
  });
}

}  // namespace
}  // namespace rondel::test
