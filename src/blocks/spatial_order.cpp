// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "blocks/spatial_order.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "blocks/cube_position.h"
#include "blocks/hilbert.h"
#include "blocks/radix_sort.h"
#include "predicates/ray_order.h"
#include "system/huge_pages.h"

namespace rondel::blocks {
namespace {

class Ordering {
 public:
  Ordering(std::span<const Point> sites, Model model, const Point& center)
      : sites_(sites), model_(model), center_(center) {}

  SpatialOrder run() {
    KeyedIndices data;
    system::reserve_large(data.keys, sites_.size());
    system::reserve_large(data.indices, sites_.size());
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      data.keys.push_back(key(static_cast<Index>(i)).high);
      data.indices.push_back(static_cast<Index>(i));
    }
    radix_sort(data, 3 + 2 * high_levels);
    result_.order.reserve(sites_.size());
    for (std::size_t i = 0; i < data.keys.size();) {
      std::size_t end = i + 1;
      while (end < data.keys.size() && data.keys[end] == data.keys[i]) ++end;
      if (end - i == 1) {
        result_.order.push_back(data.indices[i]);
      } else {
        order_close_sites({data.indices.data() + i, end - i});
      }
      i = end;
    }
    std::ranges::sort(result_.duplicates, {}, &Duplicate::site);
    return std::move(result_);
  }

 private:
  struct Entry {
    std::uint64_t low_key;
    Index site;
  };

  [[nodiscard]] HilbertKey key(Index i) const { return place_key(sites_[i], model_, center_); }

  [[nodiscard]] bool is_lexicographically_less(Index i, Index j) const {
    const Point& a = sites_[i];
    const Point& b = sites_[j];
    return std::tie(a.x, a.y, a.z, i) < std::tie(b.x, b.y, b.z, j);
  }

  [[nodiscard]] Sign compare_places(Index i, Index j) const {
    if (model_ == Model::projected) {
      return predicates::compare_rays(sites_[i], sites_[j], center_);
    }
    const auto order = std::tie(sites_[i].x, sites_[i].y, sites_[i].z) <=>
                       std::tie(sites_[j].x, sites_[j].y, sites_[j].z);
    return order < 0 ? Sign::negative : (order > 0 ? Sign::positive : Sign::zero);
  }

  // Sites whose high keys agree: by low key, and where these agree too by place, so
  // that duplicates meet, with the lexicographically smallest in front.
  void order_close_sites(std::span<const Index> group) {
    std::vector<Entry> entries;
    entries.reserve(group.size());
    for (const Index i : group) entries.push_back({key(i).low, i});
    std::ranges::sort(entries, [this](const Entry& a, const Entry& b) {
      if (a.low_key != b.low_key) return a.low_key < b.low_key;
      const Sign places = compare_places(a.site, b.site);
      if (places != Sign::zero) return places == Sign::negative;
      return is_lexicographically_less(a.site, b.site);
    });
    for (std::size_t i = 0; i < entries.size();) {
      std::size_t end = i + 1;
      while (end < entries.size() && entries[end].low_key == entries[i].low_key) ++end;
      append_cell({entries.data() + i, end - i});
      i = end;
    }
  }

  // Sites with one full key: merges duplicates, then orders the places lexicographically.
  void append_cell(std::span<const Entry> cell) {
    const std::size_t first_rank = result_.order.size();
    std::vector<Duplicate> names;  // {site whose coordinates count, lowest index}
    for (std::size_t i = 0; i < cell.size();) {
      std::size_t end = i + 1;
      while (end < cell.size() && compare_places(cell[i].site, cell[end].site) == Sign::zero) ++end;
      const auto place = cell.subspan(i, end - i);
      const Index lowest = std::ranges::min(place, {}, &Entry::site).site;
      for (const Entry& e : place) {
        if (e.site != lowest) result_.duplicates.push_back({e.site, lowest});
      }
      names.push_back({cell[i].site, lowest});
      i = end;
    }
    std::ranges::sort(names, [this](const Duplicate& a, const Duplicate& b) {
      return is_lexicographically_less(a.site, b.site);
    });
    for (std::size_t i = 0; i < names.size(); ++i) {
      result_.order.push_back(names[i].site);
      if (names[i].site == names[i].representative) continue;
      const auto rank = static_cast<Index>(first_rank + i);
      result_.renamed.push_back({rank, names[i].representative});
    }
  }

  std::span<const Point> sites_;
  Model model_;
  Point center_;
  SpatialOrder result_;
};

}  // namespace

// Rounded differences from a center would give sites on one ray different keys.
HilbertKey place_key(const Point& p, Model model, const Point& center) {
  const bool is_rounding_harmless = model == Model::weighted || center == Point{};
  return hilbert_key(is_rounding_harmless ? cube_position(p, center)
                                          : exact_cube_position(p, center));
}

SpatialOrder spatial_order(std::span<const Point> sites, Model model, const Point& center) {
  return Ordering(sites, model, center).run();
}

}  // namespace rondel::blocks
