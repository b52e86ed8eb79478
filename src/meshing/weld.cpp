// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/weld.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "exact/point_order.h"
#include "exact/vector.h"
#include "system/distinct.h"

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
  Weld(Geometries& features, const std::function<double(const Point&)>& near_at)
      : features_(features) {
    std::vector<Point> points = features.lines.rows.values;
    for (const Index corner : features.polygons.corners) {
      points.push_back(features.polygons.points[corner]);
    }
    auto [sites, numbers] = system::distinct(std::span<const Point>(points));
    sites_ = std::move(sites);
    numbers_ = std::move(numbers);
    for (const Point& site : sites_) near_.push_back(near_at(site));
    for (Index i = 0; i < sites_.size(); ++i) places_.push_back(i);
  }

  void run() {
    unite_sites();
    for (Index& number : numbers_) number = places_[number];
    const auto& lines = features_.lines.rows;
    for (std::size_t r = 0; r < lines.size(); ++r) {
      add_sides(lines.offsets[r], lines.offsets[r + 1], false);
    }
    const auto& rings = features_.polygons.rings;
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      add_sides(lines.values.size() + rings[r], lines.values.size() + rings[r + 1], true);
    }
    find_sites_on_sides();
    if (num_united_ > 0 || !on_sides_.empty()) features_ = welded();
  }

 private:
  // A site on a side, and its order along it: the squared distance of its foot from the end of the
  // side that has the smaller coordinates, with the opposite sign where the side begins at the other
  // one. So a side has the same chain in both directions.
  struct SiteOnSide {
    Index side;
    double along;
    Index site;
  };

  // Gives sites that are too near to one with smaller coordinates the place of that one: the order of
  // sites changes nothing.
  void unite_sites() {
    const std::vector<Point>& sites = sites_;
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

  // Adds the sides of a line or ring, whose sites are those of some numbers.
  void add_sides(std::uint64_t begin, std::uint64_t end, bool is_ring) {
    for (std::uint64_t k = begin; k < end; ++k) {
      const bool is_last = k + 1 == end;
      if (!is_last || is_ring) sides_.push_back({numbers_[k], numbers_[is_last ? begin : k + 1]});
    }
  }

  void find_sites_on_sides() {
    const auto box = [&](std::size_t s) {
      return arrangement::box_of(sites_[sides_[s][0]], sites_[sides_[s][1]]);
    };
    const BoxTree tree(sides_.size(), box, 1);
    for (Index i = 0; i < places_.size(); ++i) {
      if (places_[i] != i) continue;
      tree.visit(box_around(sites_[i], near_[i]), [&](Index side) { look_at(side, i); });
    }
    // Sites with one foot have an order that no numbers change.
    std::ranges::sort(on_sides_, [&](const SiteOnSide& a, const SiteOnSide& b) {
      if (a.side != b.side) return a.side < b.side;
      if (a.along != b.along) return a.along < b.along;
      const auto& [low, high] = is_up(a.side) ? std::pair(a, b) : std::pair(b, a);
      return exact::is_less(sites_[low.site], sites_[high.site]);
    });
  }
  // True if a side goes from smaller coordinates to larger ones.
  [[nodiscard]] bool is_up(Index side) const {
    return exact::is_less(sites_[sides_[side][0]], sites_[sides_[side][1]]);
  }
  void look_at(Index side, Index site) {
    const auto& [begin, end] = sides_[side];
    if (site == begin || site == end) return;
    const bool goes_up = is_up(side);
    const Point& a = sites_[goes_up ? begin : end];
    const Point& b = sites_[goes_up ? end : begin];
    const Point& p = sites_[site];
    const Point across = cross(a, b);
    if (!(dot(across, across) > 0)) return;
    const Point normal = normalized(across);
    const double height = dot(normal, p);
    if (!(height * height <= squared(near_[site]))) return;
    const Point foot = p - height * normal;
    const bool is_between = dot(normal, cross(a, foot)) > 0 && dot(normal, cross(foot, b)) > 0;
    if (!is_between) return;
    const double along = dot(foot - a, foot - a);
    on_sides_.push_back({side, goes_up ? along : -along, site});
  }

  // Returns the sites of the next line or ring, each once in a row.
  std::vector<Index> next_chain(std::uint64_t begin, std::uint64_t end, bool is_ring) {
    std::vector<Index> chain;
    const auto go_to = [&](Index site) {
      if (chain.empty() || chain.back() != site) chain.push_back(site);
    };
    for (std::uint64_t k = begin; k < end; ++k) {
      go_to(numbers_[k]);
      if (k + 1 == end && !is_ring) break;
      for (; next_ < on_sides_.size() && on_sides_[next_].side == side_; ++next_) {
        go_to(on_sides_[next_].site);
      }
      ++side_;
    }
    while (is_ring && chain.size() > 1 && chain.back() == chain.front()) chain.pop_back();
    return chain;
  }

  Geometries welded() {
    Geometries made;
    const auto& lines = features_.lines;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (std::uint64_t r = lines.offsets[i]; r < lines.offsets[i + 1]; ++r) {
        std::vector<Point> line;
        for (const Index site :
             next_chain(lines.rows.offsets[r], lines.rows.offsets[r + 1], false)) {
          line.push_back(sites_[site]);
        }
        made.lines.rows.append(line);
      }
      made.lines.end_group();
    }
    const CellRings& polygons = features_.polygons;
    std::vector<Index> corner_of(sites_.size(), no_index);
    for (std::size_t i = 0; i < polygons.num_cells(); ++i) {
      for (std::uint64_t r = polygons.cells[i]; r < polygons.cells[i + 1]; ++r) {
        const std::uint64_t first = lines.rows.values.size();
        std::vector<Index> ring =
            next_chain(first + polygons.rings[r], first + polygons.rings[r + 1], true);
        if (ring.size() < 3) continue;
        for (Index& site : ring) {
          Index& corner = corner_of[site];
          if (corner == no_index) {
            corner = static_cast<Index>(made.polygons.points.size());
            made.polygons.points.push_back(sites_[site]);
          }
          site = corner;
        }
        made.polygons.append_ring(ring);
      }
      made.polygons.end_cell();
    }
    return made;
  }

  Geometries& features_;
  std::vector<Point> sites_;
  std::vector<Index> numbers_;               // the site of each point of lines, and of each corner
  std::vector<std::array<Index, 2>> sides_;  // of lines and rings, one after the other
  std::vector<Index> places_;                // of each site: the site whose place it has
  std::vector<double> near_;                 // by site
  std::vector<SiteOnSide> on_sides_;
  std::size_t num_united_ = 0;
  Index side_ = 0;        // the next one of welded()
  std::size_t next_ = 0;  // of on_sides_
};

}  // namespace

void weld(Geometries& features, const std::function<double(const Point&)>& near_at) {
  Weld(features, near_at).run();
}

}  // namespace rondel::meshing
