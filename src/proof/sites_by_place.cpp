// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "proof/sites_by_place.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "rondel/predicates.h"

namespace rondel::proof {
namespace {

// A site in a cell. Entries with equal keys are in one cell.
struct CellEntry {
  std::uint64_t major;
  std::uint64_t minor;
  Index site;
  friend auto operator<=>(const CellEntry&, const CellEntry&) = default;
};

bool is_lexicographically_less(const Point& a, const Point& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// The position of a finite double among all doubles: consecutive doubles have consecutive
// positions, and both zeros have position 0.
std::int64_t position(double value) {
  const auto bits = std::bit_cast<std::int64_t>(std::abs(value));
  return value < 0 ? -bits : bits;
}

// The vector from the center to the site up to a positive factor, each coordinate with relative
// error 2^-53: a difference of doubles is rounded once and cannot underflow. Where it overflows,
// quarters do not; what the quartering of a subnormal number loses is far below half a
// subnormal unit of any ratio to the coordinate that overflowed.
std::array<double, 3> offset(const Point& p, const Point& center) {
  std::array<double, 3> d{p.x - center.x, p.y - center.y, p.z - center.z};
  if (!std::ranges::all_of(d, [](double v) { return std::isfinite(v); })) {
    d = {p.x / 4 - center.x / 4, p.y / 4 - center.y / 4, p.z / 4 - center.z / 4};
  }
  return d;
}

// How far a computed ratio r of two coordinates of offset(), |r| <= 1, may be from the exact one,
// in positions. The relative error is below 3.01 * 2^-53 (two coordinates, one division), that is
// below 3.01 units in the last place, which are twice as many positions just
// below a power of two; a subnormal ratio adds half a position. So 7 suffice.
constexpr std::int64_t reach = 8;
// Cells of 2^10 positions, shifted by half a cell so that the ratios of short mantissa,
// which structured data are full of, lie in the middle of a cell.
constexpr int cell_bits = 10;

std::int64_t cell_of(std::int64_t at) { return (at + (1 << (cell_bits - 1))) >> cell_bits; }

// Enters a ray where it may pierce the cube [-1,1]^3 around the center: on the face of each
// coordinate that may be the largest in exact arithmetic, at the ratios of
// the other two to it. A ray's exact place (the first largest coordinate, the exact ratios)
// depends on the ray alone and lies in one of these cells.
void enter_ray(std::vector<CellEntry>& entries, Index site, const std::array<double, 3>& d) {
  const double largest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (position(1.0) - position(std::abs(d[axis]) / largest) > reach) continue;
    const std::uint64_t cube_face = 2 * axis + (d[axis] < 0 ? 1U : 0U);
    const std::int64_t u = position(d[(axis + 1) % 3] / std::abs(d[axis]));
    const std::int64_t v = position(d[(axis + 2) % 3] / std::abs(d[axis]));
    for (std::int64_t i = cell_of(u - reach); i <= cell_of(u + reach); ++i) {
      for (std::int64_t j = cell_of(v - reach); j <= cell_of(v + reach); ++j) {
        // |i| < 2^53, so the shift keeps all bits.
        entries.push_back({(static_cast<std::uint64_t>(i) << 3) | cube_face,
                           static_cast<std::uint64_t>(j), site});
      }
    }
  }
}

// A place in the weighted model is a point, known exactly; the key is a hash of it.
void enter_point(std::vector<CellEntry>& entries, Index site, const Point& p) {
  const auto mix = [](std::uint64_t h, double value) {
    h = (h ^ static_cast<std::uint64_t>(position(value))) * 0x9e3779b97f4a7c15U;
    return h ^ (h >> 29);
  };
  const std::uint64_t xy = mix(mix(0, p.x), p.y);
  entries.push_back({xy, mix(xy, p.z), site});
}

// Brings the sites of one cell in an order in which duplicates are neighbors and, among them, the
// lowest index is first. For the rays of a cell on the face of coordinate m,
// det(a, b, e_j) = +-(a_k b_m - b_k a_m) with a_m b_m > 0: it orders them by the slope
// a_k/a_m, exactly, and equal slopes in both planes mean equal rays.
void sort_cell(std::span<CellEntry> cell, std::span<const Point> sites, Model model,
               const Sphere& sphere) {
  if (model == Model::weighted) {
    std::ranges::sort(cell, [&](const CellEntry& a, const CellEntry& b) {
      const Point& p = sites[a.site];
      const Point& q = sites[b.site];
      return p == q ? a.site < b.site : is_lexicographically_less(p, q);
    });
    return;
  }
  const auto axis = static_cast<unsigned>(cell[0].major & 7U) / 2;
  const std::array<Point, 2> poles{axis_point(sphere.center, (axis + 1) % 3),
                                   axis_point(sphere.center, (axis + 2) % 3)};
  std::ranges::sort(cell, [&](const CellEntry& a, const CellEntry& b) {
    for (const Point& pole : poles) {
      const Sign s = orientation(sites[a.site], sites[b.site], pole, sphere);
      if (s != Sign::zero) return s == Sign::positive;
    }
    return a.site < b.site;
  });
}

// In the cell of the exact place all sites of a place meet, so the least index over all cells
// that a site is in is the lowest of its place.
void group_cell(SitesByPlace& places, std::span<CellEntry> cell, std::span<const Point> sites,
                Model model, const Sphere& sphere) {
  if (cell.size() < 2) return;
  sort_cell(cell, sites, model, sphere);
  Index lowest = cell[0].site;
  for (const CellEntry& entry : cell.subspan(1)) {
    if (!is_same_site(sites[lowest], sites[entry.site], model, sphere)) lowest = entry.site;
    places.first[entry.site] = std::min(places.first[entry.site], lowest);
  }
}

}  // namespace

SitesByPlace group_by_place(std::span<const Point> sites, Model model, const Sphere& sphere) {
  const auto n = static_cast<Index>(sites.size());
  std::vector<CellEntry> entries;
  entries.reserve(n + n / 16);
  for (Index i = 0; i < n; ++i) {
    if (model == Model::weighted) {
      enter_point(entries, i, sites[i]);
    } else {
      enter_ray(entries, i, offset(sites[i], sphere.center));
    }
  }
  std::ranges::sort(entries);

  SitesByPlace places;
  places.first.resize(n);
  std::iota(places.first.begin(), places.first.end(), Index{0});
  const std::span<CellEntry> all(entries);
  for (std::size_t i = 0, j = 0; i < all.size(); i = j) {
    while (j < all.size() && all[j].major == all[i].major && all[j].minor == all[i].minor) ++j;
    group_cell(places, all.subspan(i, j - i), sites, model, sphere);
  }

  places.representative = places.first;
  for (Index i = 0; i < n; ++i) {
    Index& representative = places.representative[places.first[i]];
    if (is_lexicographically_less(sites[i], sites[representative])) representative = i;
  }
  return places;
}

}  // namespace rondel::proof
