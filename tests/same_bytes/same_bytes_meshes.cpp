// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Hashes of meshes, with 1, 2 and 5 threads: point sets, spacings, centroidal tessellations and their repair, the
// arrays, the weights and the quality of a mesh, its files of every kind, cells of prescribed areas.
//
//     same_bytes_meshes EXPECTED              compares with the hashes that are recorded, and tells
//                                             what differs
//     same_bytes_meshes EXPECTED --update     records those of this build

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/mesh.h"
#include "rondel/mesh_equal_area.h"
#include "rondel/mesh_formats.h"
#include "rondel/mesh_quality.h"
#include "rondel/point_sets.h"
#include "rondel/scvt.h"
#include "same_bytes/portable/hash.h"
#include "same_bytes/recorded.h"
#include "support/temporary_files.h"

namespace rondel::test {
namespace {

using Lines = std::vector<std::string>;
using mesh::VoronoiMesh;

// What differs between turns of threads is there twice, and fails.
template <class HashWith>
void record(Lines& lines, const std::string& what, const HashWith& hash_with) {
  std::set<std::string> found;
  for (const unsigned threads : {1U, 2U, 5U}) {
    Hash hash;
    hash_with(hash, Execution{.threads = threads});
    found.insert(hash.text());
  }
  for (const std::string& hash : found) lines.push_back(what + ' ' + hash);
}

void add_number(Hash& hash, double number) { hash.add(std::span<const double>(&number, 1)); }

void add_text(Hash& hash, const std::string& text) {
  for (const char c : text) hash.add_word(static_cast<unsigned char>(c));
}

void add_points(Lines& lines) {
  record(lines, "icosahedral", [](Hash& hash, const Execution& execution) {
    hash.add(mesh::icosahedral_points(5, execution));
  });
  record(lines, "lattices", [](Hash& hash, const Execution& /*execution*/) {
    hash.add(mesh::healpix_points(17));
    hash.add(mesh::reduced_gaussian_points(20));
    hash.add(mesh::cubed_sphere_points(13));
  });
  record(lines, "poisson", [](Hash& hash, const Execution& execution) {
    hash.add(mesh::poisson_disk_points(0.06, 3, execution));
  });
}

// From 0.08 to 0.02 within half a radian.
mesh::SizeFunction fourfold() {
  return mesh::SizeFunction::from_function(
      [](std::span<const Point> places, std::span<double> out) {
        for (std::size_t i = 0; i < places.size(); ++i) {
          const double s = std::clamp(2.5 * (places[i].x - 0.3), 0.0, 1.0);
          out[i] = 0.08 - 0.06 * s * s * (3 - 2 * s);
        }
      },
      32);
}

void add_size(Hash& hash, const mesh::SizeFunction& size) {
  for (const Point& place : mesh::healpix_points(8)) {
    add_number(hash, size.spacing(place));
    add_number(hash, size.density(place));
  }
  for (const double number : {size.smallest(), size.largest(), size.count()}) {
    add_number(hash, number);
  }
}

void add_sizes(Lines& lines) {
  record(lines, "spacings", [](Hash& hash, const Execution& execution) {
    const std::array lon = {-150.0, -30.0, 80.0};
    const std::array lat = {-60.0, 10.0, 75.0};
    const std::array<double, 9> values = {0.3, 0.1, 0.2, 0.05, 0.4, 0.1, 0.2, 0.3, 0.15};
    const mesh::SizeFunction of_grid = mesh::SizeFunction::from_grid(lon, lat, values, 32);
    add_size(hash, of_grid);
    const std::vector<Point> line =
        mesh::densified(std::vector<Point>{{1, 0.2, 0}, {0, 1, 0.3}, {-1, 0.1, 0.9}}, 0.03);
    hash.add(line);
    add_size(hash, of_grid.refined(line, 0.04, 0.1, execution));
    add_size(hash, fourfold().limited(0.05).scaled(1.5));
  });
}

void add_scvt(Hash& hash, const mesh::Scvt& made) {
  hash.add(made.sites);
  add_text(hash, std::string(mesh::name_of(made.end)));
  for (const double number :
       {made.last.energy, made.last.mean_offset, made.last.largest_offset,
        made.repair.before.min_edge_ratio, made.repair.after.min_edge_ratio}) {
    add_number(hash, number);
  }
  for (const std::size_t number :
       {static_cast<std::size_t>(made.last.iteration), made.builds, made.flips, made.repair.moved,
        made.repair.before.odd_cells, made.repair.before.short_edges,
        made.repair.before.obtuse_triangles, made.repair.after.odd_cells}) {
    hash.add_word(number);
  }
}

void add_tessellations(Lines& lines) {
  const mesh::SizeFunction size = fourfold();
  record(lines, "scvt-icosahedral", [](Hash& hash, const Execution& execution) {
    add_scvt(hash, mesh::scvt({.count = 642}, execution));
  });
  record(lines, "scvt-uniform", [](Hash& hash, const Execution& execution) {
    add_scvt(hash, mesh::scvt({.count = 500}, execution));
  });
  // Of so many sites that threads share the sums; from poles and an equator that have not the density.
  const std::vector<Point> start = mesh::reduced_gaussian_points(32);
  record(lines, "scvt-steps", [&](Hash& hash, const Execution& execution) {
    add_scvt(hash, mesh::relax(start, {.max_iterations = 4}, execution));
  });
  record(lines, "scvt-density", [&](Hash& hash, const Execution& execution) {
    add_scvt(hash, mesh::relax(start, {.size = size, .max_iterations = 4}, execution));
  });
  record(lines, "scvt-repair", [&](Hash& hash, const Execution& execution) {
    add_scvt(hash, mesh::relax(start, {.mean_tolerance = 0.01, .largest_tolerance = 1}, execution));
  });
  record(lines, "scvt-lloyd", [&](Hash& hash, const Execution& execution) {
    add_scvt(hash, mesh::scvt({.count = 200,
                               .mean_tolerance = 1e-2,
                               .largest_tolerance = 1,
                               .method = mesh::ScvtMethod::lloyd},
                              execution));
  });
  // Levels and starts of a density, which one thread makes.
  Hash hash;
  add_scvt(hash, mesh::scvt({.count = 700, .size = size, .mean_tolerance = 1e-2}, {.threads = 1}));
  lines.push_back("scvt-levels " + hash.text());
}

void add_arrays(Hash& hash, const VoronoiMesh& arrays) {
  add_number(hash, arrays.radius);
  hash.add(arrays.cell_points);
  hash.add(arrays.cell_areas);
  hash.add(arrays.density);
  hash.add(arrays.edges_on_cell.offsets);
  hash.add(arrays.edges_on_cell.values);
  hash.add(arrays.cells_on_cell);
  hash.add(arrays.vertices_on_cell);
  hash.add(arrays.edge_points);
  hash.add(arrays.cells_on_edge);
  hash.add(arrays.vertices_on_edge);
  hash.add(arrays.cell_distances);
  hash.add(arrays.vertex_distances);
  hash.add(arrays.normal_angles);
  hash.add(arrays.vertex_points);
  hash.add(arrays.cells_on_vertex);
  hash.add(arrays.edges_on_vertex);
  hash.add(arrays.kite_areas);
  hash.add(arrays.triangle_areas);
}

void add_quality(Hash& hash, const VoronoiMesh& arrays, const Execution& execution) {
  const mesh::Quality quality = mesh::quality(arrays, execution);
  add_text(hash, mesh::quality_json(quality));
  add_text(hash, mesh::quality_text(quality));
  add_text(hash, mesh::quality_picture(arrays, quality, 10, execution));
  const mesh::CellQuality cells = mesh::cell_quality(arrays, execution);
  hash.add(cells.centroid_offset);
  hash.add(cells.gradient);
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void add_files(const VoronoiMesh& arrays, Lines& lines) {
  constexpr std::array formats = {
      std::pair{mesh::MeshFormat::mpas, "mpas"}, std::pair{mesh::MeshFormat::ugrid, "ugrid"},
      std::pair{mesh::MeshFormat::scrip, "scrip"}, std::pair{mesh::MeshFormat::esmf, "esmf"},
      std::pair{mesh::MeshFormat::exodus, "exodus"}};
  const TemporaryDirectory folder;
  const std::string path = folder.file("mesh.nc");
  for (const auto& [of_file, name] : formats) {
    const mesh::MeshFormat format = of_file;
    record(lines, std::string("file-") + name, [&](Hash& hash, const Execution& execution) {
      for (const mesh::NetcdfKind kind : {mesh::NetcdfKind::cdf2, mesh::NetcdfKind::cdf5}) {
        mesh::write(path, arrays, {.format = format, .kind = kind}, execution);
        add_text(hash, bytes_of(path));
      }
    });
    if (format == mesh::MeshFormat::exodus) continue;
    record(lines, std::string("read-") + name, [&](Hash& hash, const Execution& execution) {
      mesh::write(path, arrays, {.format = format}, execution);
      add_arrays(hash, mesh::read_mesh(path, {}, execution));
    });
  }
  record(lines, "file-graph", [&](Hash& hash, const Execution& execution) {
    mesh::write_graph(path, arrays, execution);
    add_text(hash, bytes_of(path));
  });
}

// Sites without symmetry, whose lengths and areas are of all sizes.
void add_meshes(Lines& lines) {
  const std::vector<Point> sites = mesh::poisson_disk_points(0.06, 5);
  const Triangulation triangulation = delaunay(sites);
  std::vector<double> density;
  for (const Point& site : sites) density.push_back(0.6 + 0.4 * site.z * site.z);
  const mesh::MeshOptions options{.radius = 6371229, .density = density};
  record(lines, "arrays", [&](Hash& hash, const Execution& execution) {
    const VoronoiMesh arrays = mesh::make_mesh(triangulation, options, execution);
    add_arrays(hash, arrays);
    const mesh::TangentialWeights rows = mesh::tangential_weights(arrays, execution);
    hash.add(rows.edges.offsets);
    hash.add(rows.edges.values);
    hash.add(rows.weights);
  });
  const VoronoiMesh arrays = mesh::make_mesh(triangulation, options);
  record(lines, "quality", [&](Hash& hash, const Execution& execution) {
    add_quality(hash, arrays, execution);
    add_quality(hash, mesh::make_mesh(triangulation, {}, execution), execution);
  });
  add_files(arrays, lines);
}

void add_partitions(Lines& lines) {
  const std::vector<Point> sites = mesh::cubed_sphere_points(28);
  record(lines, "areas", [&](Hash& hash, const Execution& execution) {
    std::vector<double> targets;
    double sum = 0;
    for (const Point& site : sites) sum += targets.emplace_back(1 + 0.5 * site.x * site.y);
    for (double& target : targets) target *= 4 * std::numbers::pi / sum;
    const mesh::EqualArea made = mesh::equal_area(sites, targets, {.max_steps = 5}, execution);
    hash.add(made.weights);
    hash.add(made.poles);
    hash.add(made.radii_deg);
    hash.add(made.areas);
    add_text(hash, std::string(mesh::name_of(made.end)));
  });
}

Lines all_lines() {
  Lines lines;
  add_points(lines);
  add_sizes(lines);
  add_tessellations(lines);
  add_meshes(lines);
  add_partitions(lines);
  return lines;
}

}  // namespace
}  // namespace rondel::test

int main(int argc, char** argv) {
  return rondel::test::compare_or_record("same_bytes_meshes", rondel::test::all_lines, argc, argv);
}
