// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Places sites on lines, and on both sides of them. A pair of dividers walks along the line. Opened
// by a spacing, it stands on sites of the line; opened by half a spacing, it stands beside sites
// that are in turn to the left and to the right:
//
//     L       L       L             the rows of a lattice of hexagons, the line in the middle; edges of cells
//   .   .   .   .   .   .   line    go to and fro between the rows, and their corners are a quarter of the side
//         R       R       R         of a hexagon, 0.144 of the spacing, away from the line
//
// This holds where the line is smooth: its curvature adds at most (spacing / 2)^2 / (8 radius).

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "exact/vector.h"
#include "meshing/fixed_sites.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_lines.h"
#include "rondel/query.h"
#include "system/job.h"

namespace rondel::mesh {
namespace {

using StationVector = exact::Vector3<double>;

// Distances in units of the spacing: between two sites on a line, between two stations of rows
// beside it, and from the line to a row, which is half the height of a triangle.
constexpr double whole_step = 1;
constexpr double half_step = 0.5;
constexpr double row_offset = 0.43301270189221935;  // sqrt(3) / 4
// The least distances, in units of the spacing, from a site to other sites and to stations.
constexpr double min_site_distance = 0.7;
constexpr double min_station_distance = 0.3;
constexpr std::size_t fewest_stations = 6;
constexpr int max_fits = 8;

// Places along a line at which the dividers stand, and the spacings there.
struct Stations {
  std::vector<Point> places;
  std::vector<double> spacings;
  double steps = 0;  // length of the whole line in steps, the last one counted in part
};

// Walks along a line with a pair of dividers.
class LineWalk {
 public:
  LineWalk(const std::vector<Point>& line, const SizeFunction& size) : line_(line), size_(size) {}

  // Walks from the first point on in steps of `spacings` times the local spacing.
  [[nodiscard]] Stations walk(double spacings, std::size_t most) const {
    Stations found;
    Point at = line_.front();
    std::size_t segment = 0;
    double along = 0;
    for (;;) {
      const double spacing = size_.spacing(at);
      found.places.push_back(at);
      found.spacings.push_back(spacing);
      const double step = spacings * spacing;
      if (!advance(at, segment, along, step)) {
        found.steps = static_cast<double>(found.places.size() - 1) +
                      std::min(1.0, distance(at, line_.back()) / step);
        return found;
      }
      if (found.places.size() >= most) {
        throw InvalidInput("there are too many sites along a line");
      }
    }
  }

 private:
  static double distance(const Point& a, const Point& b) { return norm(a - b); }

  // Returns the point of a segment at the share `along` of its chord, from 0 to 1.
  [[nodiscard]] Point place(std::size_t segment, double along) const {
    const StationVector a = exact::to_vector(line_[segment]);
    const StationVector b = exact::to_vector(line_[segment + 1]);
    return exact::to_point(normalized(a + along * (b - a)));
  }

  // Moves to the first place at the distance `step`; returns false if there is none up to the end
  // of the line.
  bool advance(Point& at, std::size_t& segment, double& along, double step) const {
    const Point from = at;
    while (distance(from, line_[segment + 1]) < step) {
      if (++segment + 1 == line_.size()) return false;
      along = 0;
    }
    // Once the distance from a place grows along an arc it keeps growing, so bisection finds where
    // it reaches `step`.
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

// Positions that are so close count as one, as for corners in files.
constexpr double same_place = 1e-10;

// True if a line of unit vectors returns to its first point.
bool is_closed(const std::vector<Point>& line) {
  return line.size() > 3 && norm(line.front() - line.back()) < same_place;
}

// True if a line of unit vectors does not leave its first point.
bool is_one_place(const std::vector<Point>& line) {
  return std::ranges::all_of(
      line, [&line](const Point& p) { return norm(p - line.front()) < same_place; });
}

// Returns stations with a step of about `step` spacings such that their number is a multiple of
// `multiple` and the last one is nearly at the end of the line. Returns none if they are fewer than
// `fewest`. The station at the end is left out.
Stations fitted_stations(const LineWalk& line, double step, std::size_t multiple,
                         std::size_t fewest, std::size_t most) {
  const auto unit = static_cast<double>(multiple);
  double stretch = 1;
  Stations best;
  double min_gap = 2;
  for (int fit = 0; fit < max_fits; ++fit) {
    Stations found = line.walk(stretch * step, most);
    const double wanted = unit * std::floor(found.steps / unit + 0.5);
    if (wanted < static_cast<double>(fewest)) return {};
    const double gap = std::abs(found.steps - wanted);
    stretch *= found.steps / wanted;
    if (gap >= min_gap) continue;
    min_gap = gap;
    found.places.resize(std::min(found.places.size(), static_cast<std::size_t>(wanted)));
    found.spacings.resize(found.places.size());
    best = std::move(found);
  }
  while (best.places.size() % multiple != 0) {
    best.places.pop_back();
    best.spacings.pop_back();
  }
  return best;
}

// Sites for one line, before those that are too close to others are left out.
struct LineCandidates {
  std::vector<Point> stations;  // places from which rows keep away; empty for sites on lines
  std::vector<Point> sites;
  std::vector<double> spacings;
  std::size_t num_certain = 0;  // the first candidates, which are taken wherever they are
};

// Adds two rows of sites, in turn to the left and to the right of the stations.
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

// Returns the candidates that are far enough from those taken before them, and from stations.
LineSites sites_apart(const LineCandidates& candidates, const Execution& execution) {
  LineSites result;
  const std::size_t n = candidates.sites.size();
  if (n == 0) return result;
  const Execution quietly{.threads = execution.threads};
  const Triangulation of_sites = delaunay(Sites::view(candidates.sites), {}, quietly);
  const Locator sites(of_sites);
  std::vector<char> is_left_out(n, 0);
  for (const Duplicate& duplicate : of_sites.duplicates()) is_left_out[duplicate.site] = 1;
  if (!candidates.stations.empty()) {
    const Triangulation of_stations = delaunay(Sites::view(candidates.stations), {}, quietly);
    const std::vector<Index> nearest = Locator(of_stations).nearest(candidates.sites, quietly);
    for (std::size_t i = 0; i < n; ++i) {
      const double away = norm(candidates.sites[i] - candidates.stations[nearest[i]]);
      if (away < min_station_distance * candidates.spacings[i]) is_left_out[i] = 1;
    }
  }
  std::fill_n(is_left_out.begin(), candidates.num_certain, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const Point& site = candidates.sites[i];
    if (i >= candidates.num_certain && is_left_out[i] == 0) {
      const std::vector<Index> near =
          sites.within(site, min_site_distance * candidates.spacings[i]);
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

// Throws InvalidInput for the first point that is not finite or is the center, and for opposite
// neighbors.
void require_line(const std::vector<Point>& line, std::size_t index) {
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Point& p = line[k];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || p == Point{}) {
      throw InvalidInput(
          "a point of line " + std::to_string(index) + " is not finite or the center", index);
    }
  }
}

// Returns the line as unit vectors, without points that repeat the one before.
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

// The stations of a line, and whether it is closed.
struct WalkedLine {
  Stations stations;
  bool closed;
};

struct WalkedLines {
  std::vector<WalkedLine> walked;    // the longest lines come first
  std::vector<Point> single_places;  // first points, as given, of lines that are in one place each
};

// Walks along each line of more places than one with the steps that `stations_of` finds.
template <class StationsOf>
WalkedLines walked_lines(std::span<const std::vector<Point>> lines, const SizeFunction& size,
                         const StationsOf& stations_of) {
  WalkedLines result;
  auto& [walked, single_places] = result;
  std::size_t left = max_sites;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    require_line(lines[i], i);
    const std::vector<Point> line = line_of_units(lines[i], i);
    if (is_one_place(line)) {
      // Unit vectors of points of one direction may differ by rounding.
      if (!line.empty()) single_places.push_back(lines[i].front());
      continue;
    }
    const bool closed = is_closed(line);
    walked.push_back({stations_of(LineWalk(line, size), line, closed, left), closed});
    left -= std::min(left, walked.back().stations.places.size());
  }
  std::ranges::stable_sort(walked, std::greater(),
                           [](const WalkedLine& one) { return one.stations.places.size(); });
  return result;
}

}  // namespace

LineSites sites_along(std::span<const std::vector<Point>> lines, const SizeFunction& size,
                      const Execution& execution) {
  const system::Call call(execution);
  // A closed line has an even number of stations, so that left and right alternate all around.
  const auto stations_of = [](const LineWalk& walk, const std::vector<Point>& /*line*/, bool closed,
                              std::size_t most) {
    return closed ? fitted_stations(walk, half_step, 2, fewest_stations, most)
                  : walk.walk(half_step, most);
  };
  LineCandidates candidates;
  const WalkedLines found = walked_lines(lines, size, stations_of);
  for (const WalkedLine& one : found.walked) {
    if (one.stations.places.size() > 1) add_rows(one.stations, one.closed, candidates);
  }
  return sites_apart(candidates, execution);
}

LineSites sites_on(std::span<const std::vector<Point>> lines, const SizeFunction& size,
                   const Execution& execution) {
  const system::Call call(execution);
  const auto stations_of = [&size](const LineWalk& walk, const std::vector<Point>& line,
                                   bool closed, std::size_t most) {
    Stations stations = fitted_stations(walk, whole_step, 1, 1, most);
    const auto add = [&](const Point& place) {
      stations.places.push_back(place);
      stations.spacings.push_back(size.spacing(place));
    };
    if (stations.places.empty()) add(line.front());
    if (closed) return stations;
    // Where no stretch fits, the last stations give way to the end.
    const double near = min_site_distance * size.spacing(line.back());
    while (stations.places.size() > 1 && norm(stations.places.back() - line.back()) < near) {
      stations.places.pop_back();
      stations.spacings.pop_back();
    }
    add(line.back());
    return stations;
  };
  LineCandidates candidates;
  const auto [walked, single_places] = walked_lines(lines, size, stations_of);
  candidates.sites = kept_units(single_places);
  for (const Point& site : candidates.sites) candidates.spacings.push_back(size.spacing(site));
  candidates.num_certain = candidates.sites.size();
  for (const auto& [stations, closed] : walked) {
    candidates.sites.insert(candidates.sites.end(), stations.places.begin(), stations.places.end());
    candidates.spacings.insert(candidates.spacings.end(), stations.spacings.begin(),
                               stations.spacings.end());
  }
  return sites_apart(candidates, execution);
}

}  // namespace rondel::mesh
