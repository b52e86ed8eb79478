// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites on both sides of lines. A pair of dividers, opened by half a spacing, walks along the line; where it
// stands there is a site, in turn to the left and to the right:
//
//     L       L       L             the rows of a lattice of hexagons, the line in the middle; edges of cells
//   .   .   .   .   .   .   line    go to and fro between the rows, and their corners are a quarter of the side
//         R       R       R         of a hexagon, 0.144 of the spacing, away from the line
//
// Where the line is smooth: its curvature adds (spacing / 2)^2 / (8 radius) at most.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "exact/vector.h"
#include "meshing/feature_outlines.h"
#include "meshing/fixed_sites.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_lines.h"
#include "rondel/query.h"
#include "system/job.h"

namespace rondel::mesh {
namespace {

using StationVector = exact::Vector3<double>;

// Of the spacing: between two stations; from the line to a row, half of the height of a triangle.
constexpr double half_step = 0.5;
constexpr double row_offset = 0.43301270189221935;  // sqrt(3) / 4
// What is too near: to another site, and to a station.
constexpr double least_site_distance = 0.7;
constexpr double least_station_distance = 0.3;
constexpr std::size_t fewest_stations = 6;
constexpr int most_fits = 8;

struct Stations {
  std::vector<Point> places;
  std::vector<double> spacings;
  double steps = 0;  // of the whole line, the last one in part
};

class LineWalk {
 public:
  LineWalk(const std::vector<Point>& line, const SizeFunction& size) : line_(line), size_(size) {}

  // From the first point on, steps of `stretch` half spacings.
  [[nodiscard]] Stations walk(double stretch, std::size_t most) const {
    Stations found;
    Point at = line_.front();
    std::size_t segment = 0;
    double along = 0;
    for (;;) {
      const double spacing = size_.spacing(at);
      found.places.push_back(at);
      found.spacings.push_back(spacing);
      const double step = stretch * half_step * spacing;
      if (!advance(at, segment, along, step)) {
        found.steps = static_cast<double>(found.places.size() - 1) +
                      std::min(1.0, distance(at, line_.back()) / step);
        return found;
      }
      if (found.places.size() >= most) {
        throw InvalidInput("there are too many sites along a line", 0);
      }
    }
  }

 private:
  static double distance(const Point& a, const Point& b) { return norm(a - b); }

  [[nodiscard]] Point place(std::size_t segment, double along) const {
    const StationVector a = exact::to_vector(line_[segment]);
    const StationVector b = exact::to_vector(line_[segment + 1]);
    return exact::to_point(normalized(a + along * (b - a)));
  }

  // To the first place that is so far away; false if there is none up to the end.
  bool advance(Point& at, std::size_t& segment, double& along, double step) const {
    const Point from = at;
    while (distance(from, line_[segment + 1]) < step) {
      if (++segment + 1 == line_.size()) return false;
      along = 0;
    }
    // Distances from a place grow along an arc once they do, so this bisection finds where one is passed.
    double low = along;
    double high = 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (distance(from, place(segment, middle)) < step ? low : high) = middle;
    }
    along = high;
    at = place(segment, along);
    return true;
  }

  const std::vector<Point>& line_;
  const SizeFunction& size_;
};

bool is_closed(const std::vector<Point>& line) {
  // As of corners in files, positions so near are one.
  constexpr double same_place = 1e-10;
  return line.size() > 3 && norm(line.front() - line.back()) < same_place;
}

// An even number of steps that come back to the first.
Stations closed_stations(const LineWalk& line, std::size_t most) {
  double stretch = 1;
  Stations best;
  double least_gap = 2;
  for (int fit = 0; fit < most_fits; ++fit) {
    Stations found = line.walk(stretch, most);
    const double wanted = 2 * std::floor(0.5 * found.steps + 0.5);
    if (wanted < static_cast<double>(fewest_stations)) return {};
    const double gap = std::abs(found.steps - wanted);
    stretch *= found.steps / wanted;
    if (gap >= least_gap) continue;
    least_gap = gap;
    found.places.resize(std::min(found.places.size(), static_cast<std::size_t>(wanted)));
    found.spacings.resize(found.places.size());
    best = std::move(found);
  }
  if (best.places.size() % 2 == 1) {
    best.places.pop_back();
    best.spacings.pop_back();
  }
  return best;
}

struct LineCandidates {
  std::vector<Point> stations;
  std::vector<Point> sites;
  std::vector<double> spacings;
};

void add_rows(const Stations& stations, bool closed, LineCandidates& candidates) {
  const std::size_t n = stations.places.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = k > 0 ? k - 1 : (closed ? n - 1 : 0);
    const std::size_t after = k + 1 < n ? k + 1 : (closed ? 0 : n - 1);
    const StationVector at = exact::to_vector(stations.places[k]);
    const StationVector left =
        cross(at, exact::to_vector(stations.places[after] - stations.places[before]));
    const double length = norm(left);
    if (!(length > 0)) continue;
    const double offset = (k % 2 == 0 ? row_offset : -row_offset) * stations.spacings[k] / length;
    candidates.stations.push_back(stations.places[k]);
    candidates.sites.push_back(exact::to_point(normalized(at + offset * left)));
    candidates.spacings.push_back(stations.spacings[k]);
  }
}

// Those of the candidates that are far enough from what comes before them, and from stations.
LineSites sites_apart(const LineCandidates& candidates, const Execution& execution) {
  LineSites result;
  const std::size_t n = candidates.sites.size();
  if (n == 0) return result;
  const Execution quietly{.threads = execution.threads};
  const Triangulation of_sites = delaunay(Sites::view(candidates.sites), {}, quietly);
  const Locator sites(of_sites);
  const Triangulation of_stations = delaunay(Sites::view(candidates.stations), {}, quietly);
  const Locator stations(of_stations);
  std::vector<char> is_left_out(n, 0);
  for (const Duplicate& duplicate : of_sites.duplicates()) is_left_out[duplicate.site] = 1;
  const std::vector<Index> nearest = stations.nearest(candidates.sites, quietly);
  for (std::size_t i = 0; i < n; ++i) {
    const Point& site = candidates.sites[i];
    const double spacing = candidates.spacings[i];
    if (norm(site - candidates.stations[nearest[i]]) < least_station_distance * spacing) {
      is_left_out[i] = 1;
    }
    if (is_left_out[i] == 0) {
      const std::vector<Index> near = sites.within(site, least_site_distance * spacing);
      const bool is_taken = std::ranges::any_of(
          near, [&](Index other) { return other < i && is_left_out[other] == 0; });
      if (is_taken) is_left_out[i] = 1;
    }
    if (is_left_out[i] == 0) {
      result.sites.push_back(site);
    } else {
      ++result.num_left_out;
    }
  }
  return result;
}

void require_line(const std::vector<Point>& line, std::size_t index) {
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Point& p = line[k];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || p == Point{}) {
      throw InvalidInput(
          "a point of line " + std::to_string(index) + " is not finite or the center", index);
    }
  }
}

// As unit vectors, without points that repeat the one before.
std::vector<Point> line_of_units(const std::vector<Point>& line, std::size_t index) {
  std::vector<Point> units;
  for (const Point& p : unit_places(line)) {
    if (units.empty() || p != units.back()) units.push_back(p);
  }
  for (std::size_t k = 0; k + 1 < units.size(); ++k) {
    constexpr double nearly_antipodes = 1e-9;
    if (norm(units[k] + units[k + 1]) < nearly_antipodes) {
      throw InvalidInput("neighbors in line " + std::to_string(index) + " are antipodes", index);
    }
  }
  return units;
}

}  // namespace

LineSites sites_along(std::span<const std::vector<Point>> lines, const SizeFunction& size,
                      const Execution& execution) {
  const system::Call call(execution);
  struct OneLine {
    Stations stations;
    bool closed;
  };
  std::vector<OneLine> walked;
  std::size_t left = max_sites;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    require_line(lines[i], i);
    const std::vector<Point> line = line_of_units(lines[i], i);
    if (line.size() < 2) continue;
    const bool closed = is_closed(line);
    const LineWalk walk(line, size);
    Stations stations = closed ? closed_stations(walk, left) : walk.walk(1, left);
    if (stations.places.size() < 2) continue;
    left -= stations.places.size();
    walked.push_back({std::move(stations), closed});
  }
  std::ranges::stable_sort(walked, std::greater(),
                           [](const OneLine& one) { return one.stations.places.size(); });
  LineCandidates candidates;
  for (const OneLine& one : walked) add_rows(one.stations, one.closed, candidates);
  return sites_apart(candidates, execution);
}

std::vector<std::vector<Point>> read_lines(const FileName& file, const PolygonOptions& options,
                                           const Execution& execution) {
  std::vector<std::vector<Point>> lines =
      meshing::outlines_of(read_features(file, options, execution));
  std::erase_if(lines, [](const std::vector<Point>& line) { return line.size() < 2; });
  if (lines.empty()) throw FileError(file.path + ": it has no lines");
  return lines;
}

}  // namespace rondel::mesh
