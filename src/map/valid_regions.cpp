// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/valid_regions.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "map/line_troubles.h"
#include "map/mending.h"
#include "map/planar_loops.h"
#include "map/settled_regions.h"
#include "map/shared_lines.h"
#include "system/parallel.h"

namespace rondel::map {
namespace {

constexpr std::size_t regions_per_task = 16;
constexpr int max_mending_passes = 40;
// Bounds the changes: so many for each position of the regions, and some more. Lines that are
// bisected forever would fill the memory.
constexpr std::size_t max_changes_of_position = 8;
constexpr std::size_t max_changes_besides = 1 << 12;

// Knows which regions have a position.
class PositionOwners {
 public:
  explicit PositionOwners(std::span<const LoopsOfRegion> regions) {
    for (std::size_t i = 0; i < regions.size(); ++i) {
      for (const Loop& loop : regions[i]) {
        for (const LonLat& p : loop) all_.push_back({p, i});
      }
    }
    std::ranges::sort(all_, is_before);
  }

  [[nodiscard]] std::set<std::size_t> of(const LonLat& p) const {
    std::set<std::size_t> owners;
    const auto less = InPlane();
    for (auto owned = std::ranges::lower_bound(all_, p, less, &OwnedPosition::position);
         owned != all_.end() && owned->position == p; ++owned) {
      owners.insert(owned->region);
    }
    if (const auto more = more_.find(p); more != more_.end())
      owners.insert(more->second.begin(), more->second.end());
    return owners;
  }

  void add(const LonLat& p, const std::set<std::size_t>& owners) {
    more_[p].insert(owners.begin(), owners.end());
  }

  // Adds the starts of a region's sides. A line that a region gets may have been divided before.
  void add_starts(std::span<const DirectedLine> sides, std::size_t region) {
    for (const DirectedLine& side : sides) {
      if (!has_first(side.from, region)) more_[side.from].insert(region);
    }
  }

 private:
  struct OwnedPosition {
    LonLat position;
    std::size_t region;
  };
  static bool is_before(const OwnedPosition& x, const OwnedPosition& y) {
    return x.position == y.position ? x.region < y.region : InPlane()(x.position, y.position);
  }

  // True if a region had a position from the beginning.
  [[nodiscard]] bool has_first(const LonLat& p, std::size_t region) const {
    return std::ranges::binary_search(all_, OwnedPosition{p, region}, is_before);
  }

  std::vector<OwnedPosition> all_;
  std::map<LonLat, std::set<std::size_t>, InPlane> more_;
};

class RegionsInPlane {
 public:
  RegionsInPlane(std::vector<LoopsOfRegion> regions, unsigned threads)
      : regions_(std::move(regions)), threads_(threads) {
    regions_.push_back(outside_loops(regions_));
    looks_.resize(regions_.size());
    memories_.resize(regions_.size());
  }

  std::vector<PolygonsOfRegion> made_valid(bool may_overlap) {
    std::vector<std::size_t> open(regions_.size());
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = i;
    const std::size_t limit = max_changes();
    for (int pass = 0; pass < max_mending_passes && num_changes_ <= limit; ++pass) {
      look_at(open);
      std::erase_if(open, [&](std::size_t i) { return looks_[i].troubles.empty(); });
      if (open.empty()) return may_overlap ? settled() : looked_at();
      std::set<std::size_t> changed = mend(open, pass);
      if (changed.empty() && reach_of_pass(pass) == longest_reach) break;
      changed.insert(open.begin(), open.end());
      open.assign(changed.begin(), changed.end());
    }
    return settled();
  }

 private:
  void look_at(std::span<const std::size_t> open) {
    // Few regions may be large.
    constexpr std::size_t few = 64;
    system::parallel_for(threads_, open.size(), open.size() < few ? 1 : regions_per_task,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t k = begin; k < end; ++k) {
                             const std::size_t i = open[k];
                             looks_[i] =
                                 look_at_region(regions_[i], lines_, memories_[i], threads_);
                           }
                         });
    if (!owners_) return;
    for (const std::size_t i : open) owners_->add_starts(memories_[i].sides, i);
  }

  [[nodiscard]] std::size_t max_changes() const {
    std::size_t num_positions = 0;
    for (const LoopsOfRegion& loops : regions_) {
      for (const Loop& loop : loops) num_positions += loop.size();
    }
    return max_changes_of_position * num_positions + max_changes_besides;
  }

  // Mends the troubles of the open regions, and returns all regions that this changes.
  std::set<std::size_t> mend(std::span<const std::size_t> open, int pass) {
    if (!owners_) owners_.emplace(regions_);
    Mending mending(lines_, pass);
    for (const std::size_t i : open) {
      for (const Trouble& trouble : looks_[i].troubles) mending.mend(trouble);
    }
    num_changes_ += mending.changes().size();
    std::set<std::size_t> changed;
    for (const Mending::Change& change : mending.changes()) {
      const std::set<std::size_t> at_a = owners_->of(change.a);
      const std::set<std::size_t> at_b = owners_->of(change.b);
      std::set<std::size_t> owners;
      if (change.is_merge) {
        owners = at_a;
        owners.insert(at_b.begin(), at_b.end());
      } else {
        std::ranges::set_intersection(at_a, at_b, std::inserter(owners, owners.end()));
      }
      owners_->add(change.position, owners);
      changed.insert(owners.begin(), owners.end());
    }
    return changed;
  }

  std::vector<PolygonsOfRegion> looked_at() {
    std::vector<PolygonsOfRegion> polygons;
    polygons.reserve(looks_.size());
    for (RegionLook& look : looks_) polygons.push_back(std::move(look.polygons));
    return polygons;
  }

  [[nodiscard]] std::vector<PolygonsOfRegion> settled() const {
    // Changes without end may have led lines astray, so then the regions are settled as they were
    // given.
    const SharedLines unchanged;
    const SharedLines& lines = num_changes_ > max_changes() ? unchanged : lines_;
    std::vector<std::vector<DirectedLine>> sides(regions_.size());
    for (std::size_t i = 0; i < regions_.size(); ++i) {
      for (const Loop& loop : regions_[i]) lines.append_sides(loop, sides[i]);
    }
    return settled_regions(sides, threads_);
  }

  // The given regions, and the part of the map outside of all of them.
  std::vector<LoopsOfRegion> regions_;
  unsigned threads_;
  std::size_t num_changes_ = 0;
  std::vector<RegionLook> looks_;
  std::vector<RegionMemory> memories_;
  SharedLines lines_;
  std::optional<PositionOwners> owners_;
};

}  // namespace

std::vector<PolygonsOfRegion> valid_regions(std::vector<LoopsOfRegion> regions, unsigned threads,
                                            bool may_overlap) {
  std::vector<PolygonsOfRegion> polygons =
      RegionsInPlane(std::move(regions), threads).made_valid(may_overlap);
  polygons.pop_back();
  return polygons;
}

}  // namespace rondel::map
