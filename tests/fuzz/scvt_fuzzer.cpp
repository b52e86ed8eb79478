// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that are moved or weighted, spacings of any numbers, and files of lines and spacings. Each has an answer that
// keeps its promises, or a message.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "exact/vector.h"
#include "fuzz/fuzz_input.h"
#include "fuzz/scratch_folder.h"
#include "rondel/error.h"
#include "rondel/mesh_equal_area.h"
#include "rondel/mesh_lines.h"
#include "rondel/mesh_size_files.h"
#include "rondel/point_sets.h"
#include "rondel/scvt.h"

namespace rondel::fuzz {
namespace {

const ScratchFolder& scratch() {
  static const ScratchFolder made;
  return made;
}

Point unit(const Point& p) { return normalized(scaled(p)); }

double away(const Point& a, const Point& b) { return norm(a - b); }

// Points are sites first of all, and each line that is not empty has a site at its first point or nearer to it than the
// distance within which places are left out.
void test_sites_on(const std::vector<std::vector<Point>>& lines) {
  constexpr double spacing = 0.2;
  constexpr double near = 0.7 * spacing + 1e-9;
  const std::vector<Point> sites =
      mesh::sites_on(lines, mesh::SizeFunction::constant(spacing, 1), {.threads = 1}).sites;
  std::size_t num_points = 0;
  for (const std::vector<Point>& line : lines) {
    if (line.empty()) continue;
    const Point first = unit(line.front());
    require(std::ranges::any_of(sites, [&](const Point& p) { return away(p, first) < near; }),
            "a site on each line");
    const bool is_point = std::ranges::all_of(
        line, [&first](const Point& p) { return away(unit(p), first) < 1e-12; });
    if (!is_point) continue;
    require(num_points < sites.size() && away(sites[num_points], first) < 1e-15,
            "a point is a site as it is");
    ++num_points;
  }
  for (const Point& p : sites) require(std::abs(dot(p, p) - 1) < 1e-15, "sites are unit vectors");
}

// Some sites stay, of which each is found where it was put; rows beside a line through all.
void test_fixed(const std::vector<Point>& sites) {
  const std::vector<Point> some(sites.begin(),
                                sites.begin() + static_cast<std::ptrdiff_t>(sites.size() / 3));
  try {
    const mesh::ScvtOptions options{.count = 40, .max_iterations = 5, .fixed = some};
    const mesh::Scvt made = mesh::scvt(options, {.threads = 1});
    require(made.fixed.size() == some.size(), "a site for each fixed place");
    const mesh::Scvt again =
        mesh::relax(made.sites, {.max_iterations = 5, .fixed = made.sites}, {.threads = 1});
    require(again.last.iteration == 0, "nothing moves where all is fixed");
  } catch (const InvalidInput&) {
  }
  try {
    const std::vector<std::vector<Point>> lines = {sites, some};
    const mesh::LineSites rows =
        mesh::sites_along(lines, mesh::SizeFunction::constant(0.2, 1), {.threads = 1});
    (void)mesh::scvt({.count = rows.sites.size() + 60, .max_iterations = 1, .fixed = rows.sites},
                     {.threads = 1});
    test_sites_on(lines);
  } catch (const InvalidInput& error) {
    require(error.index() < 2 || error.index() == InvalidInput::no_index, "the index of a line");
  }
}

void test_sites(ByteSource& source) {
  const std::vector<Point> sites = all_sites(source, 24, next_scales(source));
  try {
    double last = 0;
    mesh::ScvtOptions options{.max_iterations = 20};
    options.on_step = [&](const mesh::ScvtStep& step) {
      require(step.iteration == 0 || step.energy <= last + 1e-12, "the energy does not grow");
      last = step.energy;
    };
    const mesh::Scvt made = mesh::relax(sites, options, {.threads = 1});
    require(made.sites.size() == sites.size(), "a site for each");
    require(!mesh::name_of(made.end).empty(), "an end");
    require(mesh::energy_over_hexagons(made.last.energy, sites.size()) > 0, "an energy");
  } catch (const InvalidInput& error) {
    require(error.index() < sites.size() || error.index() == InvalidInput::no_index,
            "an index in range");
  }
  test_fixed(sites);
  try {
    std::vector<double> targets;
    if (source.byte() % 2 == 0) {
      for (std::size_t i = 0; i < sites.size(); ++i) targets.push_back(1 + source.byte());
      double sum = 0;
      for (const double target : targets) sum += target;
      for (double& target : targets) target *= 12.566370614359172 / sum;
    }
    const mesh::EqualArea made =
        mesh::equal_area(sites, targets, {.max_steps = 20}, {.threads = 1});
    require(made.weights.size() == sites.size(), "a weight for each");
    require(!mesh::name_of(made.end).empty(), "an end");
  } catch (const InvalidInput&) {
  }
}

void test_sizes(ByteSource& source) {
  try {
    const std::vector<double> lon = {source.finite_double(), source.finite_double()};
    const std::vector<double> lat = {source.finite_double(), source.finite_double()};
    const std::vector<double> four = {source.finite_double(), 0.5, 1, source.finite_double()};
    mesh::SizeFunction::from_grid(lon, lat, four, 4);
  } catch (const InvalidInput&) {
  }
  try {
    const double base = 0.05 + 0.01 * source.byte();
    const mesh::SizeFunction size = mesh::SizeFunction::from_function(
        [&](std::span<const Point> places, std::span<double> out) {
          for (std::size_t i = 0; i < places.size(); ++i) out[i] = base + 0.001 * source.byte();
        },
        8);
    const std::vector<Point> line = all_sites(source, 4, Scales::near);
    const mesh::SizeFunction limited =
        size.refined(mesh::densified(line, 0.1), 0.04, 0.01 * source.byte())
            .limited(0.01 * source.byte())
            .scaled(1)
            .for_count(12 + source.below(1000));
    require(limited.smallest() <= limited.largest() && limited.count() > 0, "a size");
    const Point place{0.3, -0.5, 0.2};
    require(limited.density(place) <= 1 && limited.spacing(place) > 0, "a spacing");
    (void)mesh::scvt({.count = 12 + source.below(20), .size = limited, .max_iterations = 10},
                     {.threads = 1});
    (void)mesh::SizeFunction::constant(source.finite_double(), 2);
    std::vector<double> at_nodes(mesh::SizeFunction::nodes(2).size() - source.below(2), base);
    at_nodes.back() = source.finite_double();
    (void)mesh::SizeFunction::from_nodes(std::move(at_nodes), 2);
    (void)mesh::SizeFunction::of_count(source.below(5));
  } catch (const InvalidInput&) {
  }
}

// Spacings on any region, of which most are refused.
void test_region(ByteSource& source) {
  const std::vector<Point> points = all_sites(source, 6, Scales::near);
  const double base = 0.05 + 0.01 * source.byte();
  const Point center = points.empty() ? Point{source.finite_double(), 0, 1} : points.front();
  mesh::SizeRegion region{center, 0.003 * source.byte(), 0.003 * source.byte()};
  if (source.byte() % 8 == 0) region.half_width = source.finite_double();
  try {
    const mesh::SizeRaster raster =
        mesh::SizeRaster::with_step(region, 0.02 + 0.01 * source.byte());
    require(raster.steps <= raster.most_steps() && raster.longest_step() > 0, "a raster");
    const mesh::SizeFunction size = mesh::SizeFunction::constant(base, raster)
                                        .refined(points, 0.04, 0.01 * source.byte())
                                        .limited(0.01 * source.byte());
    require(size.raster().region && size.raster().steps == raster.steps, "the same raster");
    require(size.count() > 0 && size.smallest() > 0, "a size");
    for (const Point& place : points) {
      const double spacing = size.spacing(place);
      require(spacing >= size.smallest() * (1 - 1e-6) && spacing <= size.largest() * (1 + 1e-6),
              "a spacing");
      (void)region.contains(place);
    }
    try {
      (void)mesh::scvt({.count = 12, .size = size}, {.threads = 1});
      require(false, "the sphere is no region");
    } catch (const InvalidInput&) {
    }
  } catch (const InvalidInput&) {
  }
}

void test_point_sets(ByteSource& source) {
  try {
    (void)mesh::icosahedral_points(static_cast<unsigned>(source.below(3)), {.threads = 1});
    (void)mesh::healpix_points(source.below(6));
    (void)mesh::reduced_gaussian_points(source.below(6));
    (void)mesh::cubed_sphere_points(source.below(6));
    (void)mesh::poisson_disk_points(0.2 + 0.005 * source.byte(), source.byte(), {.threads = 1});
  } catch (const InvalidInput&) {
  }
}

void test_files(std::string_view bytes) {
  for (const char* name : {"any.geojson", "any.csv", "any.nc"}) {
    const std::string path = scratch().file(name);
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      (void)mesh::read_refinement(path, 0.1, {}, {.threads = 1});
    } catch (const FileError&) {
    } catch (const InvalidInput&) {
    }
    try {
      (void)mesh::read_spacings(path, "h", 1, 2, {.threads = 1});
      const mesh::SizeRegion region{{1, 0, 0}, 0.3, 0.2};
      (void)mesh::read_spacings(path, "h", 1, {region, 2}, {.threads = 1}, nullptr,
                                {.most_steps = 64});
      (void)mesh::read_refinement(path, 0.1, {}, {.threads = 1}, region);
    } catch (const FileError&) {
    } catch (const InvalidInput&) {
    }
    try {
      (void)mesh::read_density(path, "h", 2, {.threads = 1});
    } catch (const FileError&) {
    } catch (const InvalidInput&) {
    }
    try {
      (void)mesh::read_heights(path, "h", mesh::Positive::up, mesh::SizeFunction::nodes(1),
                               {.threads = 1});
    } catch (const FileError&) {
    } catch (const InvalidInput&) {
    }
    try {
      (void)mesh::read_lines(path);
    } catch (const FileError&) {
    }
    try {
      require(!mesh::read_places(path).empty(), "a place");
    } catch (const FileError&) {
    }
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rondel::fuzz::ByteSource source(data, size);
  rondel::fuzz::test_sites(source);
  rondel::fuzz::test_sizes(source);
  rondel::fuzz::test_point_sets(source);
  rondel::fuzz::test_region(source);
  rondel::fuzz::test_files({reinterpret_cast<const char*>(data), size});
  return 0;
}
