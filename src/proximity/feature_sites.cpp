// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Places sites along lines so that the nearest site's feature is the nearest feature up to a
// tolerance t. Each segment between neighboring sites of a line is halved until it is short enough
// for t:
//
//            x         Let p be a segment's point nearest to x, at distance d, in a segment of feature F
//           /|         with half-length h. Let the site nearest to x belong to another feature G. This
//         /  | d       site is nearer than the segment's ends, so at most sqrt(d^2 + h^2) away (on the
//       /    |         sphere it is less than in the plane). So G is at most e = sqrt(d^2 + h^2) - d
//     o------p--o      farther than F, and e <= h. Let D be the distance of G from p. Then D <= 2 d + e,
//        h             and as e (2 d + e) = h^2, e <= h^2 / D.
//
// So e <= t if h <= t or h^2 <= t D, that is if h <= H(D) = max(t, sqrt(t D)).
//
// D is not known; known is d1, the distance of the segment's middle m from the nearest *site* of
// another feature. Let D now be the distance of that feature from m, attained in a segment of
// half-length h'. That segment passes the same test, so h' <= H(D + h), as D + h bounds what its
// test knows of its distance. So d1 <= D + h' <= D + H(D + h), which bounds D from below, and D - h
// is a bound for all points p of the segment. With u = D + h and K = d1 + h this is u + H(u) >= K,
// and the test is h^2 <= t (u - 2 h).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
#include "proximity/feature_distance.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

// The sites along all lines, in the order of the lines. is_joined[i] is 1 if a segment goes from
// site i to site i + 1, and 0 if site i is the last one of its line.
struct LinePoints {
  std::vector<Point> points;
  std::vector<Index> features;
  std::vector<std::uint8_t> is_joined;

  void add(const Point& point, Index feature, bool joined) {
    points.push_back(point);
    features.push_back(feature);
    is_joined.push_back(joined ? 1 : 0);
  }
};

// A segment that may be too long.
struct PieceMiddle {
  std::size_t first;  // index of the segment's first site
  double half;        // half of the segment's length, radians
};

// Returns the angle between two unit vectors in radians.
double angle_of(const Point& a, const Point& b) {
  const Point difference = a - b;
  const Point sum = a + b;
  return 2 * exact::argument(std::sqrt(dot(difference, difference)), std::sqrt(dot(sum, sum)));
}

// True if a segment needs no further site, by the test above with `half` = h and `to_other_site` =
// d1, all in radians. The positive root of u + sqrt(tolerance u) = h + d1 is the least u; where it
// is below the tolerance, H is the tolerance itself.
bool is_short_enough(double half, double to_other_site, double tolerance) {
  if (half <= tolerance) return true;
  const double sum = to_other_site + half;
  const double root = (std::sqrt(tolerance + 4 * sum) - std::sqrt(tolerance)) / 2;
  double bound = root * root;
  if (bound < tolerance) bound = sum - tolerance;
  return half * half <= tolerance * (bound - 2 * half);
}

// Throws InvalidInput unless the offsets are compressed rows and all points are unit vectors to
// 1e-9.
void require_lines(const FeatureLines& lines) {
  const std::vector<Point>& points = lines.rows.values;
  if (!system::are_offsets(lines.rows.offsets, points.size()) ||
      !system::are_offsets(lines.offsets, lines.rows.size())) {
    throw InvalidInput("the offsets of the lines do not fit");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    constexpr double rounding = 1e-9;
    const double square = dot(points[i], points[i]);
    if (!(std::abs(square - 1) <= rounding)) {
      throw InvalidInput("point " + std::to_string(i) + " is no unit vector", i);
    }
  }
}

// Where another feature touches an arc, its sites are up to two tolerances apart. A tolerance that
// might put more sites than this on an arc is refused, as the work would take minutes.
constexpr double max_sites_of_arc = 1U << 19U;

// Throws InvalidInput for an arc that is too long for the tolerance.
void require_length(double length, double tolerance, std::size_t feature) {
  if (length <= 2 * tolerance * max_sites_of_arc) return;
  throw InvalidInput("with the tolerance of " + system::shortest_text(tolerance) +
                         " radians an arc of feature " + std::to_string(feature) +
                         " could have more than " + system::shortest_text(max_sites_of_arc) +
                         " sites",
                     feature);
}

// Returns the corners of all lines without repeated neighbors. Throws InvalidInput if neighbors are
// antipodes, between which no shorter arc exists, or too far apart for the tolerance.
LinePoints points_of_lines(const FeatureLines& lines, double tolerance) {
  LinePoints all;
  const auto& [ends, points] = lines.rows;
  for (std::size_t f = 0; f < lines.size(); ++f) {
    for (std::uint64_t l = lines.offsets[f]; l < lines.offsets[f + 1]; ++l) {
      for (std::uint64_t k = ends[l]; k < ends[l + 1]; ++k) {
        const bool is_last = k + 1 == ends[l + 1];
        if (!is_last && points[k] == points[k + 1]) continue;
        if (!is_last && points[k] + points[k + 1] == Point{}) {
          throw InvalidInput("points " + std::to_string(k) + " and " + std::to_string(k + 1) +
                                 " of a line are antipodes",
                             k);
        }
        if (!is_last) require_length(angle_of(points[k], points[k + 1]), tolerance, f);
        all.add(points[k], static_cast<Index>(f), !is_last);
      }
    }
  }
  return all;
}

// Returns the sites with the middle of every segment that is too long inserted, or no sites at all
// if no segment is too long.
LinePoints halved(const LinePoints& all, double tolerance, const Execution& execution) {
  std::vector<PieceMiddle> pieces;
  std::vector<Point> middles;
  std::vector<Index> features;
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    if (all.is_joined[i] == 0) continue;
    const Point middle = normalized(all.points[i] + all.points[i + 1]);
    const double half = angle_of(middle, all.points[i]);
    if (half <= tolerance || middle == all.points[i] || middle == all.points[i + 1]) continue;
    pieces.push_back({i, half});
    middles.push_back(middle);
    features.push_back(all.features[i]);
  }
  const std::vector<double> distances =
      proximity::distances_to_others({all.points, all.features}, middles, features, execution);
  LinePoints result;
  std::size_t at = 0;
  bool is_changed = false;
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    result.add(all.points[i], all.features[i], all.is_joined[i] != 0);
    if (at == pieces.size() || pieces[at].first != i) continue;
    if (!is_short_enough(pieces[at].half, distances[at], tolerance)) {
      result.add(middles[at], features[at], true);
      is_changed = true;
    }
    ++at;
  }
  return is_changed ? result : LinePoints();
}

}  // namespace

FeatureSites feature_sites(const FeatureLines& lines, double tolerance,
                           const Execution& execution) {
  const system::Call call(execution);
  require_lines(lines);
  if (!(tolerance > 0)) throw InvalidInput("the tolerance is not positive");
  LinePoints all = points_of_lines(lines, tolerance);
  while (true) {
    if (all.points.size() >= std::numeric_limits<Index>::max() / 2) {
      throw InvalidInput("with this tolerance there are too many sites", all.points.size());
    }
    LinePoints next = halved(all, tolerance, execution);
    if (next.points.empty()) break;
    all = std::move(next);
  }
  return {std::move(all.points), std::move(all.features)};
}

}  // namespace rondel
