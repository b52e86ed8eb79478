// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/place_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "map/arc.h"
#include "map/ring_area.h"
#include "rondel/constrained_interpolate.h"
#include "rondel/constrained_locator.h"
#include "rondel/delaunay.h"
#include "rondel/interpolate.h"
#include "rondel/query.h"

namespace rondel::formats {
namespace {

using NodePair = std::array<Index, 2>;

// A target is at a place if it is this near to it: unit vectors that are computed from the same
// degrees in other ways are off by a few 2^-53.
constexpr double same_place = 0x1p-50;

// Returns the corners from the lowest one on, duplicates by the site that stands for them.
Triple canonical(const Triple& corners, std::span<const Index> stands_for) {
  Triple result = {stands_for[corners[0]], stands_for[corners[1]], stands_for[corners[2]]};
  std::rotate(result.begin(), std::ranges::min_element(result), result.end());
  return result;
}

// Returns for each site the one that stands for it.
std::vector<Index> representatives(const Triangulation& triangulation) {
  std::vector<Index> result(triangulation.num_sites());
  for (Index i = 0; i < result.size(); ++i) result[i] = i;
  for (const Duplicate& d : triangulation.duplicates()) result[d.site] = d.representative;
  return result;
}

// Returns the sides of triangles, the lower end first, sorted; sides of two triangles twice.
std::vector<NodePair> sides_of(std::span<const Triple> triangles) {
  std::vector<NodePair> sides;
  for (const auto& [a, b, c] : triangles) {
    for (const auto& [p, q] : {NodePair{a, b}, NodePair{b, c}, NodePair{c, a}}) {
      sides.push_back({std::min(p, q), std::max(p, q)});
    }
  }
  std::ranges::sort(sides);
  return sides;
}

// Returns the share of the sphere that triangles cover, of which `visit` tells each.
template <class ForEach>
double share_of(std::span<const Point> places, const ForEach& for_each) {
  double area = 0;
  for_each([&](const Triple& t) {
    area += map::area_on_left(std::array<Point, 3>{places[t[0]], places[t[1]], places[t[2]]});
  });
  return area / (4 * std::numbers::pi);
}

}  // namespace

// The triangles of a file: all of their sides are constraints of a triangulation of the nodes, whose
// other faces are outside.
class PlaceValues::InMesh {
 public:
  // Throws InvalidInput if the triangles cannot be faces together.
  InMesh(std::span<const Point> places, std::span<const Triple> triangles,
         const Triangulation& delaunay, const Execution& execution)
      : places_(places), sides_(sides_of(renamed(triangles, delaunay))) {
    list_border();
    sides_.erase(std::unique(sides_.begin(), sides_.end()), sides_.end());
    const ConstrainedTriangulation all =
        constrained_delaunay(delaunay.sites(), sides_, {}, execution);
    are_inside_.resize(all.triangulation.num_faces());
    std::size_t num_found = 0;
    for (Index f = 0; f < are_inside_.size(); ++f) {
      if (all.triangulation.is_ghost(f)) continue;
      are_inside_[f] = std::ranges::binary_search(
          triangles_, canonical(all.triangulation.faces()[f], representatives_));
      num_found += are_inside_[f] ? 1U : 0U;
    }
    if (num_found != triangles.size()) throw InvalidInput("triangles overlap");
    border_boxes_.emplace(
        border_.size(),
        [&](std::size_t i) {
          return arrangement::box_of(places_[border_[i][0]], places_[border_[i][1]]);
        },
        execution.threads);
    locator_.emplace(all);
    interpolator_.emplace(all);
    nearest_.emplace(delaunay);
  }

  // Calls visit(t, value, is_outside) for each target.
  template <class Visit>
  void visit_values(std::span<const double> values, std::span<const Point> targets,
                    const Execution& execution, const Visit& visit) const {
    const std::vector<Index> nearest = nearest_->nearest(targets, execution);
    const std::vector<Location> locations = locator_->locate(targets, execution);
    const std::vector<double> linear = interpolator_->values(values, targets, {}, execution);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const Index node = nearest[t];
      if (map::distance(targets[t], places_[node]) <= same_place) {
        visit(t, values[node], false);
      } else if (is_inside(locations[t])) {
        visit(t, linear[t], false);
      } else {
        const std::optional<double> on_border = value_on_border(values, targets[t]);
        visit(t, on_border.value_or(values[node]), !on_border);
      }
    }
  }

  [[nodiscard]] double share_of_sphere() const {
    return share_of(places_, [&](const auto& add) { std::ranges::for_each(triangles_, add); });
  }

 private:
  // Keeps the triangles, canonical and sorted, and returns them.
  std::span<const Triple> renamed(std::span<const Triple> triangles,
                                  const Triangulation& delaunay) {
    representatives_ = representatives(delaunay);
    for (const Triple& t : triangles) triangles_.push_back(canonical(t, representatives_));
    std::ranges::sort(triangles_);
    return triangles_;
  }

  // Lists the sides of one triangle only.
  void list_border() {
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const bool is_single = (i == 0 || sides_[i - 1] != sides_[i]) &&
                             (i + 1 == sides_.size() || sides_[i + 1] != sides_[i]);
      if (is_single) border_.push_back(sides_[i]);
    }
  }

  [[nodiscard]] bool is_inside(const Location& location) const {
    if (location.where == Where::vertex) return true;
    if (location.where == Where::face) return are_inside_[location.face];
    return location.where == Where::edge &&
           std::ranges::binary_search(sides_, NodePair{location.sites[0], location.sites[1]});
  }

  // Returns the value of a target that is on a side of the border up to rounding, of the nearest one
  // of several.
  [[nodiscard]] std::optional<double> value_on_border(std::span<const double> values,
                                                      const Point& target) const {
    arrangement::SpaceBox around = arrangement::box_of(target, target);
    around.widen(map::merge_distance);
    std::optional<double> value;
    double least = map::merge_distance;
    border_boxes_->visit(around, [&](Index side) {
      const auto& [a, b] = border_[side];
      const auto foot = map::foot_on_arc(target, places_[a], places_[b]);
      if (!foot || map::distance(target, *foot) > least) return;
      least = map::distance(target, *foot);
      const double from_a = map::distance(target, places_[a]);
      const double from_b = map::distance(target, places_[b]);
      const double share = from_b / (from_a + from_b);
      value = share * values[a] + (1 - share) * values[b];
    });
    return value;
  }

  std::span<const Point> places_;
  std::vector<Index> representatives_;
  std::vector<Triple> triangles_;  // canonical, sorted
  std::vector<NodePair> sides_;    // the lower node first, sorted
  std::vector<NodePair> border_;   // the sides of one triangle, sorted
  std::optional<arrangement::BoxTree> border_boxes_;
  std::vector<bool> are_inside_;  // by face
  std::optional<ConstrainedLocator> locator_;
  std::optional<ConstrainedInterpolator> interpolator_;
  std::optional<Locator> nearest_;
};

PlaceValues::PlaceValues(std::span<const Point> places, std::span<const double> values,
                         std::span<const Triple> triangles, const Execution& execution,
                         std::vector<std::string>* remarks)
    : places_(places),
      values_(values),
      execution_(execution),
      delaunay_(delaunay(Sites::view(places), {}, execution)) {
  const auto num_other =
      std::ranges::count_if(delaunay_.duplicates(), [&](const Duplicate& duplicate) {
        return values[duplicate.site] != values[duplicate.representative];
      });
  if (num_other > 0 && remarks != nullptr) {
    remarks->push_back(std::to_string(num_other) + " of " + std::to_string(values.size()) +
                       " places " + (num_other == 1 ? "is" : "are") +
                       " at the place of another one with another value: of each place the first "
                       "value counts");
  }
  if (!triangles.empty()) {
    try {
      mesh_ = std::make_unique<const InMesh>(places, triangles, delaunay_, execution);
      return;
    } catch (const InvalidInput&) {
      if (remarks != nullptr) {
        remarks->emplace_back(
            "triangles of the mesh overlap, or have nodes on their sides: values are linear on the "
            "Delaunay triangulation of its nodes");
      }
    }
  }
  interpolator_ = std::make_unique<const Interpolator>(delaunay_);
}

PlaceValues::~PlaceValues() = default;

std::vector<double> PlaceValues::between_places(std::span<const Point> targets,
                                                Outside outside) const {
  return interpolator_->values(values_, targets, {.method = Method::linear, .outside = outside},
                               execution_);
}

std::vector<double> PlaceValues::at(std::span<const Point> targets,
                                    std::size_t* num_outside) const {
  if (mesh_ == nullptr && num_outside == nullptr) return between_places(targets, Outside::nearest);
  std::vector<double> result;
  std::vector<std::size_t> outside;
  if (mesh_ != nullptr) {
    result.resize(targets.size());
    mesh_->visit_values(values_, targets, execution_,
                        [&](std::size_t t, double value, bool is_outside) {
                          result[t] = value;
                          if (is_outside) outside.push_back(t);
                        });
  } else {
    result = between_places(targets, Outside::missing);
    std::vector<Point> others;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      if (!std::isnan(result[t])) continue;
      outside.push_back(t);
      others.push_back(targets[t]);
    }
    const std::vector<double> values = between_places(others, Outside::nearest);
    for (std::size_t k = 0; k < outside.size(); ++k) result[outside[k]] = values[k];
  }
  if (num_outside != nullptr) *num_outside = outside.size();
  return result;
}

double PlaceValues::share_of_sphere() const {
  if (mesh_ != nullptr) return mesh_->share_of_sphere();
  if (delaunay_.dimension() < 2) return 0;
  if (delaunay_.num_ghost_faces() == 0) return 1;
  return share_of(places_, [&](const auto& add) {
    for (Index f = 0; f < delaunay_.num_faces(); ++f) {
      if (!delaunay_.is_ghost(f)) add(delaunay_.faces()[f]);
    }
  });
}

}  // namespace rondel::formats
