// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Very many small shapes as pixels. A drawing library takes each for a shape that may be large.
///
/// A shape covers a share of each pixel, and what was painted before shines through the rest:
///
///     pixel <- pixel (1 - share * alpha) + color (share * alpha)
///
/// The share is the area itself. With F(x, y) the area of the shape in row y to the left of x, that is by
/// Green's formula a sum over its edges: an edge that rises by dy within a pixel, at the distance m from
/// the pixel's left side in the mean, adds dy (1 - m) to this pixel and dy to all pixels on its right.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "globe.h"
#include "plot_color.h"

namespace rondel::cli {

/// Some rows of a square layer, transparent at first. Places are in pixels, from the corner at the top
/// left of the whole layer on.
class Pixels {
 public:
  /// The rows from `first_row` to before `past_row`.
  Pixels(int size, int first_row, int past_row);

  [[nodiscard]] int first_row() const noexcept { return first_row_; }
  [[nodiscard]] int past_row() const noexcept { return past_row_; }

  /// Paints a polygon without holes. What lies outside the whole layer is moved to its border. Which
  /// rows these are changes nothing in a row. A polygon with a corner that is not finite is none.
  void fill(std::span<const Spot> polygon, const Color& color);

  /// A row as Cairo's ARGB32: alpha in the highest byte, the other components multiplied by it.
  void copy_row(int row, std::span<std::uint32_t> argb) const;

 private:
  /// The pixels that a shape touches.
  struct Window {
    int left, top, columns, rows;
  };

  void add_edge(const Window& window, const Spot& from, const Spot& to);
  [[nodiscard]] double* sums_of(const Window& window, int row, int column);

  int size_, first_row_, past_row_;
  std::vector<std::array<float, 4>> colors_;  // red, green, blue times alpha, and alpha
  std::vector<Spot> corners_;                 // of the shape at hand
  std::vector<double> sums_;                  // of its window, with a column more
};

/// Paints curves on a layer: the lines of a path, or its area.
class PixelPen final : public Pen {
 public:
  /// The unit disc has this center and radius on the layer.
  PixelPen(Pixels& pixels, double center, double radius)
      : pixels_(pixels), center_(center), radius_(radius) {}

  void move_to(Spot to) override;
  void line_to(Spot to) override;
  void curve_to(Spot control1, Spot control2, Spot to) override;

  /// Whether nothing of the arc, with a line of this width, is in the rows of the pixels.
  [[nodiscard]] bool is_elsewhere(const Point& a, const Point& b, double width) const;
  /// The same for a disc around a place.
  [[nodiscard]] bool is_elsewhere(Spot center, double radius) const;

  /// Each paints the path and ends it. Lines end where their middle does.
  void stroke(const Color& color, double width);
  /// One path, and half of `rim` around it.
  void fill(const Color& color, double rim);
  /// A disc of this radius, in pixels.
  void dot(Spot center, double radius, const Color& color);

 private:
  [[nodiscard]] Spot place(Spot spot) const {
    return {center_ + radius_ * spot.x, center_ - radius_ * spot.y};
  }

  Pixels& pixels_;
  double center_, radius_;
  std::vector<Spot> path_;           // in pixels
  std::vector<std::size_t> starts_;  // of its parts
  std::vector<Spot> outline_;
};

}  // namespace rondel::cli
