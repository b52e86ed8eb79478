// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "arrangement/even_odd.h"
#include "exact/point_order.h"
#include "exact/vector.h"
#include "map/ring_area.h"
#include "meshing/rings_within.h"
#include "overlay/single_cells.h"
#include "system/distinct.h"

namespace rondel::meshing {
namespace {

using arrangement::BoxTree;
using arrangement::SpaceBox;

SpaceBox box_around(const Point& p, double near) {
  return {{p.x - near, p.y - near, p.z - near}, {p.x + near, p.y + near, p.z + near}};
}

double squared(double x) { return x * x; }

// Places of one outline between which the way along it is no longer than so many times their distance
// are no gap but its own shape, which the simplification treats: a weld could turn a small ring inside
// out. What is left are needles, of less than 7 degrees.
constexpr double along_outline = 8;

// Lengths along outlines are whole numbers of this unit, whose sums no order changes.
constexpr double units = 0x1p50;

std::int64_t length_of(const Point& a, const Point& b) {
  return std::llround(units * norm(exact::to_vector(a) - exact::to_vector(b)));
}

// A side of a line or a ring, between two sites, of which the first one is the lower one.
struct SideOfRow {
  Index low;
  Index high;
  Index row;
  friend auto operator<=>(const SideOfRow&, const SideOfRow&) = default;
};

// Where a site is on a line or a ring that has it.
struct PlaceOnRow {
  Index site;
  Index row;
  std::int64_t along;  // the length of the way there
};

class Weld {
 public:
  // `given` is sorted; none: all places are.
  Weld(Geometries& features, const std::function<double(const Point&)>& near_at,
       std::span<const Point> given)
      : features_(features) {
    std::vector<Point> points = features.lines.rows.values;
    for (const Index corner : features.polygons.corners) {
      points.push_back(features.polygons.points[corner]);
    }
    auto [sites, numbers] = system::distinct(std::span<const Point>(points));
    sites_ = std::move(sites);
    numbers_ = std::move(numbers);
    for (const Point& site : sites_) {
      near_.push_back(near_at(site));
      is_given_.push_back(given.empty() || std::ranges::binary_search(given, site, exact::is_less));
    }
    for (Index i = 0; i < sites_.size(); ++i) places_.push_back(i);
    for_each_row([&](std::uint64_t begin, std::uint64_t end, bool is_ring) {
      take_places(begin, end, is_ring);
    });
    std::ranges::sort(on_rows_, {},
                      [](const PlaceOnRow& at) { return std::tuple(at.site, at.row, at.along); });
  }

  // Returns true if anything has changed.
  bool run() {
    unite_sites();
    for (Index& number : numbers_) number = places_[number];
    for_each_row([&](std::uint64_t begin, std::uint64_t end, bool is_ring) {
      add_sides(begin, end, is_ring);
    });
    std::ranges::sort(rows_of_sides_);
    find_sites_on_sides();
    if (num_united_ == 0 && on_sides_.empty() && !has_tiny_ring()) return false;
    FeatureLines lines = welded_lines();
    features_ = {std::move(lines), welded_polygons()};
    return true;
  }

 private:
  static constexpr auto any_row = [](Index /*row*/) { return true; };
  static constexpr std::int64_t length_of_line = std::numeric_limits<std::int64_t>::max();

  // A site on a side, and its order along it: the squared distance of its foot from the end of the
  // side that has the smaller coordinates, with the opposite sign where the side begins at the other
  // one. So a side has the same chain in both directions.
  struct SiteOnSide {
    Index side;
    double along;
    Index site;
  };

  // Calls visit(begin, end, is_ring) for the points of each line, and for the corners of each ring.
  template <class Visit>
  void for_each_row(const Visit& visit) const {
    const auto& lines = features_.lines.rows;
    for (std::size_t r = 0; r < lines.size(); ++r) {
      visit(lines.offsets[r], lines.offsets[r + 1], false);
    }
    const auto& rings = features_.polygons.rings;
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      visit(lines.values.size() + rings[r], lines.values.size() + rings[r + 1], true);
    }
  }

  // Takes the places of sites on the next line or ring.
  void take_places(std::uint64_t begin, std::uint64_t end, bool is_ring) {
    const auto row = static_cast<Index>(lengths_.size());
    std::int64_t along = 0;
    for (std::uint64_t k = begin; k < end; ++k) {
      on_rows_.push_back({numbers_[k], row, along});
      const bool is_last = k + 1 == end;
      if (is_last && !is_ring) break;
      along += length_of(sites_[numbers_[k]], sites_[numbers_[is_last ? begin : k + 1]]);
    }
    lengths_.push_back(is_ring ? along : length_of_line);
  }
  [[nodiscard]] bool is_line(Index row) const { return lengths_[row] == length_of_line; }
  // True if a line or a ring, one of those for which is_meant(row), has its shape between two sites, for
  // this distance. It has none that a simplification could leave out between places where lines meet
  // others.
  template <class IsMeant>
  [[nodiscard]] bool are_of_one_shape(Index i, Index j, double distance,
                                      const IsMeant& is_meant) const {
    const auto of_i = places_of(i);
    const auto of_j = places_of(j);
    const auto is_on_line_and_more = [&](std::span<const PlaceOnRow> places) {
      return places.size() > 1 &&
             std::ranges::any_of(places, [&](const PlaceOnRow& at) { return is_line(at.row); });
    };
    if (is_on_line_and_more(of_i) && is_on_line_and_more(of_j)) return false;
    return least_way(of_i, of_j, is_meant) <= std::llround(units * along_outline * distance);
  }
  [[nodiscard]] std::span<const PlaceOnRow> places_of(Index site) const {
    const auto begin = std::ranges::lower_bound(on_rows_, site, {}, &PlaceOnRow::site);
    const auto end = std::ranges::upper_bound(on_rows_, site, {}, &PlaceOnRow::site);
    return {begin, end};
  }
  // Returns the least length of a way between two sites along lines and rings for which is_meant(row).
  template <class IsMeant>
  [[nodiscard]] std::int64_t least_way(std::span<const PlaceOnRow> of_i,
                                       std::span<const PlaceOnRow> of_j,
                                       const IsMeant& is_meant) const {
    std::int64_t least = length_of_line;
    // Both are sorted by rows, of which a place where many lines meet has many.
    auto first = of_j.begin();
    for (const PlaceOnRow& a : of_i) {
      while (first != of_j.end() && first->row < a.row) ++first;
      for (auto b = first; b != of_j.end() && b->row == a.row; ++b) {
        const std::int64_t way = std::abs(a.along - b->along);
        if (is_meant(a.row)) least = std::min({least, way, lengths_[a.row] - way});
      }
    }
    return least;
  }

  // Gives sites that are too near to one with smaller coordinates the place of that one: the order of
  // sites changes nothing. Crossings come last, and go to the nearest corner: the sides that cross there
  // have no shape but between their ends.
  void unite_sites() {
    const BoxTree tree(
        sites_.size(), [&](std::size_t i) { return box_around(sites_[i], 0); }, 1);
    std::vector<Index> order = places_;
    std::ranges::sort(order, [&](Index i, Index j) { return is_less(i, j); });
    for (const Index i : order) {
      if (is_given_[i]) take_near(i, tree);
    }
    for (const Index i : order) {
      if (!is_given_[i]) go_to_nearest(i, tree);
    }
    for (const Index i : order) {
      if (!is_given_[i]) take_near(i, tree);
    }
  }
  [[nodiscard]] bool is_less(Index i, Index j) const {
    return exact::is_less(sites_[i], sites_[j]);
  }
  [[nodiscard]] double squared_distance(Index i, Index j) const {
    const Point step = sites_[j] - sites_[i];
    return dot(step, step);
  }
  // Gives sites of the same kind that are too near to a site its place.
  void take_near(Index i, const BoxTree& tree) {
    if (places_[i] != i) return;
    tree.visit(box_around(sites_[i], near_[i]), [&](Index j) {
      const double distance = squared_distance(i, j);
      if (is_given_[i] != is_given_[j] || !is_less(i, j) || places_[j] != j ||
          distance > squared(near_[i])) {
        return;
      }
      if (is_given_[i] && distance > squared(rounding_of_places) &&
          are_of_one_shape(i, j, std::sqrt(distance), any_row)) {
        return;
      }
      places_[j] = i;
      ++num_united_;
    });
  }
  // True if a crossing is across a narrow part of a small line or ring from a corner of it: not at the end
  // of its side. The ring would be folded there.
  [[nodiscard]] bool is_across(Index crossing, Index corner, double distance) const {
    constexpr double straight = 1 + 0x1p-10;
    const std::int64_t way = least_way(places_of(crossing), places_of(corner), any_row);
    return way <= std::llround(units * along_outline * near_[crossing]) &&
           way > std::llround(units * (straight * distance + rounding_of_places));
  }
  // Gives a crossing the place of the nearest corner that stays, if that is too near.
  void go_to_nearest(Index i, const BoxTree& tree) {
    double least = squared(near_[i]);
    Index nearest = i;
    tree.visit(box_around(sites_[i], near_[i]), [&](Index j) {
      if (!is_given_[j] || places_[j] != j) return;
      const double distance = squared_distance(i, j);
      if (is_across(i, j, std::sqrt(distance))) return;
      if (distance > least || (distance == least && nearest != i && is_less(nearest, j))) return;
      std::tie(least, nearest) = std::pair(distance, j);
    });
    if (nearest == i) return;
    places_[i] = nearest;
    ++num_united_;
  }

  // Adds the sides of a line or ring, whose sites are those of some numbers.
  void add_sides(std::uint64_t begin, std::uint64_t end, bool is_ring) {
    for (std::uint64_t k = begin; k < end; ++k) {
      const bool is_last = k + 1 == end;
      if (is_last && !is_ring) continue;
      sides_.push_back({numbers_[k], numbers_[is_last ? begin : k + 1]});
      const auto [low, high] = std::minmax(sides_.back()[0], sides_.back()[1]);
      rows_of_sides_.push_back({low, high, num_rows_});
    }
    ++num_rows_;
  }
  // True if a site is beside a side by the shape of a line or a ring that has the side, or by that of an
  // outline that is at both ends of it: a weld would run to and fro between the corners of a small one
  // across it. Beside lines that does no harm.
  [[nodiscard]] bool is_of_one_shape(Index site, const std::array<Index, 2>& side,
                                     double height) const {
    const auto [low, high] = std::minmax(side[0], side[1]);
    auto has_it = std::ranges::lower_bound(rows_of_sides_, SideOfRow{low, high, 0});
    const auto has_side = [&, first = has_it](Index row) {
      return std::ranges::binary_search(first, rows_of_sides_.end(),
                                        SideOfRow{first->low, first->high, row});
    };
    if (are_of_one_shape(site, side[0], height, has_side) ||
        are_of_one_shape(site, side[1], height, has_side)) {
      return true;
    }
    while (is_line(has_it->row)) {
      ++has_it;
      if (has_it == rows_of_sides_.end() || has_it->low != low || has_it->high != high)
        return false;
    }
    return are_of_one_shape(site, side[0], height, any_row) &&
           are_of_one_shape(site, side[1], height, any_row);
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
    if (std::abs(height) > rounding_of_places &&
        is_of_one_shape(site, sides_[side], std::abs(height)))
      return;
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

  [[nodiscard]] std::vector<Point> points_of(std::span<const Index> sites) const {
    std::vector<Point> points;
    for (const Index site : sites) points.push_back(sites_[site]);
    return points;
  }

  // True if all sites of a ring are near the one with the smallest coordinates.
  [[nodiscard]] bool is_tiny(std::span<const Index> ring) const {
    const Index least = *std::ranges::min_element(
        ring, [&](Index i, Index j) { return exact::is_less(sites_[i], sites_[j]); });
    return std::ranges::all_of(ring, [&](Index site) {
      const Point step = sites_[site] - sites_[least];
      return dot(step, step) <= squared(near_[least]);
    });
  }
  [[nodiscard]] bool has_tiny_ring() const {
    const auto& rings = features_.polygons.rings;
    const auto first = static_cast<std::ptrdiff_t>(features_.lines.rows.values.size());
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      const auto begin = numbers_.begin() + first + static_cast<std::ptrdiff_t>(rings[r]);
      const auto size = static_cast<std::size_t>(rings[r + 1] - rings[r]);
      if (size > 0 && is_tiny(std::span(begin, size))) return true;
    }
    return false;
  }

  // True if a small ring has no inside, or has it on the other side than the ring that was given.
  static bool is_inverted(std::span<const Point> ring, std::span<const Point> given) {
    constexpr double small = 0.1;
    const double area = map::area_on_left(ring);
    if (std::abs(area) > small) return false;
    const double before = map::area_on_left(given);
    return std::abs(before) < small && (area == 0 || (area < 0) != (before < 0));
  }

  FeatureLines welded_lines() {
    FeatureLines made;
    const FeatureLines& lines = features_.lines;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (std::uint64_t r = lines.offsets[i]; r < lines.offsets[i + 1]; ++r) {
        made.rows.append(
            points_of(next_chain(lines.rows.offsets[r], lines.rows.offsets[r + 1], false)));
      }
      made.end_group();
    }
    return made;
  }

  // A ring before and after.
  struct WeldedRing {
    std::vector<Point> given;
    std::vector<Point> points;  // none: it vanishes
  };

  // A polygon that changes is repaired, as parts of it that are narrower than the weld may overlap.
  CellRings welded_polygons() {
    CellRings made;
    const CellRings& polygons = features_.polygons;
    for (std::size_t i = 0; i < polygons.num_cells(); ++i) {
      if (polygons.is_whole(i)) {  // since the round before
        made.append_cell(polygons, i);
        continue;
      }
      std::vector<WeldedRing> rings;
      for (std::uint64_t r = polygons.cells[i]; r < polygons.cells[i + 1]; ++r) {
        rings.push_back(next_ring(r));
      }
      drop_what_is_within(i, rings);
      const bool is_changed = std::ranges::any_of(
          rings, [](const WeldedRing& ring) { return ring.points != ring.given; });
      const CellRings one = polygon_of(rings);
      overlay::append(is_changed && !one.corners.empty() ? repaired_polygon(one, rings) : one,
                      made);
    }
    return made;
  }
  // The direction of rings of which little is left may be wrong; so a place opposite to them says
  // what is inside.
  static CellRings repaired_polygon(const CellRings& one, const std::vector<WeldedRing>& rings) {
    constexpr double least_cosine = 0.2;  // of 78 degrees
    exact::Vector3<double> sum{};
    std::vector<std::vector<Point>> given;
    for (const WeldedRing& ring : rings) {
      given.push_back(ring.given);
      for (const Point& p : ring.given) sum = sum + exact::to_vector(p);
    }
    std::optional<arrangement::KnownPlace> known;
    const Point middle = exact::to_point(normalized(sum));
    const bool are_near = std::ranges::all_of(given, [&](const std::vector<Point>& ring) {
      return std::ranges::all_of(ring,
                                 [&](const Point& p) { return dot(p, middle) > least_cosine; });
    });
    if (are_near) {
      known = {Point{-middle.x, -middle.y, -middle.z}, given.front().front(),
               map::have_outside_on_left(given)};
    }
    return arrangement::even_odd_union(one, std::span(&known, 1), {.threads = 1});
  }
  WeldedRing next_ring(std::uint64_t number) {
    const std::uint64_t first = features_.lines.rows.values.size();
    const auto& rings = features_.polygons.rings;
    const std::vector<Index> sites =
        next_chain(first + rings[number], first + rings[number + 1], true);
    WeldedRing ring{overlay::points_of_ring(features_.polygons, number), points_of(sites)};
    if (sites.size() < 3 || is_tiny(sites) || is_inverted(ring.points, ring.given)) {
      ring.points.clear();
    }
    return ring;
  }
  // Drops the rings around which a ring vanishes: a lake does with its island.
  void drop_what_is_within(std::size_t cell, std::vector<WeldedRing>& rings) const {
    std::vector<bool> vanishes;
    for (const WeldedRing& ring : rings) vanishes.push_back(ring.points.empty());
    const std::vector<bool> is_within = rings_within(features_.polygons, cell, vanishes);
    for (std::size_t i = 0; i < rings.size(); ++i) {
      if (is_within[i]) rings[i].points.clear();
    }
  }
  static CellRings polygon_of(const std::vector<WeldedRing>& rings) {
    CellRings one;
    std::vector<std::vector<Point>> given;
    for (const WeldedRing& ring : rings) {
      given.push_back(ring.given);
      if (!ring.points.empty()) overlay::append_ring_of(ring.points, one);
    }
    if (one.corners.empty() && map::have_outside_on_left(given)) one.whole.push_back(0);
    one.end_cell();
    return one;
  }

  Geometries& features_;
  std::vector<Point> sites_;
  std::vector<Index> numbers_;               // the site of each point of lines, and of each corner
  std::vector<std::array<Index, 2>> sides_;  // of lines and rings, one after the other
  std::vector<SideOfRow> rows_of_sides_;     // sorted
  Index num_rows_ = 0;                       // of which there are sides
  std::vector<Index> places_;                // of each site: the site whose place it has
  std::vector<double> near_;                 // by site
  std::vector<bool> is_given_;               // by site: it is no crossing
  std::vector<PlaceOnRow> on_rows_;          // sorted by site
  std::vector<std::int64_t> lengths_;        // of lines, which do not come back, and of rings
  std::vector<SiteOnSide> on_sides_;
  std::size_t num_united_ = 0;
  Index side_ = 0;        // of the next line or ring
  std::size_t next_ = 0;  // of on_sides_
};

// True if all places are near the one with the smallest coordinates.
bool are_tiny(std::span<const Point> places, const std::function<double(const Point&)>& near_at) {
  if (places.empty()) return false;
  const Point least = *std::ranges::min_element(places, exact::is_less);
  const double near = near_at(least);
  return std::ranges::all_of(places, [&](const Point& place) {
    const Point step = place - least;
    return dot(step, step) <= squared(near);
  });
}

}  // namespace

void drop_tiny_rings(CellRings& polygons, const std::function<double(const Point&)>& near_at) {
  std::vector<bool> is_tiny;
  for (std::uint64_t r = 0; r + 1 < polygons.rings.size(); ++r) {
    is_tiny.push_back(are_tiny(overlay::points_of_ring(polygons, r), near_at));
  }
  if (std::ranges::find(is_tiny, true) == is_tiny.end()) return;
  CellRings kept;
  kept.points = polygons.points;
  for (std::size_t cell = 0; cell < polygons.num_cells(); ++cell) {
    const auto first = static_cast<std::ptrdiff_t>(polygons.cells[cell]);
    const auto end = static_cast<std::ptrdiff_t>(polygons.cells[cell + 1]);
    const std::vector<bool> dropped(is_tiny.begin() + first, is_tiny.begin() + end);
    if (std::ranges::find(dropped, true) == dropped.end()) {
      kept.append_cell(polygons, cell);
      continue;
    }
    const std::vector<bool> is_within = rings_within(polygons, cell, dropped);
    std::vector<std::vector<Point>> given;
    const std::size_t num_before = kept.rings.size();
    for (std::size_t i = 0; i < dropped.size(); ++i) {
      const std::uint64_t ring = polygons.cells[cell] + i;
      given.push_back(overlay::points_of_ring(polygons, ring));
      if (!dropped[i] && !is_within[i]) kept.append_ring(polygons.corners_of(ring));
    }
    if (kept.rings.size() == num_before && map::have_outside_on_left(given)) {
      kept.whole.push_back(static_cast<Index>(cell));
    }
    kept.end_cell();
  }
  polygons = std::move(kept);
}

void shrink_tiny_lines(FeatureLines& lines, const std::function<double(const Point&)>& near_at) {
  CompressedRows<Point> rows;
  for (std::size_t k = 0; k < lines.rows.size(); ++k) {
    const std::span<const Point> line = lines.rows[k];
    if (line.size() > 1 && are_tiny(line, near_at)) {
      rows.append(std::array{*std::ranges::min_element(line, exact::is_less)});
    } else {
      rows.append(line);
    }
  }
  lines.rows = std::move(rows);
}

void weld(Geometries& features, const std::function<double(const Point&)>& near_at,
          std::span<const Point> given) {
  drop_tiny_rings(features.polygons, near_at);
  shrink_tiny_lines(features.lines, near_at);
  // Sides that have moved may come near to other corners, and repaired polygons have new ones.
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds && Weld(features, near_at, given).run(); ++round) {
  }
}

std::vector<Point> places_of(const Geometries& features) {
  std::vector<Point> places = features.lines.rows.values;
  for (const Index corner : features.polygons.corners) {
    places.push_back(features.polygons.points[corner]);
  }
  std::ranges::sort(places, exact::is_less);
  return places;
}

}  // namespace rondel::meshing
