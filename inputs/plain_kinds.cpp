// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "inputs/kinds.h"
#include "inputs/points.h"
#include "inputs/random.h"
#include "rondel/delaunay.h"

namespace rondel::inputs {
namespace {

// Returns n points, drawn one after the other.
template <class Draw>
Input drawn(std::size_t n, const Draw& draw) {
  Input input;
  input.sites.resize(n);
  for (Point& site : input.sites) site = draw();
  return input;
}

Input uniform(const Recipe& recipe) {
  Random random(recipe.seed);
  return drawn(recipe.n, [&] { return random.direction(); });
}

// Takes equal steps in z; the longitude advances by the golden section of a turn. Turns are counted
// in units of 2^-64, so the fraction is exact for every n.
Input fibonacci(const Recipe& recipe) {
  constexpr std::uint64_t golden = 0x9e37'79b9'7f4a'7c15U;
  Input input;
  input.sites.reserve(recipe.n);
  const auto n = static_cast<double>(recipe.n);
  for (std::uint64_t i = 0; i < recipe.n; ++i) {
    const double turns = static_cast<double>((i * golden) >> 11) * 0x1p-53;
    const Point around = unit_vector({360 * turns, 0});
    const double z = (n - 1 - 2 * static_cast<double>(i)) / n;
    const double r = std::sqrt((1 - z) * (1 + z));
    input.sites.push_back({r * around.x, r * around.y, z});
  }
  return input;
}

// The rows and columns of a grid whose product is as near to n as possible while the steps in
// latitude and longitude stay within about 10 % of each other.
struct Shape {
  std::size_t rows = 1;
  std::size_t columns = 1;
};

Shape grid_shape(std::size_t n) {
  const double ideal = 1 + std::sqrt(static_cast<double>(n) / 2);
  const auto first = static_cast<std::size_t>(std::max(1.0, 0.95 * ideal));
  const auto last = static_cast<std::size_t>(1.05 * ideal) + 1;
  Shape best{1, n};
  std::size_t best_gap = n;
  for (std::size_t rows = first; rows <= last; ++rows) {
    const std::size_t columns = std::max<std::size_t>(1, (n + rows / 2) / rows);
    const std::size_t product = rows * columns;
    const std::size_t gap = product > n ? product - n : n - product;
    if (gap < best_gap) {
      best_gap = gap;
      best = {rows, columns};
    }
  }
  return best;
}

// Returns a i/n - b, rounded once, so that the grid is its own mirror image.
double fraction(double a, std::size_t i, double b, std::size_t n) {
  const auto steps = static_cast<double>(n);
  return (a * static_cast<double>(i) - b * steps) / steps;
}

// A grid as in climate data: both poles are rows, and the seam at 180 degrees occurs once.
Input lonlat_grid(const Recipe& recipe) {
  const auto [rows, columns] =
      recipe.rows > 0 ? Shape{recipe.rows, recipe.columns} : grid_shape(recipe.n);
  std::vector<LonLat> positions;
  positions.reserve(rows * columns);
  for (std::size_t i = 0; i < rows; ++i) {
    const double lat = rows == 1 ? 0 : fraction(180, i, 90, rows - 1);
    for (std::size_t j = 0; j < columns; ++j) {
      positions.push_back({fraction(360, j, 180, columns), lat});
    }
  }
  return from_positions(std::move(positions));
}

// The centers of cells in rows of equal latitudes; a row has twice as many cells as there are rows.
Input grid(const Recipe& recipe) {
  const auto rows = static_cast<std::size_t>(std::sqrt(static_cast<double>(recipe.n) / 2));
  std::vector<LonLat> positions;
  positions.reserve(2 * rows * rows);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < 2 * rows; ++j) {
      positions.push_back(
          {fraction(180, 2 * j + 1, 180, 2 * rows), fraction(90, 2 * i + 1, 90, rows)});
    }
  }
  return from_positions(std::move(positions));
}

// The set S_n of Caroli et al., section 5: n+1 points with longitude theta = k pi/n and colatitude
// phi = (theta^2 + 1) / pi^2, and four more that put the center inside the hull.
Input paper_s(const Recipe& recipe) {
  constexpr double inverse_pi_squared = 1 / (std::numbers::pi * std::numbers::pi);
  Input input;
  input.sites.reserve(recipe.n + 5);
  for (std::size_t k = 0; k <= recipe.n; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(recipe.n);
    const double colatitude = (t * t + inverse_pi_squared) * degrees_per_radian;
    input.sites.push_back(unit_vector({180 * t, 90 - colatitude}));
  }
  const double c = -1 / std::numbers::sqrt3;
  for (const Point& p : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}, Point{c, c, c}}) {
    input.sites.push_back(p);
  }
  return input;
}

struct Cap {
  Frame frame;
  double height = 0;  // 1 - cos(angular radius)
};

Cap make_cap(Random& random, double angle_deg) {
  const Point q = unit_vector({angle_deg, 0});
  // This is 1 - cos without cancellation.
  const double height = q.x > 0 ? q.y * q.y / (1 + q.x) : 1 - q.x;
  return {frame_around(random.direction()), height};
}

// Returns the point of the cap at this fraction of its height, at a random longitude; it is uniform
// in the cap if the fraction is uniform in [0, 1).
Point in_cap(Random& random, const Cap& cap, double fraction) {
  const double h = cap.height * fraction;
  const double r = std::sqrt(h * (2 - h));
  const Point around = unit_vector({360 * random.unit(), 0});
  const double u = r * around.x;
  const double v = r * around.y;
  return (1 - h) * cap.frame.up + (u * cap.frame.east + v * cap.frame.north);
}

// One cluster for about each thousand sites, denser towards its middle.
Input cluster(const Recipe& recipe) {
  Random random(recipe.seed);
  std::vector<Cap> caps(1 + recipe.n / 1000);
  for (Cap& cap : caps) cap = make_cap(random, recipe.angle_deg);
  return drawn(recipe.n, [&] {
    const Cap& cap = caps[random.below(caps.size())];
    const double t = random.unit();
    return in_cap(random, cap, t * t);
  });
}

Input patch(const Recipe& recipe) {
  Random random(recipe.seed);
  const Cap cap = make_cap(random, recipe.angle_deg);
  return drawn(recipe.n, [&] { return in_cap(random, cap, random.unit()); });
}

Input patch_and_globe(const Recipe& recipe) {
  Random random(recipe.seed);
  const Cap cap = make_cap(random, recipe.angle_deg);
  const std::size_t num_others = std::min<std::size_t>(1000, recipe.n / 2);
  Input input;
  input.sites.reserve(recipe.n);
  while (input.sites.size() + num_others < recipe.n) {
    input.sites.push_back(in_cap(random, cap, random.unit()));
  }
  while (input.sites.size() < recipe.n) input.sites.push_back(random.direction());
  return input;
}

Input on_parallel(const Recipe& recipe, double lat_deg) {
  Random random(recipe.seed);
  std::vector<LonLat> positions(recipe.n);
  for (LonLat& position : positions) position = {360 * random.unit() - 180, lat_deg};
  return from_positions(std::move(positions));
}

Input small_circle(const Recipe& recipe) { return on_parallel(recipe, 90 - recipe.angle_deg); }

Input great_circle(const Recipe& recipe) { return on_parallel(recipe, 0); }

Input ball(const Recipe& recipe) {
  Random random(recipe.seed);
  return drawn(recipe.n, [&] { return random.in_ball(); });
}

Input cube(const Recipe& recipe) {
  Random random(recipe.seed);
  return drawn(recipe.n, [&] { return random.in_cube(); });
}

// The sum of twelve uniform numbers, which is normal but for its tails.
double normal(Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.unit();
  return sum;
}

Input gaussian(const Recipe& recipe) {
  Random random(recipe.seed);
  return drawn(recipe.n, [&] {
    const double x = normal(random);
    const double y = normal(random);
    return Point{x, y, normal(random)};
  });
}

Input mixed_weights(const Recipe& recipe) {
  Input input = uniform(recipe);
  Point& far = input.sites[recipe.n / 2];
  far = 1e15 * far;
  return input;
}

Input integer(const Recipe& recipe) {
  constexpr std::uint64_t range = 20;
  Random random(recipe.seed);
  const auto draw = [&] {
    return static_cast<double>(random.below(2 * range + 1)) - static_cast<double>(range);
  };
  Input input;
  input.sites.reserve(recipe.n);
  while (input.sites.size() < recipe.n) {
    const double x = draw();
    const double y = draw();
    const double z = draw();
    if (x != 0 || y != 0 || z != 0) input.sites.push_back({x, y, z});
  }
  return input;
}

Input antipodal(const Recipe& recipe) {
  Random random(recipe.seed);
  Input input;
  input.sites.reserve(recipe.n + 1);
  while (input.sites.size() < recipe.n) {
    const Point p = random.direction();
    input.sites.push_back(p);
    input.sites.push_back({-p.x, -p.y, -p.z});
  }
  input.sites.resize(recipe.n);
  return input;
}

// Uniform centers without an arc sine: a latitude is accepted with a probability equal to its
// cosine.
Input circles(const Recipe& recipe) {
  Random random(recipe.seed);
  Input input;
  input.positions.reserve(recipe.n);
  input.radii_deg.reserve(recipe.n);
  while (input.positions.size() < recipe.n) {
    const double lat_deg = 90 * random.signed_unit();
    const double cosine = unit_vector({0, lat_deg}).x;
    if (random.unit() >= cosine) continue;
    input.positions.push_back({180 * random.signed_unit(), lat_deg});
    input.radii_deg.push_back(recipe.angle_deg * random.unit());
  }
  input.sites = polar_points(input.positions, input.radii_deg);
  return input;
}

constexpr std::array all_plain{
    Kind{"uniform", "random on the sphere", &uniform},
    Kind{"fibonacci", "the Fibonacci spiral: nearly equal distances, no randomness", &fibonacci, 0,
         false},
    Kind{"lonlat-grid", "parallels (both poles too) times meridians; see --rows", &lonlat_grid, 0,
         false},
    Kind{"grid", "centers of the cells of a grid of parallels and meridians", &grid, 0, false},
    Kind{"paper-s", "the set S_N of Caroli et al. 2010: N+1 sites on a spiral, and 4", &paper_s, 0,
         false},
    Kind{"cluster", "random clusters, one per 1000 sites (--angle: 2)", &cluster, 2},
    Kind{"patch", "random in one small cap (--angle: 1e-6 radians)", &patch,
         1e-6 * degrees_per_radian},
    Kind{"patch-and-globe", "patch, and 1000 that are random on the sphere", &patch_and_globe,
         1e-6 * degrees_per_radian},
    Kind{"small-circle", "random on one parallel (--angle from the pole: 30)", &small_circle, 30},
    Kind{"great-circle", "random on the equator: the triangulation has dimension 1", &great_circle},
    Kind{"circles", "random circles of radii up to --angle (30), for --radius radius", &circles,
         30},
    Kind{"ball", "random in the unit ball, for --model weighted", &ball},
    Kind{"cube", "random in a cube, for hull", &cube},
    Kind{"gaussian", "random in space, denser in the middle, for hull", &gaussian},
    Kind{"mixed-weights", "random on the sphere, and one at a distance of 1e15", &mixed_weights},
    Kind{"integer", "random integers from -20 to 20: many ties and duplicates", &integer},
    Kind{"antipodal", "random pairs of opposite sites", &antipodal},
};

}  // namespace

std::span<const Kind> plain_kinds() { return all_plain; }

}  // namespace rondel::inputs
