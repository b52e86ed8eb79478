// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/weld.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "exact/point_order.h"
#include "exact/vector.h"

namespace rondel::meshing {
namespace {

using arrangement::BoxTree;
using arrangement::SpaceBox;

SpaceBox box_around(const Point& p, double near) {
  return {{p.x - near, p.y - near, p.z - near}, {p.x + near, p.y + near, p.z + near}};
}

double squared(double x) { return x * x; }

class Weld {
 public:
  Weld(FeatureConstraints& features, const std::function<double(const Point&)>& near_at)
      : features_(features), places_(features.sites.size()) {
    for (const Point& site : features.sites) near_.push_back(near_at(site));
    for (Index i = 0; i < places_.size(); ++i) places_[i] = i;
  }

  void run() {
    unite_sites();
    for (auto& ends : features_.constraints) {
      for (Index& end : ends) end = places_[end];
    }
    find_sites_on_sides();
    if (num_united_ == 0 && on_sides_.empty()) return;
    divide_sides();
    drop_united();
  }

 private:
  // A site on a side, and its squared distance from the beginning of the side.
  struct SiteOnSide {
    Index side;
    double from_begin;
    Index site;
    friend auto operator<=>(const SiteOnSide&, const SiteOnSide&) = default;
  };

  // Gives sites that are too near to one with smaller coordinates the place of that one: the order of
  // sites changes nothing.
  void unite_sites() {
    const std::vector<Point>& sites = features_.sites;
    const auto is_before = [&](Index i, Index j) { return exact::is_less(sites[i], sites[j]); };
    std::vector<Index> order = places_;
    std::ranges::sort(order, is_before);
    const BoxTree tree(
        sites.size(), [&](std::size_t i) { return box_around(sites[i], 0); }, 1);
    for (const Index i : order) {
      if (places_[i] != i) continue;
      tree.visit(box_around(sites[i], near_[i]), [&](Index j) {
        const Point step = sites[j] - sites[i];
        if (!is_before(i, j) || places_[j] != j || dot(step, step) > squared(near_[i])) return;
        places_[j] = i;
        ++num_united_;
      });
    }
  }

  void find_sites_on_sides() {
    const auto box = [&](std::size_t s) {
      const auto& [a, b] = features_.constraints[s];
      return arrangement::box_of(features_.sites[a], features_.sites[b]);
    };
    const BoxTree tree(features_.constraints.size(), box, 1);
    for (Index i = 0; i < places_.size(); ++i) {
      if (places_[i] != i) continue;
      tree.visit(box_around(features_.sites[i], near_[i]), [&](Index side) { look_at(side, i); });
    }
    std::ranges::sort(on_sides_);
  }
  void look_at(Index side, Index site) {
    const auto& [begin, end] = features_.constraints[side];
    if (site == begin || site == end) return;
    const Point& a = features_.sites[begin];
    const Point& b = features_.sites[end];
    const Point& p = features_.sites[site];
    const Point across = cross(a, b);
    if (!(dot(across, across) > 0)) return;
    const Point normal = normalized(across);
    const double height = dot(normal, p);
    if (!(height * height <= squared(near_[site]))) return;
    const Point foot = p - height * normal;
    const bool is_between = dot(normal, cross(a, foot)) > 0 && dot(normal, cross(foot, b)) > 0;
    if (is_between) on_sides_.push_back({side, dot(foot - a, foot - a), site});
  }

  // Makes chains of sides through the sites on them, and the polygons' rows again.
  void divide_sides() {
    std::vector<std::array<Index, 2>> constraints;
    std::vector<Index> features;
    std::vector<std::size_t> begins;
    auto next = on_sides_.begin();
    for (Index s = 0; s < features_.constraints.size(); ++s) {
      begins.push_back(constraints.size());
      Index at = features_.constraints[s][0];
      const auto go_to = [&](Index site) {
        if (site == at) return;
        constraints.push_back({at, site});
        features.push_back(features_.features[s]);
        at = site;
      };
      for (; next != on_sides_.end() && next->side == s; ++next) go_to(next->site);
      go_to(features_.constraints[s][1]);
    }
    begins.push_back(constraints.size());
    CompressedRows<Index> polygons;
    for (std::size_t row = 0; row < features_.polygons.size(); ++row) {
      for (const Index s : features_.polygons[row]) {
        for (std::size_t k = begins[s]; k < begins[s + 1]; ++k) {
          polygons.values.push_back(static_cast<Index>(k));
        }
      }
      polygons.end_row();
    }
    features_.constraints = std::move(constraints);
    features_.features = std::move(features);
    features_.polygons = std::move(polygons);
  }

  void drop_united() {
    std::vector<Index> numbers(places_.size(), no_index);
    std::vector<Point> sites;
    for (Index i = 0; i < places_.size(); ++i) {
      if (places_[i] != i) continue;
      numbers[i] = static_cast<Index>(sites.size());
      sites.push_back(features_.sites[i]);
    }
    features_.sites = std::move(sites);
    for (auto& ends : features_.constraints) {
      for (Index& end : ends) end = numbers[end];
    }
  }

  FeatureConstraints& features_;
  std::vector<Index> places_;  // of each site: the site whose place it has
  std::vector<double> near_;   // by site
  std::vector<SiteOnSide> on_sides_;
  std::size_t num_united_ = 0;
};

}  // namespace

void weld(FeatureConstraints& features, const std::function<double(const Point&)>& near_at) {
  Weld(features, near_at).run();
}

}  // namespace rondel::meshing
