// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Implements require_own_centers() by the rules in own_centers.h. A first pass over the cells finds
// the centers outside of their circles, a second one over these compares them with the median
// radius.
#include "formats/own_centers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "exact/vector.h"
#include "io/bad_value.h"
#include "rondel/delaunay.h"
#include "system/message_text.h"

namespace rondel::formats {
namespace {

// Distances are chords of the unit sphere; that of 60 degrees is 1.
constexpr double max_radius = 1;
// A center on the circle may be outside by rounding, in single precision 1e-7 of the sphere.
constexpr double slack_of_circle = 1.05;
constexpr double rounding_of_center = 1e-6;
constexpr double max_radii = 3;
// How far the distances from a circumcenter to the corners may differ, in radii.
constexpr double slack_of_circumcenter = 0.01;

// The circle around the mean direction of a cell's corners, through the farthest one.
struct CornerCircle {
  Point middle;
  double radius = 0;  // 0 for a cell that is not looked at
};

// Returns a place in words, for messages.
std::string place_text(const LonLat& place) {
  return "longitude " + system::shortest_text(place.lon_deg) + " and latitude " +
         system::shortest_text(place.lat_deg);
}

// The check of one mesh. `cells` have unit vectors, `mesh` has the centers and the names.
class CenterCheck {
 public:
  // Precondition: all centers are places.
  CenterCheck(const MeshContent& mesh, const CellRings& cells)
      : mesh_(mesh), cells_(cells), centers_(unit_vectors(mesh.centers)) {}

  // Returns the remark, or an empty text. Throws BadValue by rules 2 and 3.
  std::string run() {
    std::vector<double> radii;
    std::vector<std::size_t> outside;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      const CornerCircle circle = circle_of(i);
      if (circle.radius == 0) continue;
      radii.push_back(circle.radius);
      const double away = norm(centers_[i] - circle.middle);
      const double allowed = slack_of_circle * circle.radius + rounding_of_center;
      if (away > allowed && !is_circumcenter(i, circle.radius)) outside.push_back(i);
    }
    if (outside.empty()) return {};
    if (2 * outside.size() > radii.size()) refuse(outside.front(), outside.size(), radii.size());
    const auto median = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::ranges::nth_element(radii, median);
    for (const std::size_t i : outside) {
      const CornerCircle circle = circle_of(i);
      const double away = norm(centers_[i] - circle.middle);
      if (away > max_radii * std::max(circle.radius, *median)) {
        refuse(i, outside.size(), radii.size());
      }
    }
    return counted(outside.size(), radii.size()) + " are outside of their corners, the first one " +
           what(outside.front());
  }

 private:
  // Calls visit(point) for each corner of a cell.
  template <class Visit>
  void for_corners(std::size_t cell, const Visit& visit) const {
    const std::uint64_t end = cells_.rings[cells_.cells[cell + 1]];
    for (std::uint64_t k = cells_.rings[cells_.cells[cell]]; k < end; ++k) {
      visit(cells_.points[cells_.corners[k]]);
    }
  }

  // Returns the circle of a cell; its radius is 0 for cells that pass by rule 1.
  [[nodiscard]] CornerCircle circle_of(std::size_t cell) const {
    if (!mesh_.mask.empty() && mesh_.mask[cell] == 0) return {};
    Point sum{0, 0, 0};
    for_corners(cell, [&](const Point& corner) { sum = sum + corner; });
    if (!(dot(sum, sum) > 0)) return {};
    CornerCircle circle{normalized(sum)};
    for_corners(cell, [&](const Point& corner) {
      circle.radius = std::max(circle.radius, norm(corner - circle.middle));
    });
    return circle.radius < max_radius ? circle : CornerCircle{};
  }

  // True if the center is as far from all corners, within a hundredth of `radius`.
  [[nodiscard]] bool is_circumcenter(std::size_t cell, double radius) const {
    double least = 2;
    double most = 0;
    for_corners(cell, [&](const Point& corner) {
      const double distance = norm(corner - centers_[cell]);
      least = std::min(least, distance);
      most = std::max(most, distance);
    });
    return most - least <= slack_of_circumcenter * radius;
  }

  // Returns, for example, "3 of 60 centers of cells in 'lon' and 'lat'".
  [[nodiscard]] std::string counted(std::size_t count, std::size_t of_all) const {
    return std::to_string(count) + " of " + std::to_string(of_all) + " centers of cells in " +
           mesh_.center_names;
  }

  // Describes a cell by its center and its first corner.
  [[nodiscard]] std::string what(std::size_t cell) const {
    const LonLat& corner = mesh_.nodes[mesh_.cells.corners_of(mesh_.cells.cells[cell]).front()];
    return "that of cell " + std::to_string(cell) + ", " + place_text(mesh_.centers[cell]) +
           ", with a corner at " + place_text(corner);
  }

  // Throws BadValue that names a cell with a foreign center.
  [[noreturn]] void refuse(std::size_t cell, std::size_t count, std::size_t of_all) const {
    throw io::BadValue("centers belong to other cells than the corners in " + mesh_.names + ": " +
                       counted(count, of_all) + " are outside of their corners, such as " +
                       what(cell));
  }

  const MeshContent& mesh_;
  const CellRings& cells_;
  std::vector<Point> centers_;
};

}  // namespace

std::string require_own_centers(const MeshContent& mesh, const CellRings& cells) {
  return CenterCheck(mesh, cells).run();
}

}  // namespace rondel::formats
