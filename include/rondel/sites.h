// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The sites that a triangulation was made from and keeps.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel {

/// An immutable array of points. Copies are cheap, as they share the points.
///
/// 1. Sites(std::move(points)) takes a vector over, without a copy of its points.
/// 2. Sites(points) copies them, 24 bytes each. \throws InvalidInput if there are more than
///    max_sites points.
/// 3. Sites::view(points) refers to points of the caller, who must neither change nor free them
///    as long as anything made of these sites is in use: triangulations, locators, and their
///    copies. Sites::view(points, owner) keeps `owner` as long.
/// 4. Sites that were moved from have no points.
class RONDEL_API Sites {
 public:
  Sites() = default;
  Sites(std::vector<Point>&& points);
  Sites(const std::vector<Point>& points);
  Sites(std::span<const Point> points);
  Sites(const Sites& other) = default;
  Sites& operator=(const Sites& other) = default;
  Sites(Sites&& other) noexcept;
  Sites& operator=(Sites&& other) noexcept;
  ~Sites() = default;
  static Sites view(std::span<const Point> points, std::shared_ptr<const void> owner = nullptr);

  [[nodiscard]] std::span<const Point> points() const noexcept { return points_; }
  [[nodiscard]] std::size_t size() const noexcept { return points_.size(); }
  [[nodiscard]] const Point& operator[](std::size_t site) const { return points_[site]; }
  /// True if both have the same points; the memory may be different.
  RONDEL_API friend bool operator==(const Sites& a, const Sites& b);

 private:
  std::span<const Point> points_;
  std::shared_ptr<const void> owner_;
};

}  // namespace rondel
