// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Places of points, which may be those of a grid along axes: these are kept as axes, however many
// places they have.
//
// in    longitudes and latitudes in degrees, NaN where one is missing
// out   the place of each point
// index points: those of a grid row by row
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::formats {

// Copies share the memory.
class PlaceList {
 public:
  PlaceList() = default;
  explicit PlaceList(std::vector<LonLat> places)
      : list_(std::make_shared<const std::vector<LonLat>>(std::move(places))) {}
  explicit PlaceList(LonLatAxes axes)
      : axes_(std::make_shared<const LonLatAxes>(std::move(axes))) {}

  [[nodiscard]] std::size_t size() const {
    if (axes_) return axes_->lon_deg.size() * axes_->lat_deg.size();
    return list_ ? list_->size() : 0;
  }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] LonLat operator[](std::size_t point) const {
    if (!axes_) return (*list_)[point];
    const std::size_t slow = is_by_column_ ? axes_->lat_deg.size() : axes_->lon_deg.size();
    const std::size_t row = is_by_column_ ? point % slow : point / slow;
    const std::size_t column = is_by_column_ ? point / slow : point % slow;
    return {axes_->lon_deg[column], axes_->lat_deg[row]};
  }
  // Returns the axes of places row by row, or null.
  [[nodiscard]] const LonLatAxes* axes() const { return is_by_column_ ? nullptr : axes_.get(); }
  [[nodiscard]] std::vector<LonLat> list() const {
    std::vector<LonLat> places;
    places.reserve(size());
    for (std::size_t i = 0; i < size(); ++i) places.push_back((*this)[i]);
    return places;
  }
  // Returns the places column by column, for a grid with rows of this length.
  [[nodiscard]] PlaceList by_column(std::size_t row_length) const {
    if (axes_) {
      PlaceList turned = *this;
      turned.is_by_column_ = !is_by_column_;
      return turned;
    }
    std::vector<LonLat> places;
    const std::size_t num_rows = size() / row_length;
    for (std::size_t i = 0; i < size(); ++i) {
      places.push_back((*list_)[i % num_rows * row_length + i / num_rows]);
    }
    return PlaceList(std::move(places));
  }

  // Returns the first point whose place is not good, or size(). Longitudes and latitudes must be
  // good by themselves.
  template <class IsGood>
  [[nodiscard]] std::size_t first_not(const IsGood& is_good) const {
    if (axes_ &&
        std::ranges::all_of(axes_->lon_deg,
                            [&](double x) {
                              return is_good(LonLat{x, 0});
                            }) &&
        std::ranges::all_of(axes_->lat_deg, [&](double y) {
          return is_good(LonLat{0, y});
        })) {
      return size();
    }
    std::size_t point = 0;
    while (point < size() && is_good((*this)[point])) ++point;
    return point;
  }
  // True if the places of both are the same, one by one, as is_same(a, b) says.
  template <class IsSame>
  [[nodiscard]] bool is_same(const PlaceList& other, const IsSame& is_same) const {
    if (size() != other.size()) return false;
    if (axes_ && other.axes_ && is_by_column_ == other.is_by_column_ &&
        (axes_ == other.axes_ ||
         (axes_->lon_deg == other.axes_->lon_deg && axes_->lat_deg == other.axes_->lat_deg))) {
      return true;
    }
    std::size_t point = 0;
    while (point < size() && is_same((*this)[point], other[point])) ++point;
    return point == size();
  }

 private:
  // At most one of them.
  std::shared_ptr<const std::vector<LonLat>> list_;
  std::shared_ptr<const LonLatAxes> axes_;
  bool is_by_column_ = false;  // of axes
};

}  // namespace rondel::formats
