// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Paints very many small shapes as pixels, since a drawing library treats each as if it might be
/// large.
///
/// A shape covers a share of each pixel, and the earlier color shows through the rest:
///
///     pixel <- pixel (1 - share * alpha) + color (share * alpha)
///
/// The share is the exact covered area. Let F(x, y) be the area of the shape in row y to the left
/// of x. By Green's formula it is a sum over the edges: an edge that rises by dy within a pixel, at
/// the mean distance m from the pixel's left side, adds dy (1 - m) to this pixel and dy to all
/// pixels on its right.
///
/// in    polygons in pixels, curves in the unit disc
/// out   rows of pixels with colors and alpha
/// index rows and columns of the whole layer, from the top left corner
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "globe.h"
#include "plot_color.h"

namespace rondel::cli {

/// Some rows of a square layer, transparent at first. Positions are in pixels from the top left
/// corner of the whole layer.
class Pixels {
 public:
  /// Makes the rows first_row ... past_row - 1.
  Pixels(int size, int first_row, int past_row);

  [[nodiscard]] int first_row() const noexcept { return first_row_; }
  [[nodiscard]] int past_row() const noexcept { return past_row_; }

  /// Paints a polygon without holes. The part outside of the whole layer is moved to its border.
  /// The content of a row does not depend on which rows this object has. A polygon with a corner
  /// that is not finite is ignored.
  void fill(std::span<const Spot> polygon, const Color& color);

  /// Copies a row in Cairo's format ARGB32: alpha in the highest byte, the other components
  /// multiplied by it.
  void copy_row(int row, std::span<std::uint32_t> argb) const;

 private:
  /// The rectangle of pixels that a shape touches.
  struct Window {
    int left, top, columns, rows;
  };

  /// Adds an edge to the sums of the window's rows.
  void add_edge(const Window& window, const Spot& from, const Spot& to);
  /// Returns the place of a pixel's sum; row and column are counted in the window.
  [[nodiscard]] double* sums_of(const Window& window, int row, int column);

  int size_, first_row_, past_row_;
  std::vector<std::array<float, 4>> colors_;  // red, green, blue times alpha, and alpha
  std::vector<Spot> corners_;                 // of the current shape
  std::vector<double> sums_;                  // of its window, with one more column
};

/// Paints curves on a layer, as lines of a path or as its area.
class PixelPen final : public Pen {
 public:
  /// The unit disc has this center (x and y) and radius on the layer, in pixels.
  PixelPen(Pixels& pixels, double center, double radius)
      : pixels_(pixels), center_(center), radius_(radius) {}

  void move_to(Spot to) override;
  void line_to(Spot to) override;
  void curve_to(Spot control1, Spot control2, Spot to) override;

  /// True if no part of the arc, drawn with this width, is in the rows of the pixels.
  [[nodiscard]] bool is_elsewhere(const Point& a, const Point& b, double width) const;
  /// True if no part of a disc is in the rows of the pixels.
  [[nodiscard]] bool is_elsewhere(Spot center, double radius) const;

  /// These paint the path and end it. Lines end without caps.
  void stroke(const Color& color, double width);
  /// Fills one path, and half of `rim` around it.
  void fill(const Color& color, double rim);
  /// Paints a disc whose radius is in pixels.
  void dot(Spot center, double radius, const Color& color);

 private:
  /// Returns a place of the unit disc in pixels; rows are counted from the top.
  [[nodiscard]] Spot place(Spot spot) const {
    return {center_ + radius_ * spot.x, center_ - radius_ * spot.y};
  }

  Pixels& pixels_;
  double center_, radius_;
  std::vector<Spot> path_;           // in pixels
  std::vector<std::size_t> starts_;  // starts of its parts
  std::vector<Spot> outline_;
};

}  // namespace rondel::cli
