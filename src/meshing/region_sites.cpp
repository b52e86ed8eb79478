// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds which points lie in regions. The inside is to the left of all edges, so along any arc from
// q to p
//
//     depth(q) = depth(p) + edges that the arc leaves on their left side - edges that it enters on it,
//
// where the depth of a point is the number of regions that contain it. All arcs end at one pole p,
// and edges are sorted into bins by their azimuths around it, so that few are tested for a point.
// The depth of the pole follows, region by region, from two points on both sides of an edge:
// between them the depth falls by one, from 1 to 0.
//
// All signs are exact. If a corner lies on the great circle of the arc, or the pole on that of an
// edge, the arc is undecided and another pole is used.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "rondel/cell_set.h"
#include "rondel/compressed_rows.h"
#include "rondel/error.h"
#include "rondel/mesh_cull.h"
#include "rondel/predicates.h"
#include "system/job.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::mesh {
namespace {

// An edge of a region, which is to its left.
struct RegionEdge {
  Point from;
  Point to;
};

// Directions that no data is likely to be in line with.
constexpr std::array poles = {
    Point{0.2718281828, -0.3141592653, 0.9098}, Point{-0.5772156649, 0.6931471805, 0.4316},
    Point{0.6180339887, 0.4142135623, -0.6683}, Point{-0.7320508075, -0.2360679774, -0.6391},
    Point{0.1234567891, 0.9876543211, -0.0991}, Point{0.9159655941, 0.0915965594, 0.3909}};

// This angle is far larger than the rounding errors of azimuths.
constexpr double azimuth_margin = 1e-9;
constexpr std::size_t points_at_a_time = 256;
constexpr std::size_t max_bins = 1U << 16U;
// The first edge decides, unless the region is extremely thin there.
constexpr std::size_t max_edges_tried = 100;

// How an edge changes the depth along the arc from q to p.
enum class ArcCrossing : std::uint8_t { none, leaves_left, enters_left, through_q, unclear };

// True if q, which is on the great circle of the edge, is on the edge itself. The pole is not on
// that circle.
bool is_on_edge(const RegionEdge& edge, const Point& q, const Point& p) {
  if (is_same_site(q, edge.from) || is_same_site(q, edge.to)) return true;
  const Sign whole = orientation(p, edge.from, edge.to);
  return orientation(p, edge.from, q) == whole && orientation(p, q, edge.to) == whole;
}

// Returns how the edge changes the depth along the arc from q to p, by exact signs.
ArcCrossing crossing_of(const RegionEdge& edge, const Point& q, const Point& p) {
  const Sign from = orientation(q, p, edge.from);
  const Sign to = orientation(q, p, edge.to);
  if (from == to && from != Sign::zero) return ArcCrossing::none;
  const Sign side_of_p = orientation(edge.from, edge.to, p);
  if (side_of_p == Sign::zero) return ArcCrossing::unclear;
  const Sign side_of_q = orientation(edge.from, edge.to, q);
  if (side_of_q == Sign::zero) {
    return is_on_edge(edge, q, p) ? ArcCrossing::through_q : ArcCrossing::none;
  }
  if (from == Sign::zero || to == Sign::zero) return ArcCrossing::unclear;
  // Otherwise the edge crosses the great circle of the arc elsewhere, or in the other direction.
  if (side_of_q == side_of_p || to != side_of_q) return ArcCrossing::none;
  return side_of_q == Sign::positive ? ArcCrossing::leaves_left : ArcCrossing::enters_left;
}

// The edges of regions in bins of azimuths, which tell the depth of points.
class RegionSites {
 public:
  explicit RegionSites(const CellRings& regions) : frame_(frame_around(poles[0])) {
    std::vector<std::uint64_t> begins = {0};
    for (std::size_t i = 0; i < regions.num_cells(); ++i) {
      for (std::uint64_t r = regions.cells[i]; r < regions.cells[i + 1]; ++r) {
        add_ring(regions, regions.rings[r], regions.rings[r + 1]);
      }
      begins.push_back(edges_.size());
    }
    sort_by_azimuth();
    for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
      const std::span<const RegionEdge> of_region = std::span(edges_).subspan(
          static_cast<std::size_t>(begins[i]), static_cast<std::size_t>(begins[i + 1] - begins[i]));
      for (std::size_t k = 0; k < poles.size(); ++k) depths_[k] += depth_of_pole(of_region, k);
    }
    for (int& depth : depths_) depth += static_cast<int>(regions.whole.size());
  }

  // True if q is in a region or on a border. Where the first pole does not decide, the others are
  // tried with all edges.
  [[nodiscard]] bool has(const Point& q) const {
    const std::optional<int> near_one = change_of_depth(q);
    if (near_one) return *near_one == on_border || depths_[0] + *near_one > 0;
    for (std::size_t k = 1; k < poles.size(); ++k) {
      const std::optional<int> change = change_along(edges_, q, poles[k]);
      if (change) return *change == on_border || depths_[k] + *change > 0;
    }
    return false;
  }

 private:
  // Two axes of the plane around a pole, for azimuths.
  struct PolarFrame {
    exact::Vector3<double> u, v;
  };
  // This change of the depth stands for a point on an edge.
  static constexpr int on_border = -1'000'000'000;

  static PolarFrame frame_around(const Point& pole) {
    const auto axis = normalized(exact::to_vector(pole));
    const auto u = normalized(cross(axis, exact::Vector3<double>{1, 0, 0}));
    return {u, cross(axis, u)};
  }

  // Returns the azimuth around the pole in turns, from 0 to 1.
  [[nodiscard]] double azimuth(const Point& q) const {
    const auto x = exact::to_vector(q);
    const double turns =
        exact::argument(dot(x, frame_.v), dot(x, frame_.u)) / (2 * std::numbers::pi);
    return turns < 0 ? turns + 1 : turns;
  }

  // Adds the edges of a ring, without those between equal corners.
  void add_ring(const CellRings& regions, std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t k = begin; k < end; ++k) {
      const RegionEdge edge = {regions.points[regions.corners[k]],
                               regions.points[regions.corners[k + 1 < end ? k + 1 : begin]]};
      if (!is_same_site(edge.from, edge.to)) edges_.push_back(edge);
    }
  }

  // Lists for each bin the edges that reach into it, in compressed rows.
  void sort_by_azimuth() {
    num_bins_ = std::clamp<std::size_t>(edges_.size(), 1, max_bins);
    std::vector<std::array<std::size_t, 2>> spans;  // first bin and number of bins
    spans.reserve(edges_.size());
    system::RowPlaces places(num_bins_);
    for (const RegionEdge& edge : edges_) {
      spans.push_back(bins_of(edge));
      for (std::size_t j = 0; j < spans.back()[1]; ++j) {
        places.count((spans.back()[0] + j) % num_bins_);
      }
    }
    in_bins_.values.resize(places.sum());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      for (std::size_t j = 0; j < spans[e][1]; ++j) {
        in_bins_.values[places.place((spans[e][0] + j) % num_bins_)] = e;
      }
    }
    in_bins_.offsets = std::move(places).offsets();
  }

  // Returns the bins of an edge, which goes the shorter way around the pole; if it is not clear
  // which way is shorter, all bins.
  [[nodiscard]] std::array<std::size_t, 2> bins_of(const RegionEdge& edge) const {
    double first = azimuth(edge.from);
    double turn = azimuth(edge.to) - first;
    turn -= std::floor(turn + 0.5);
    if (std::abs(turn) > 0.49 || is_near_axis(edge.from) || is_near_axis(edge.to)) {
      return {0, num_bins_};
    }
    if (turn < 0) first += turn;
    const auto bins = static_cast<double>(num_bins_);
    const double begin = std::floor((first - azimuth_margin + 1) * bins);
    const double end = std::floor((first + std::abs(turn) + azimuth_margin + 1) * bins);
    const auto count = static_cast<std::size_t>(end - begin) + 1;
    return {static_cast<std::size_t>(begin) % num_bins_, std::min(count, num_bins_)};
  }
  // True near the pole and its antipode, where azimuths are inaccurate.
  [[nodiscard]] bool is_near_axis(const Point& q) const {
    const auto x = exact::to_vector(q);
    const double u = dot(x, frame_.u);
    const double v = dot(x, frame_.v);
    return u * u + v * v < 1e-6 * dot(x, x);
  }

  // Returns the change of the depth from the first pole to q, by the edges at its azimuth, or
  // nothing if it is undecided.
  [[nodiscard]] std::optional<int> change_of_depth(const Point& q) const {
    if (is_near_axis(q)) return change_along(edges_, q, poles[0]);
    const auto bin =
        static_cast<std::size_t>(azimuth(q) * static_cast<double>(num_bins_)) % num_bins_;
    int change = 0;
    for (const std::size_t e : in_bins_[bin]) {
      if (!add_crossing(edges_[e], q, poles[0], change)) return std::nullopt;
    }
    return change;
  }
  // Returns the change of the depth from p to q by all of these edges; nothing if it is undecided.
  static std::optional<int> change_along(std::span<const RegionEdge> edges, const Point& q,
                                         const Point& p) {
    int change = 0;
    for (const RegionEdge& edge : edges) {
      if (!add_crossing(edge, q, p, change)) return std::nullopt;
    }
    return change;
  }
  // Adds the crossing of one edge to the change; false if it is undecided.
  static bool add_crossing(const RegionEdge& edge, const Point& q, const Point& p, int& change) {
    switch (crossing_of(edge, q, p)) {
      case ArcCrossing::none:
        return true;
      case ArcCrossing::leaves_left:
        if (change != on_border) ++change;
        return true;
      case ArcCrossing::enters_left:
        if (change != on_border) --change;
        return true;
      case ArcCrossing::through_q:
        change = on_border;
        return true;
      case ArcCrossing::unclear:
        return change == on_border;
    }
    return true;
  }

  // Returns 1 if region k contains the pole, else 0. The depths of two points beside one of its
  // edges differ by one.
  static int depth_of_pole(std::span<const RegionEdge> edges, std::size_t k) {
    const std::size_t step = 1 + edges.size() / max_edges_tried;
    for (const double away : {1e-3, 1e-6, 1e-1}) {
      for (std::size_t e = 0; e < edges.size(); e += step) {
        const RegionEdge& edge = edges[e];
        const auto a = exact::to_vector(edge.from);
        const auto b = exact::to_vector(edge.to);
        const auto middle = normalized(a + b);
        const auto left = away * cross(middle, b - a);
        const auto in = change_along(edges, exact::to_point(middle + left), poles[k]);
        const auto out = change_along(edges, exact::to_point(middle - left), poles[k]);
        if (in && out && *in != on_border && *out != on_border && *in == *out + 1) return 1 - *in;
      }
    }
    return 0;
  }

  std::vector<RegionEdge> edges_;
  PolarFrame frame_;
  std::size_t num_bins_ = 0;
  CompressedRows<std::size_t> in_bins_;
  std::array<int, poles.size()> depths_{};
};

}  // namespace

std::vector<std::uint8_t> inside(std::span<const Point> points, const CellRings& regions,
                                 const Execution& execution) {
  const system::Call call(execution);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& q = points[i];
    if (!std::isfinite(q.x) || !std::isfinite(q.y) || !std::isfinite(q.z) || q == Point{}) {
      throw InvalidInput("point " + std::to_string(i) + " is not finite or the center", i);
    }
  }
  (void)CellSet::polygons(regions, execution);  // throws for invalid rings
  const RegionSites sites(regions);
  std::vector<std::uint8_t> result(points.size());
  system::parallel_for(execution.threads, points.size(), points_at_a_time,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           result[i] = sites.has(points[i]) ? 1 : 0;
                         }
                       });
  return result;
}

}  // namespace rondel::mesh
