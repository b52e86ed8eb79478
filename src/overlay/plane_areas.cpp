// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A cell that is only as wide as the distance of its sides' arcs from their lines may get another
// area by the arcs, however near they are. The area that an arc adds is known in closed form. For a
// line over d radians of longitude, with f the latitude of its middle and h half of its height, the
// integral of the sine of latitude is
//
//   d sin f sin h / h                               along the line
//   2 atan(k tan(d / 2)) with k = sin f / cos h     along the arc
//
// Where these differences add up to more than a share of the area, all sides of the cell are
// halved. The number of halvings assumes a fourth of the difference each time, since differences go
// with the cube of d or with d h^2.
#include "overlay/plane_areas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "exact/angles.h"
#include "overlay/arc_bulge.h"
#include "overlay/measure.h"
#include "overlay/straight_sides.h"
#include "system/parallel.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t cells_per_block = 64;
constexpr double radian = std::numbers::pi / 180;
constexpr unsigned max_halvings = 12;

double sine_of(double degrees) { return exact::sine_cosine_of_degrees(degrees).sine; }

// Sums over the border of a cell, whose inside is to the left.
class LineStrips {
 public:
  LineStrips(double lat_deg, double share) : reference_deg_(lat_deg), share_(share) {}

  void add(const LonLat& from, const LonLat& to) {
    const double width = (from.lon_deg - to.lon_deg) * radian;
    const double height = (to.lat_deg - from.lat_deg) * radian;
    length_ += std::abs(height);
    if (width == 0) return;
    const double middle = (from.lat_deg + to.lat_deg) / 2;
    const exact::SineCosine at_middle = exact::sine_cosine_of_degrees(middle);
    const double ratio = sine_ratio_less_one(height / 2);
    area_ += width * mean_rise(reference_deg_, from.lat_deg, to.lat_deg);
    length_ += std::abs(width) * at_middle.cosine;
    if (std::abs(from.lat_deg) == 90 && std::abs(to.lat_deg) == 90) return;
    const exact::SineCosine half = exact::sine_cosine_of_degrees((to.lat_deg - from.lat_deg) / 2);
    // These are 1 / cos h - sin h / h, and 1 - |k| from the distances from the pole.
    const double of_slope = half.sine * half.sine / (half.cosine * (1 + half.cosine)) - ratio;
    const double gap = 2 * sine_of((90 - std::abs(from.lat_deg)) / 2) *
                       sine_of((90 - std::abs(to.lat_deg)) / 2) / half.cosine;
    const double k = at_middle.sine / half.cosine;
    const bool is_on_one_side = from.lat_deg * to.lat_deg > 0;
    const double bulge = area_of_bulge(std::abs(width), k, is_on_one_side ? gap : 1 - std::abs(k));
    excess_ += width * at_middle.sine * of_slope + (width > 0 ? bulge : -bulge);
  }

  // Returns by how much the area between arcs exceeds that between lines, as a multiple of what is
  // allowed.
  [[nodiscard]] double excess_ratio() const {
    return std::abs(excess_) / (share_ * std::abs(area_) + area_of_rounding(length_));
  }

 private:
  double reference_deg_;
  double share_;
  double area_ = 0;    // the area between lines
  double excess_ = 0;  // the area between arcs minus that between lines
  double length_ = 0;
};

// The positions of a cell's sides, from side `first` to side `end`.
class CellLines {
 public:
  CellLines(std::span<const PlaneSide> sides, const DividedSides& divided, std::size_t first,
            std::size_t end, double share)
      : sides_(sides), divided_(divided), first_(first), end_(end), share_(share) {}

  // True if bounds for each line, which need no trigonometry, show that the area is right. The
  // difference of a line is at most d (0.04 d^2 + 0.21 H^2 sin f) with its height H, both at most
  // 90 degrees, and the area is at least that in the plane times the least cosine.
  [[nodiscard]] bool is_surely_right() const {
    const LonLat& origin = sides_[first_].from;
    double of_widths = 0;
    double of_heights = 0;
    double area = 0;
    double extent = 0;
    double farthest = 0;
    visit([&](const LonLat& from, const LonLat& to) {
      const double width = std::abs(to.lon_deg - from.lon_deg);
      const double height = to.lat_deg - from.lat_deg;
      of_widths += 0.04 * width * width * width;
      of_heights += 0.21 * width * height * height;
      area += (from.lon_deg - to.lon_deg) * (from.lat_deg - origin.lat_deg + height / 2);
      extent = std::max(extent, width * std::abs(from.lat_deg - origin.lat_deg + height / 2));
      farthest = std::max({farthest, std::abs(from.lat_deg), std::abs(to.lat_deg)});
    });
    const auto [sine, cosine] = exact::sine_cosine_of_degrees(farthest);
    return (of_widths + of_heights * sine) * radian <= share_ * (area - 1e-9 * extent) * cosine;
  }

  // Returns by how much the area exceeds what is allowed, as LineStrips::excess_ratio().
  [[nodiscard]] double excess_ratio() const {
    LineStrips strips(sides_[first_].from.lat_deg, share_);
    visit([&](const LonLat& from, const LonLat& to) { strips.add(from, to); });
    return strips.excess_ratio();
  }

 private:
  template <class Visit>
  void visit(const Visit& visit) const {
    for (std::size_t s = first_; s < end_; ++s) {
      const std::uint64_t end = divided_.offsets[s + 1];
      for (std::uint64_t k = divided_.offsets[s]; k < end; ++k) {
        visit(divided_.values[k], k + 1 < end ? divided_.values[k + 1] : sides_[s].to);
      }
    }
  }

  std::span<const PlaneSide> sides_;
  const DividedSides& divided_;
  std::size_t first_;
  std::size_t end_;
  double share_;
};

// The ends of a side, the same for both directions and for every turn of the globe.
using SidePlace = std::tuple<double, double, double, double>;

SidePlace place_of(const PlaneSide& side) {
  const auto turned = [](const LonLat& p) {
    const bool is_turned = p.lon_deg < -180 || p.lon_deg > 180;
    const double lon = is_turned ? std::remainder(p.lon_deg, 360.0) : p.lon_deg;
    return std::pair(lon == 180 ? -180 : lon, p.lat_deg);
  };
  const std::pair from = turned(side.from);
  const std::pair to = turned(side.to);
  const auto& [low, high] = std::minmax(from, to);
  return {low.first, low.second, high.first, high.second};
}

// Returns how often the sides of a cell are to be halved.
unsigned halvings_for(double excess_ratio) {
  unsigned count = 0;
  for (; excess_ratio > 1 && count < max_halvings; excess_ratio /= 4) ++count;
  return count;
}

// Halves the sides of cells whose areas differ by too much.
class AreaKeeper {
 public:
  AreaKeeper(std::span<const PlaneSide> sides, std::span<const Index> owners, double tolerance,
             unsigned threads)
      : sides_(sides),
        share_(area_share(tolerance)),
        threads_(threads),
        divider_(sides, owners.size(), tolerance, threads),
        num_halvings_(sides.size(), 0) {
    for (std::size_t s = 0; s <= owners.size(); ++s) {
      if (s == 0 || s == owners.size() || owners[s] != owners[s - 1]) begins_.push_back(s);
    }
  }

  // Returns the divided sides of all cells.
  DividedSides operator()() {
    DividedSides divided = divider_.divided();
    std::vector<std::size_t> cells(begins_.size() - 1);
    std::iota(cells.begin(), cells.end(), std::size_t{0});
    while (!cells.empty()) {
      const std::vector<std::uint8_t> times = find_halvings(divided, cells);
      cells.clear();
      if (times.empty()) break;
      for (const Index side : divider_.halve(times)) {
        if (side >= begins_.back()) break;  // sides without an owner
        const auto after = std::ranges::upper_bound(begins_, side);
        const auto cell = static_cast<std::size_t>(after - begins_.begin() - 1);
        if (cells.empty() || cells.back() != cell) cells.push_back(cell);
      }
      divided = divider_.divided();
    }
    return divided;
  }

 private:
  // Returns how often each side is to be halved for these cells, or nothing if no side is to be
  // halved or halving does not help.
  std::vector<std::uint8_t> find_halvings(const DividedSides& divided,
                                          const std::vector<std::size_t>& cells) {
    std::vector<unsigned> of_cells(cells.size(), 0);
    system::parallel_for(
        threads_, cells.size(), cells_per_block, [&](std::size_t begin, std::size_t end) {
          for (std::size_t k = begin; k < end; ++k) {
            const CellLines cell(sides_, divided, begins_[cells[k]], begins_[cells[k] + 1], share_);
            if (!cell.is_surely_right()) of_cells[k] = halvings_for(cell.excess_ratio());
          }
        });
    std::vector<std::pair<SidePlace, std::uint8_t>> found;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (of_cells[k] == 0) continue;
      for (std::size_t s = begins_[cells[k]]; s < begins_[cells[k] + 1]; ++s) {
        const unsigned times = std::min(of_cells[k], max_halvings - num_halvings_[s]);
        if (times == 0 || sides_[s].from.lon_deg == sides_[s].to.lon_deg) continue;
        found.emplace_back(place_of(sides_[s]), static_cast<std::uint8_t>(times));
      }
    }
    if (found.empty()) return {};
    std::ranges::sort(found);
    std::vector<std::uint8_t> times(sides_.size(), 0);
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      const SidePlace place = place_of(sides_[s]);
      auto at = std::ranges::lower_bound(found, std::pair(place, std::uint8_t{0}));
      for (; at != found.end() && at->first == place; ++at) times[s] = at->second;
      num_halvings_[s] = static_cast<std::uint8_t>(num_halvings_[s] + times[s]);
    }
    return times;
  }

  std::span<const PlaneSide> sides_;
  double share_;
  unsigned threads_;
  SideDivider divider_;
  // Where the sides of each cell begin, for the cells that have any, and where those of the last
  // one end.
  std::vector<std::size_t> begins_;
  std::vector<std::uint8_t> num_halvings_;
};

}  // namespace

DividedSides divide_for_areas(std::span<const PlaneSide> sides, std::span<const Index> owners,
                              double tolerance, unsigned threads) {
  return AreaKeeper(sides, owners, tolerance, threads)();
}

}  // namespace rondel::overlay
