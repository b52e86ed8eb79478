// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "generate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "random.h"
#include "rondel/delaunay.h"

namespace rondel::cli {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

Generated from_positions(std::vector<LonLat> positions) {
  Generated result;
  result.sites = unit_vectors(positions);
  result.positions = std::move(positions);
  return result;
}

Generated uniform(const Recipe& recipe) {
  Random random(recipe.seed);
  Generated result;
  result.sites.resize(recipe.n);
  for (Point& site : result.sites) site = random.direction();
  return result;
}

// Equal steps in z; the longitude advances by the golden section of a turn. The turns are counted
// in units of 2^-64, so the fraction is exact for every n.
Generated fibonacci(const Recipe& recipe) {
  constexpr std::uint64_t golden = 0x9e37'79b9'7f4a'7c15U;
  Generated result;
  result.sites.reserve(recipe.n);
  const auto n = static_cast<double>(recipe.n);
  for (std::uint64_t i = 0; i < recipe.n; ++i) {
    const double turns = static_cast<double>((i * golden) >> 11) * 0x1p-53;
    const Point around = unit_vector({360 * turns, 0});
    const double z = (n - 1 - 2 * static_cast<double>(i)) / n;
    const double r = std::sqrt((1 - z) * (1 + z));
    result.sites.push_back({r * around.x, r * around.y, z});
  }
  return result;
}

// Rows and columns whose product is as near to n as possible while the steps in latitude and
// longitude stay within about 10 % of each other.
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

// a i/n - b, rounded once, so that the grid is its own mirror image.
double fraction(double a, std::size_t i, double b, std::size_t n) {
  const auto steps = static_cast<double>(n);
  return (a * static_cast<double>(i) - b * steps) / steps;
}

// The grid of climate data: both poles are rows, and the seam at 180 degrees occurs once.
Generated lonlat_grid(const Recipe& recipe) {
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

// The set S_n of the paper, section 5: n+1 points with longitude theta = k pi/n and colatitude
// phi = (theta^2 + 1) / pi^2, and four more that put the center inside the hull.
Generated paper_s(const Recipe& recipe) {
  constexpr double inverse_pi_squared = 1 / (std::numbers::pi * std::numbers::pi);
  Generated result;
  result.sites.reserve(recipe.n + 5);
  for (std::size_t k = 0; k <= recipe.n; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(recipe.n);
    const double colatitude = (t * t + inverse_pi_squared) * degrees_per_radian;
    result.sites.push_back(unit_vector({180 * t, 90 - colatitude}));
  }
  const double c = -1 / std::sqrt(3.0);
  for (const Point& p : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}, Point{c, c, c}}) {
    result.sites.push_back(p);
  }
  return result;
}

// A cap of the sphere: a direction and two more that are orthogonal to it.
struct Cap {
  Point center, east, north;
  double height = 0;  // 1 - cos(angular radius)
};

Cap make_cap(Random& random, double angle_deg) {
  const Point c = random.direction();
  const Point q = unit_vector({angle_deg, 0});
  // Duff et al., Building an orthonormal basis, revisited, JCGT 2017.
  const double sign = c.z < 0 ? -1 : 1;
  const double a = -1 / (sign + c.z);
  const double b = c.x * c.y * a;
  // 1 - cos without cancellation
  const double height = q.x > 0 ? q.y * q.y / (1 + q.x) : 1 - q.x;
  return {c,
          {1 + sign * c.x * c.x * a, sign * b, -sign * c.x},
          {b, sign + c.y * c.y * a, -c.y},
          height};
}

// The point of the cap at this fraction of its height, at a random longitude; uniform
// in the cap if the fraction is uniform in [0, 1).
Point in_cap(Random& random, const Cap& cap, double fraction) {
  const double h = cap.height * fraction;
  const double r = std::sqrt(h * (2 - h));
  const Point around = unit_vector({360 * random.unit(), 0});
  const double u = r * around.x;
  const double v = r * around.y;
  const double w = 1 - h;
  const auto mix = [&](double Point::*k) {
    return w * cap.center.*k + (u * cap.east.*k + v * cap.north.*k);
  };
  return {mix(&Point::x), mix(&Point::y), mix(&Point::z)};
}

// A cluster for about each thousand sites, denser towards its middle.
Generated cluster(const Recipe& recipe) {
  Random random(recipe.seed);
  const double angle = recipe.angle_deg > 0 ? recipe.angle_deg : 2;
  std::vector<Cap> caps(1 + recipe.n / 1000);
  for (Cap& cap : caps) cap = make_cap(random, angle);
  Generated result;
  result.sites.resize(recipe.n);
  for (Point& site : result.sites) {
    const Cap& cap = caps[random.below(caps.size())];
    const double t = random.unit();
    site = in_cap(random, cap, t * t);
  }
  return result;
}

Generated patch(const Recipe& recipe) {
  Random random(recipe.seed);
  const Cap cap =
      make_cap(random, recipe.angle_deg > 0 ? recipe.angle_deg : 1e-6 * degrees_per_radian);
  Generated result;
  result.sites.resize(recipe.n);
  for (Point& site : result.sites) site = in_cap(random, cap, random.unit());
  return result;
}

Generated on_parallel(const Recipe& recipe, double lat_deg) {
  Random random(recipe.seed);
  std::vector<LonLat> positions(recipe.n);
  for (LonLat& position : positions) position = {360 * random.unit() - 180, lat_deg};
  return from_positions(std::move(positions));
}

Generated small_circle(const Recipe& recipe) {
  return on_parallel(recipe, 90 - (recipe.angle_deg > 0 ? recipe.angle_deg : 30));
}

Generated great_circle(const Recipe& recipe) { return on_parallel(recipe, 0); }

Generated ball(const Recipe& recipe) {
  Random random(recipe.seed);
  Generated result;
  result.sites.reserve(recipe.n);
  while (result.sites.size() < recipe.n) {
    const double x = random.symmetric();
    const double y = random.symmetric();
    const double z = random.symmetric();
    if (x * x + y * y + z * z <= 1) result.sites.push_back({x, y, z});
  }
  return result;
}

Generated integer(const Recipe& recipe) {
  constexpr std::uint64_t range = 20;
  Random random(recipe.seed);
  const auto draw = [&] {
    return static_cast<double>(random.below(2 * range + 1)) - static_cast<double>(range);
  };
  Generated result;
  result.sites.reserve(recipe.n);
  while (result.sites.size() < recipe.n) {
    const double x = draw();
    const double y = draw();
    const double z = draw();
    if (x != 0 || y != 0 || z != 0) result.sites.push_back({x, y, z});
  }
  return result;
}

Generated antipodal(const Recipe& recipe) {
  Random random(recipe.seed);
  Generated result;
  result.sites.reserve(recipe.n + 1);
  while (result.sites.size() < recipe.n) {
    const Point p = random.direction();
    result.sites.push_back(p);
    result.sites.push_back({-p.x, -p.y, -p.z});
  }
  result.sites.resize(recipe.n);
  return result;
}

// Uniform centers without an arc sine: a latitude is taken with a probability that is its cosine.
Generated circles(const Recipe& recipe) {
  Random random(recipe.seed);
  const double largest_deg = recipe.angle_deg > 0 ? recipe.angle_deg : 30;
  Generated result;
  result.positions.reserve(recipe.n);
  result.radii_deg.reserve(recipe.n);
  while (result.positions.size() < recipe.n) {
    const double lat_deg = 90 * random.symmetric();
    const double cosine = unit_vector({0, lat_deg}).x;
    if (random.unit() >= cosine) continue;
    result.positions.push_back({180 * random.symmetric(), lat_deg});
    result.radii_deg.push_back(largest_deg * random.unit());
  }
  result.sites = polar_points(result.positions, result.radii_deg);
  return result;
}

constexpr std::array<Kind, 12> all_kinds{{
    {"uniform", "random on the sphere", &uniform, false},
    {"fibonacci", "the Fibonacci spiral: nearly equal distances, no randomness", &fibonacci, false},
    {"lonlat-grid", "parallels (both poles too) times meridians; see --rows", &lonlat_grid, false},
    {"paper-s", "the set S_N of Caroli et al. 2010: N+1 sites on a spiral, and 4", &paper_s, false},
    {"cluster", "random clusters, one per 1000 sites (--angle: 2)", &cluster, true},
    {"patch", "random in one small cap (--angle: 1e-6 radians)", &patch, true},
    {"small-circle", "random on one parallel (--angle from the pole: 30)", &small_circle, true},
    {"great-circle", "random on the equator: the triangulation has dimension 1", &great_circle,
     false},
    {"circles", "random circles of radii up to --angle (30), for --radius radius", &circles, true},
    {"ball", "random in the unit ball, for --model weighted", &ball, false},
    {"integer", "random integers from -20 to 20: many ties and duplicates", &integer, false},
    {"antipodal", "random pairs of opposite sites", &antipodal, false},
}};

}  // namespace

std::span<const Kind> kinds() { return all_kinds; }

const Kind* find_kind(std::string_view name) {
  const auto at = std::ranges::find(all_kinds, name, &Kind::name);
  return at == all_kinds.end() ? nullptr : &*at;
}

}  // namespace rondel::cli
