// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/feature_polygons.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "exact/eft.h"
#include "overlay/border_rings.h"
#include "overlay/disjoint_cells.h"
#include "overlay/feature_repairs.h"
#include "overlay/overlaps.h"
#include "overlay/plane_areas.h"
#include "overlay/plane_sweep.h"
#include "overlay/single_cells.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "system/distinct.h"
#include "system/parallel.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t swept_per_block = 16;
constexpr double map_area = 360.0 * 180;  // square degrees

// Returns the message about a fault.
std::string text_of_fault(const std::vector<map::LonLatRing>& rings, const PlaneFault& fault) {
  const std::string second = ring_name(rings, fault.second);
  const std::string first = fault.first == no_index ? "" : ring_name(rings, fault.first);
  const std::string at = " at " + text_of_place(fault.place);
  switch (fault.kind) {
    case PlaneFaultKind::crossing:
      return fault.first == fault.second ? first + " crosses itself" + at
                                         : first + " and " + second + " cross" + at;
    case PlaneFaultKind::overlap:
      return second + " lies in the polygon of " + first + at;
    case PlaneFaultKind::outside:
      return second + ", a hole, does not lie inside of its polygon" +
             (first.empty() ? "" : " but in " + first) + at;
    case PlaneFaultKind::filled:
      return "the holes of " + second + " leave nothing of it";
    case PlaneFaultKind::no_area:
      break;
  }
  return second + " runs to and fro along a line" + at;
}

// Returns advice for a ring around a pole that is not led to the pole, or an empty text for other
// rings.
std::string advice_on(const map::LonLatRing& ring) {
  const std::size_t n = ring.positions.size();
  for (std::size_t k = 0; k < n; ++k) {
    const LonLat& from = ring.positions[k];
    const LonLat& to = ring.positions[k + 1 < n ? k + 1 : 0];
    const bool is_at_pole = std::abs(from.lat_deg) == 90 && std::abs(to.lat_deg) == 90;
    if (std::abs(to.lon_deg - from.lon_deg) <= 180 || is_at_pole) continue;
    return "; its side from " + text_of_place(from) + " to " + text_of_place(to) +
           " crosses the map: a ring around a pole has to be led there along the longitudes -180 "
           "and "
           "180, or to be read with geodesic edges";
  }
  return "";
}

// Marks a ring that has an area, but that corners of others on its sides have closed, and with a
// shell its holes, as left out. Returns false for other rings.
bool leave_out_thin_ring(std::vector<map::LonLatRing>& rings, const PlaneFault& fault) {
  map::LonLatRing& ring = rings[fault.second];
  if (fault.kind != PlaneFaultKind::no_area || ring.thin_positions.empty()) return false;
  const map::LonLatRing given{ring.thin_positions};
  const PlaneRegion region = sweep_rings({&given, 1});
  if (region.fault && region.fault->kind == PlaneFaultKind::no_area) return false;
  ring.is_left_out = true;
  for (std::size_t r = fault.second + std::size_t{1}; !ring.is_hole && r < rings.size(); ++r) {
    if (!rings[r].is_hole) break;
    rings[r].is_left_out = true;
  }
  return true;
}

// Returns a side that begins in the west between -180 and 180 degrees, so that sides in one place
// are divided alike; or the side itself if its ends would be rounded.
PlaneSide on_map(const PlaneSide& side) {
  const double west = std::min(side.from.lon_deg, side.to.lon_deg);
  const double turns = 360 * std::floor((west + 180) / 360);
  if (turns == 0) return side;
  const auto [from, from_error] = exact::two_sum(side.from.lon_deg, -turns);
  const auto [to, to_error] = exact::two_sum(side.to.lon_deg, -turns);
  if (from_error != 0 || to_error != 0) return side;
  return {{from, side.from.lat_deg}, {to, side.to.lat_deg}};
}

// What is known of a feature alone.
struct CheckedFeature {
  std::string fault;                   // what is wrong with it, or an empty text
  std::vector<map::LonLatRing> rings;  // those of the region, with the corners on their sides
  std::optional<PlaneRegion> region;   // known where straight sides were swept without a fault
  std::optional<CellRings> cell;       // known where geodesic sides have no fault
};

// True if rings are swept alike.
bool are_same(std::span<const map::LonLatRing> rings, std::span<const map::LonLatRing> others) {
  return std::ranges::equal(rings, others, [](const map::LonLatRing& a, const map::LonLatRing& b) {
    return a.is_hole == b.is_hole && a.is_left_out == b.is_left_out && a.positions == b.positions;
  });
}

// Converts all features with one set of options. Features with a fault are repaired, the others are
// valid alone; if nothing is known of them, a fault is thrown.
class FeatureCells {
 public:
  FeatureCells(map::PolygonFeatures& features, const PolygonOptions& options,
               std::span<const CheckedFeature> checked, const Execution& execution,
               FaultTexts texts = FaultTexts::full)
      : features_(features),
        options_(options),
        checked_(checked),
        execution_(execution),
        texts_(texts),
        facts_(features.files.size()) {}

  // Returns the cells of all features, with overlaps treated as the options say. Throws FileError.
  CellRings operator()() {
    const bool is_geodesic = options_.edges == PolygonEdges::geodesic;
    CellRings cells = is_geodesic ? all_geodesic_cells() : plane_cells();
    look_for_vanished(cells);
    if (options_.overlap == PolygonOverlap::keep) {
      if (is_geodesic) {
        require_sound(cells);
      } else {
        require_parts_apart(cells);
      }
      return cells;
    }
    std::vector<Index> all(cells.num_cells());
    std::iota(all.begin(), all.end(), Index{0});
    const std::vector<CrossingCells> overlaps = overlaps_in(cells, all);
    if (overlaps.empty()) return cells;
    if (options_.overlap == PolygonOverlap::first) {
      drop_sides_of(overlaps);
      return first_of_all(cells, overlaps);
    }
    throw FileError(
        features_.files.front().name + ": features " + name_of(overlaps[0].first) + " and " +
        name_of(overlaps[0].second) + " overlap at " + text_of_place(overlaps[0].place) +
        (overlaps.size() == 1
             ? ""
             : ", and " + std::to_string(overlaps.size() - 1) + " more pairs of features"));
  }
  // True if the only feature has geodesic sides and is valid at first sight, so that check() finds
  // no fault. What check() keeps is kept if it is needed.
  [[nodiscard]] bool is_plain(CheckedFeature& checked, bool needs_cell) const {
    const bool has_arcs_alone =
        options_.edges == PolygonEdges::geodesic && features_.lines.front().empty();
    if (!has_arcs_alone) return false;
    if (!needs_cell) return is_plainly_valid(features_.rings.front(), quiet());
    checked.cell = plain_cell(features_.rings.front(), quiet());
    return checked.cell.has_value();
  }
  // Throws FeatureFault if the only feature is not valid. Straight lines need not become arcs for
  // that, unless parts of the feature are 360 degrees apart. What is found is kept.
  void check(CheckedFeature& checked) {
    if (options_.edges == PolygonEdges::geodesic) {
      checked.cell = (*this)();
      return;
    }
    if (is_wide(0)) {
      (void)(*this)();
      return;
    }
    require_turns(0);
    require_lines(features_, 0, false);
    (void)share_corners(features_, execution_.threads);
    PlaneRegion region = swept(0);
    (void)area_of(region, 0);
    checked.region = std::move(region);
    checked.rings = std::move(features_.rings.front());
  }
  // Returns the straight sides of all features: none of those that were repaired.
  [[nodiscard]] CompressedRows<PlaneSide>& sides() { return sides_; }
  // Returns the lines of all features.
  [[nodiscard]] FeatureLines& lines() { return lines_; }
  // Returns sentences on what was repaired and what is too thin for a cell, of each file.
  [[nodiscard]] std::vector<CellFacts>& facts() { return facts_; }

 private:
  // Returns a feature's name for messages.
  [[nodiscard]] std::string name_of(std::size_t feature) const {
    const auto [file, of_file] = features_.place_of(feature);
    return feature_name(file.columns, of_file);
  }
  // Adds a sentence about features of a file: "feature 3 (Peru)" and `one`, or "feature 3 (Peru)
  // and 2 more" and `many`.
  void tell_of(std::size_t file, std::span<const std::size_t> found, const std::string& one,
               const std::string& many) {
    if (found.empty()) return;
    std::string text = "feature " + name_of(found.front());
    if (found.size() > 1) text += " and " + std::to_string(found.size() - 1) + " more";
    facts_[file].remarks.push_back(text + (found.size() > 1 ? many : one));
  }
  // Calls visit(file, first feature, past its last feature) for each file.
  template <class Visit>
  void for_each_file(const Visit& visit) const {
    std::size_t first = 0;
    for (std::size_t file = 0; file < features_.files.size(); ++file) {
      const bool is_last = file + 1 == features_.files.size();
      const std::size_t end =
          is_last ? features_.rings.size() : first + features_.files[file].num_features;
      visit(file, first, end);
      first = end;
    }
  }

  // Returns the first_of_cells(). Throws FileError if rounding has made them overlap themselves.
  [[nodiscard]] CellRings first_of_all(const CellRings& cells,
                                       std::span<const CrossingCells> overlaps) const {
    try {
      return first_of_cells(cells, overlaps, quiet());
    } catch (const InvalidInput& error) {
      const CrossingCells& pair = overlaps.front();
      throw FileError(features_.files.front().name + ": features that overlap cannot be laid " +
                      "over each other (the first two are " + name_of(pair.first) + " and " +
                      name_of(pair.second) + ", at " + text_of_place(pair.place) +
                      "): " + error.what());
    }
  }

  void look_for_vanished(const CellRings& cells) {
    for_each_file([&](std::size_t file, std::size_t first, std::size_t end) {
      std::vector<std::size_t> vanished;
      std::vector<std::size_t> thinned;
      for (std::size_t f = first; f < end; ++f) {
        const std::vector<map::LonLatRing>& rings = features_.rings[f];
        const bool has_cell = cells.cells[f] < cells.cells[f + 1] || cells.is_whole(f);
        if (!rings.empty() && !has_cell) {
          vanished.push_back(f);
        } else if (std::ranges::any_of(rings, &map::LonLatRing::is_left_out)) {
          thinned.push_back(f);
        }
      }
      const std::string width = "no wider than rounding of the corners (some 2e-13 degrees), ";
      tell_of(file, vanished, " is " + width + "so nothing is left",
              " are " + width + "so nothing is left");
      tell_of(file, thinned, " has rings " + width + "which are left out",
              " have rings " + width + "which are left out");
    });
  }
  [[noreturn]] void refuse(std::size_t feature, const std::string& what) const {
    refuse_feature(features_, feature, what);
  }
  // Returns execution options without a progress callback: the parts of this work would each report
  // from 0 on.
  [[nodiscard]] Execution quiet() const {
    return {.threads = execution_.threads, .stop = execution_.stop};
  }

  // Returns the pairs of features that overlap; `features` names the feature of each cell. Throws
  // FileError if a cell overlaps itself.
  [[nodiscard]] std::vector<CrossingCells> overlaps_in(const CellRings& cells,
                                                       const std::vector<Index>& features) const {
    std::vector<CrossingCells> overlaps;
    try {
      overlaps = overlapping_cells(cells, quiet());
    } catch (const InvalidInput& error) {
      refuse(features[error.index()], error.what());
    }
    for (const CrossingCells& pair : overlaps) {
      if (pair.first != pair.second) continue;
      if (options_.edges == PolygonEdges::geodesic) {
        refuse_geodesic_holes(features_, features[pair.first], quiet());
      }
      refuse(features[pair.first],
             "the polygon crosses or overlaps itself at " + text_of_place(pair.place));
    }
    return overlaps;
  }

  // Throws FileError if a cell crosses or overlaps itself, but for rounding. Cells of features that
  // were checked alone do not.
  void require_sound(const CellRings& cells) const {
    std::vector<Index> features;
    CellRings repaired;
    for (Index f = 0; f < cells.num_cells(); ++f) {
      if (!checked_.empty() && !is_faulty(f)) continue;
      features.push_back(f);
      if (!checked_.empty()) append(one_cell(cells, f), repaired);
    }
    merge_equal_points(repaired);
    const CellRings& judged = checked_.empty() ? cells : repaired;
    if (!are_exactly_valid(judged, quiet())) (void)overlaps_in(judged, features);
  }

  // True if places of a feature are more than 360 degrees apart.
  [[nodiscard]] bool is_wide(std::size_t feature) const {
    double west = std::numeric_limits<double>::infinity();
    double east = -west;
    for (const map::LonLatRing& ring : features_.rings[feature]) {
      for (const LonLat& p : ring.positions) {
        west = std::min(west, p.lon_deg);
        east = std::max(east, p.lon_deg);
      }
    }
    return east - west > 360;
  }

  // Throws FileError if parts of a feature that are disjoint in the plane overlap on the sphere,
  // because they are 360 degrees apart.
  void require_parts_apart(const CellRings& cells) const {
    std::vector<Index> features;
    CellRings wide;
    for (Index f = 0; f < features_.rings.size(); ++f) {
      if (!is_wide(f)) continue;
      features.push_back(f);
      append(one_cell(cells, f), wide);
    }
    merge_equal_points(wide);
    if (!features.empty()) (void)overlaps_in(wide, features);
  }

  // Takes the rings of features that are to be repaired away from the others, and returns them.
  std::vector<std::vector<map::LonLatRing>> faulty_rings() {
    std::vector<std::vector<map::LonLatRing>> faulty(checked_.size());
    for (std::size_t f = 0; f < checked_.size(); ++f) {
      if (is_faulty(f)) faulty[f].swap(features_.rings[f]);
    }
    return faulty;
  }
  // Appends the cells of all features: keep(f) does it where there is no fault, and repaired(f) is
  // appended elsewhere. Returns all cells.
  template <class Keep, class Repair>
  CellRings repair(MergedCells& merged, const Keep& keep, const Repair& repaired) {
    std::vector<std::size_t> features;
    for (std::size_t f = 0; f < checked_.size(); ++f) {
      if (!is_faulty(f)) {
        keep(f);
        continue;
      }
      features.push_back(f);
      try {
        merged.append(repaired(f));
      } catch (const InvalidInput& error) {
        refuse(f, checked_[f].fault + ", which cannot be repaired: " + error.what());
      }
    }
    CellRings cells = merged.made();
    tell_of_repaired(features, cells);
    return cells;
  }
  void tell_of_repaired(const std::vector<std::size_t>& features, const CellRings& cells) {
    for_each_file([&](std::size_t file, std::size_t first_feature, std::size_t end) {
      const auto first = std::ranges::lower_bound(features, first_feature);
      const auto past = std::ranges::lower_bound(features, end);
      if (first == past) return;
      std::string text =
          "feature " + name_of(*first) + " was repaired (" + checked_[*first].fault + ")";
      if (past - first > 1) text += ", and " + std::to_string(past - first - 1) + " more";
      const auto num_empty = std::count_if(first, past, [&](std::size_t f) {
        return cells.cells[f] == cells.cells[f + 1] && !cells.is_whole(f) &&
               lines_.offsets[f] == lines_.offsets[f + 1];
      });
      if (num_empty > 0) text += "; nothing is left of " + std::to_string(num_empty);
      facts_[file].remarks.push_back(std::move(text));
    });
  }

  CellRings all_geodesic_cells() {
    const std::vector<std::vector<map::LonLatRing>> faulty = faulty_rings();
    lines_ = geodesic_lines(features_);
    if (checked_.empty()) return geodesic_cells(features_, quiet(), texts_);
    std::size_t num_points = 0;
    for (const CheckedFeature& feature : checked_) {
      if (feature.cell) num_points += feature.cell->points.size();
    }
    const CellRings none;
    MergedCells merged(none, num_points);
    return repair(
        merged, [&](std::size_t f) { merged.append_by_corners(*checked_[f].cell); },
        [&](std::size_t f) { return repaired_geodesic_feature(faulty[f], quiet()); });
  }

  // Throws FeatureFault for a feature that is not valid as it was before it shared corners: where
  // its sides cross, they have a corner of another feature by now.
  void require_valid_alone(std::vector<FeatureBefore> some) {
    const bool is_alone = features_.rings.size() == 1 && features_.lines.front().empty();
    if (is_alone) return;
    const PolygonOptions alone{.edges = options_.edges, .tolerance_deg = options_.tolerance_deg};
    for (FeatureBefore& before : some) {
      if (is_faulty(before.feature)) continue;
      map::PolygonFeatures one;
      one.rings.push_back(std::move(before.rings));
      one.lines.resize(1);
      try {
        CheckedFeature checked;
        FeatureCells(one, alone, {}, quiet()).check(checked);
      } catch (const FeatureFault& fault) {
        refuse(before.feature, fault.fault());
      }
    }
  }

  // Returns the cells of polygons whose sides are straight in longitude and latitude.
  CellRings plane_cells() {
    for (std::size_t f = 0; f < features_.rings.size(); ++f) {
      require_turns(f);
      require_lines(features_, f, is_faulty(f));
    }
    require_valid_alone(share_corners(features_, execution_.threads));
    const std::vector<std::vector<map::LonLatRing>> faulty = faulty_rings();
    std::vector<PlaneSide> sides;
    std::vector<Index> owners;
    std::vector<std::size_t> turns(features_.rings.size());
    sweep(sides, owners, turns);
    std::vector<std::size_t> first_sides(faulty.size());
    for (std::size_t f = 0; f < faulty.size(); ++f) {
      first_sides[f] = sides.size();
      const std::vector<PlaneSide> given = given_sides(faulty[f]);
      sides.insert(sides.end(), given.begin(), given.end());
    }
    const std::size_t first_of_lines = sides.size();
    append_line_sides(features_, sides);
    for (PlaneSide& side : sides) side = on_map(side);
    DividedSides divided = divide_for_areas(
        sides, owners, options_.tolerance_deg * (std::numbers::pi / 180), execution_.threads);
    share_polar_corners(sides, divided);
    lines_ = divided_lines(features_, divided, first_of_lines);
    CellRings cells = cells_of_sides(sides, owners, divided);
    keep_sides(sides, owners);
    // A feature that has an area in the plane but no border on the sphere covers the sphere.
    for (std::size_t f = 0; f < turns.size(); ++f) {
      if (turns[f] > 0 && cells.cells[f] == cells.cells[f + 1]) {
        cells.whole.push_back(static_cast<Index>(f));
      }
    }
    if (checked_.empty()) return cells;
    MergedCells merged(cells, 0);
    const auto keep = [&](std::size_t f) { merged.append_of_set(static_cast<Index>(f)); };
    return repair(merged, keep, [&](std::size_t f) {
      std::vector<std::span<const LonLat>> rows;
      const std::size_t end = f + 1 < faulty.size() ? first_sides[f + 1] : first_of_lines;
      for (std::size_t s = first_sides[f]; s < end; ++s) rows.push_back(divided[s]);
      return repaired_plane_feature(faulty[f], rows, quiet());
    });
  }

  // Keeps the sides that have owners, which are in order.
  void keep_sides(std::span<const PlaneSide> sides, std::span<const Index> owners) {
    sides_.values.reserve(owners.size());
    sides_.offsets.reserve(features_.rings.size() + 1);
    std::size_t next = 0;
    for (std::size_t f = 0; f < features_.rings.size(); ++f) {
      while (next < owners.size() && owners[next] == f) sides_.values.push_back(sides[next++]);
      sides_.end_row();
    }
  }
  // Removes the sides of features that overlap: what is left of them is between arcs.
  void drop_sides_of(std::span<const CrossingCells> overlaps) {
    std::vector<bool> is_dropped(sides_.size(), false);
    for (const CrossingCells& pair : overlaps) {
      if (pair.second >= is_dropped.size()) continue;  // geodesic sides
      is_dropped[pair.first] = true;
      is_dropped[pair.second] = true;
    }
    CompressedRows<PlaneSide> kept;
    for (std::size_t f = 0; f < sides_.size(); ++f) {
      kept.append(is_dropped[f] ? std::span<const PlaneSide>() : sides_[f]);
    }
    sides_ = std::move(kept);
  }

  // Returns the cells of features that own the first sides, which are divided.
  [[nodiscard]] CellRings cells_of_sides(std::span<const PlaneSide> sides,
                                         std::span<const Index> owners,
                                         const DividedSides& divided) const {
    std::vector<LonLat> positions;  // of each owned side: where it begins, is divided, and ends
    positions.reserve(divided.values.size() + owners.size());
    for (std::size_t s = 0; s < owners.size(); ++s) {
      positions.insert(positions.end(), divided[s].begin(), divided[s].end());
      positions.push_back(sides[s].to);
    }
    // Neighboring sides have a position in common, and so have neighboring features.
    const system::Distinct<LonLat> places = system::distinct<LonLat>(positions);
    std::vector<Point> corners(places.values.size());
    std::ranges::transform(places.values, corners.begin(),
                           [](const LonLat& p) { return unit_vector(p); });
    std::vector<KeyedSide> arcs;
    arcs.reserve(positions.size());
    std::size_t place = 0;
    for (std::size_t s = 0; s < owners.size(); ++s, ++place) {
      for (std::size_t end = place + divided[s].size(); place < end; ++place) {
        arcs.push_back({owners[s], places.numbers[place], places.numbers[place + 1]});
      }
    }
    return rings_around(corners, arcs, features_.rings.size(), execution_.threads);
  }

  // Throws FileError for a side that spans more than 180 degrees of longitude, with what to do
  // about it.
  [[noreturn]] void refuse_long_side(std::size_t feature, Index ring, std::size_t side) const {
    const std::vector<map::LonLatRing>& rings = features_.rings[feature];
    const std::vector<LonLat>& positions = rings[ring].positions;
    const LonLat& from = positions[side];
    const LonLat& to = positions[side + 1 < positions.size() ? side + 1 : 0];
    refuse(feature, ring_name(rings, ring) + ": its side from " + text_of_place(from) + " to " +
                        text_of_place(to) +
                        " spans more than 180 degrees of longitude: a ring around a pole has to be "
                        "led there along the longitudes -180 and 180, or to be read with geodesic "
                        "edges; if the long side is meant, divide it by a position");
  }

  // True if a feature is to be repaired.
  [[nodiscard]] bool is_faulty(std::size_t feature) const {
    return !checked_.empty() && !checked_[feature].fault.empty();
  }

  // Throws FileError for a ring that is not closed, that has a side around a pole, or that is more
  // than ten turns of the globe away. Rings to be repaired may have such sides, and are told to go
  // the shorter way.
  void require_turns(std::size_t feature) {
    std::vector<map::LonLatRing>& rings = features_.rings[feature];
    for (Index r = 0; r < rings.size(); ++r) {
      const std::vector<LonLat>& positions = rings[r].positions;
      if (is_faulty(feature)) {
        rings[r].is_shorter = goes_shorter_way(rings[r]);
      } else if (rings[r].is_turn) {
        refuse(feature,
               ring_name(rings, r) + " goes around the globe from " +
                   text_of_place(positions.front()) +
                   " and is not closed: a ring around a pole has to be led there along the "
                   "longitudes -180 and 180, or to be read with geodesic edges");
      } else if (const auto side = lone_long_side(positions)) {
        refuse_long_side(feature, r, *side);
      }
      for (const LonLat& p : positions) {
        if (std::abs(p.lon_deg) > max_turns * 360) {
          refuse(feature, ring_name(rings, r) + ": longitude " + text_of_place(p) +
                              " is more than ten turns of the globe away");
        }
      }
    }
  }

  // Returns the region of a feature, without its rings that corners of others have closed.
  PlaneRegion swept(std::size_t feature) {
    PlaneRegion region;
    do {
      region = sweep_rings(features_.rings[feature]);
    } while (region.fault && leave_out_thin_ring(features_.rings[feature], *region.fault));
    return region;
  }

  // Returns the area of a region in square degrees. Throws FileError for a fault.
  [[nodiscard]] double area_of(const PlaneRegion& region, std::size_t feature) const {
    const std::vector<map::LonLatRing>& rings = features_.rings[feature];
    if (const auto& fault = region.fault) {
      refuse(feature, text_of_fault(rings, *fault) + advice_on(rings[fault->second]));
    }
    double area = 0;
    for (const PlaneSide& side : region.sides) {
      area += (side.to.lat_deg + side.from.lat_deg) * (side.from.lon_deg - side.to.lon_deg) / 2;
    }
    if (area > map_area * (1 + 1e-9)) refuse(feature, "the polygon covers more than the whole map");
    return area;
  }

  // Collects the sides of all features with their features, and for each feature in `turns` how
  // often it covers the map, rounded. What was swept before is not swept again.
  void sweep(std::vector<PlaneSide>& sides, std::vector<Index>& owners,
             std::vector<std::size_t>& turns) {
    std::vector<PlaneRegion> regions(features_.rings.size());
    const auto known = [&](std::size_t f) {
      const bool is_known = !checked_.empty() && checked_[f].region &&
                            are_same(features_.rings[f], checked_[f].rings);
      return is_known ? &*checked_[f].region : nullptr;
    };
    system::parallel_for(execution_.threads, regions.size(), swept_per_block,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t f = begin; f < end; ++f) {
                             if (known(f) == nullptr) regions[f] = swept(f);
                           }
                         });
    std::size_t num_sides = 0;
    for (const PlaneRegion& region : regions) num_sides += region.sides.size();
    for (const CheckedFeature& feature : checked_) {
      if (feature.region) num_sides += feature.region->sides.size();
    }
    sides.reserve(num_sides);
    owners.reserve(num_sides);
    for (std::size_t f = 0; f < regions.size(); ++f) {
      const PlaneRegion* before = known(f);
      const PlaneRegion& region = before != nullptr ? *before : regions[f];
      turns[f] = static_cast<std::size_t>(std::max(0.0, std::round(area_of(region, f) / map_area)));
      sides.insert(sides.end(), region.sides.begin(), region.sides.end());
      owners.insert(owners.end(), region.sides.size(), static_cast<Index>(f));
    }
  }

  map::PolygonFeatures& features_;
  const PolygonOptions& options_;
  std::span<const CheckedFeature> checked_;  // of each feature, or none
  const Execution& execution_;
  FaultTexts texts_;
  CompressedRows<PlaneSide> sides_;
  FeatureLines lines_;
  std::vector<CellFacts> facts_;  // of each file: the remarks
};

// Checks each feature alone. Where no cells are needed, a feature with geodesic sides that is valid
// at first sight gets none.
std::vector<CheckedFeature> checked_features(const map::PolygonFeatures& features,
                                             const PolygonOptions& options, bool needs_cells,
                                             FaultTexts texts, const Execution& execution) {
  std::vector<CheckedFeature> checked(features.rings.size());
  const PolygonOptions alone{.edges = options.edges, .tolerance_deg = options.tolerance_deg};
  const Execution one_thread{.threads = 1, .stop = execution.stop};
  const auto check = [&](std::size_t f) {
    map::PolygonFeatures one;
    one.rings.push_back(features.rings[f]);
    one.lines.resize(1);
    if (f < features.lines.size()) one.lines.front() = features.lines[f];
    for (const map::LonLatRing& ring : one.rings.front()) {
      checked[f].fault = ring.fault;
      if (!checked[f].fault.empty()) return;
    }
    try {
      FeatureCells of_one(one, alone, {}, one_thread, texts);
      if (!of_one.is_plain(checked[f], needs_cells)) of_one.check(checked[f]);
    } catch (const FeatureFault& fault) {
      checked[f].fault = fault.fault();
    }
  };
  system::parallel_for(execution.threads, checked.size(), swept_per_block,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t f = begin; f < end; ++f) check(f);
                       });
  return checked;
}

// Returns the faults of features.
std::vector<std::string> taken_faults(std::span<CheckedFeature> checked) {
  std::vector<std::string> faults;
  faults.reserve(checked.size());
  for (CheckedFeature& feature : checked) faults.push_back(std::move(feature.fault));
  return faults;
}

// Gives each file the faults of its features, if there are any.
void divide_faults(std::vector<std::string> faults, const map::PolygonFeatures& features,
                   std::vector<CellFacts>& facts) {
  if (std::ranges::all_of(faults, &std::string::empty)) return;
  auto next = faults.begin();
  for (std::size_t file = 0; file < features.files.size(); ++file) {
    const auto last = file + 1 < features.files.size()
                          ? next + static_cast<std::ptrdiff_t>(features.files[file].num_features)
                          : faults.end();
    facts[file].faults.assign(std::move_iterator(next), std::move_iterator(last));
    next = last;
  }
}

// Converts features, and repairs them if that is wanted.
ConvertedFeatures with_repairs(map::PolygonFeatures& features, const PolygonOptions& options,
                               FaultTexts texts, const Execution& execution) {
  const auto converted = [&](std::span<const CheckedFeature> checked) {
    FeatureCells make(features, options, checked, execution);
    CellRings cells = make();
    return ConvertedFeatures{std::move(cells), std::move(make.sides()), std::move(make.lines()),
                             std::move(make.facts())};
  };
  features.lines.resize(features.rings.size());
  if (options.invalid == InvalidPolygons::error) return converted({});
  std::vector<CheckedFeature> checked = checked_features(features, options, true, texts, execution);
  const auto given = std::pair(features.rings, features.lines);
  for (;;) {
    // A feature that is valid alone may become invalid by corners of others on its sides.
    try {
      ConvertedFeatures result = converted(checked);
      divide_faults(taken_faults(checked), features, result.facts);
      return result;
    } catch (const FeatureFault& fault) {
      const bool is_told = !checked[fault.feature()].fault.empty();  // that it cannot be repaired
      if (is_told && texts == FaultTexts::full) throw;
      std::tie(features.rings, features.lines) = given;
      if (is_told) return with_repairs(features, options, FaultTexts::full, execution);
      checked[fault.feature()].fault = fault.fault();
    }
  }
}

}  // namespace

ConvertedFeatures converted_features(map::PolygonFeatures& features, const PolygonOptions& options,
                                     const Execution& execution) {
  // Conversion divides sides, and tells some to go the shorter way.
  std::vector<LongSide> sides;
  if (options.edges == PolygonEdges::lonlat) sides = long_sides(features);
  ConvertedFeatures result = with_repairs(features, options, FaultTexts::full, execution);
  tell_of_long_sides(sides, features, result.facts);
  return result;
}

CellRings cells_of_features(map::PolygonFeatures& features, const PolygonOptions& options,
                            const Execution& execution) {
  return with_repairs(features, options, FaultTexts::brief, execution).cells;
}

std::vector<std::string> faults_of_features(const map::PolygonFeatures& features,
                                            const PolygonOptions& options,
                                            const Execution& execution) {
  std::vector<CheckedFeature> checked =
      checked_features(features, options, false, FaultTexts::full, execution);
  return taken_faults(checked);
}

}  // namespace rondel::overlay
namespace rondel {

std::string feature_name(std::span<const Column> columns, std::size_t feature) {
  std::string text = std::to_string(feature);
  for (const Column& column : columns) {
    if (column.name != "name" && column.name != "NAME") continue;
    const std::uint64_t begin = feature == 0 ? 0 : column.ends[feature - 1];
    if (column.ends[feature] == begin) continue;
    return text + " (" + column.text.substr(begin, column.ends[feature] - begin) + ')';
  }
  return text;
}

}  // namespace rondel
