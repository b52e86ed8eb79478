// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// A square picture of the globe in one of the formats that Cairo writes. The only file that knows
/// the drawing library is plot_canvas.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "globe.h"
#include "plot_color.h"

namespace rondel::cli {

enum class FigureFormat { png, svg, pdf };

enum class TextAlign { left, center, right };

/// Paths in the coordinates of the unit disc; widths and radii in pixels (points in a PDF).
class Canvas final : public Pen {
 public:
  /// `below`: what the picture is higher than wide, for a legend below the globe.
  Canvas(FigureFormat format, int size, int below = 0);
  ~Canvas() override;
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// The radius of the globe in pixels. Its center is the middle.
  [[nodiscard]] double radius() const noexcept;
  static double radius_of(int size) noexcept;

  void move_to(Spot to) override;
  void line_to(Spot to) override;
  void curve_to(Spot control1, Spot control2, Spot to) override;
  /// Adds a small disc to the path.
  void dot(Spot center, double radius);
  /// Adds the outline of the globe to the path.
  void globe();

  /// Adds a rectangle to the path, in pixels from the corner at the top left.
  void box(double left, double top, double width, double height);
  /// Writes UTF-8 at a place in pixels, in a font without serifs.
  void text(const std::string& utf8, double x, double base, double letter_size, TextAlign align,
            const Color& color);

  /// Each paints the path and ends it.
  void stroke(const Color& color, double width);
  void fill(const Color& color);
  /// Lays pixels over the whole picture, as many as it has: `argb` are their rows, as Cairo's ARGB32.
  void paint(std::span<const std::uint32_t> argb);
  /// Fills from `inner` around the place where the light falls to `outer` at the limb.
  void shade(const Color& inner, const Color& outer);
  /// Fills and covers the seam to equal neighbors by a line of the same color.
  static constexpr double seam_width = 0.6;
  void fill_to_seam(const Color& color);

  /// The bytes of the file, without dates: the same picture gives the same bytes.
  /// \throws std::runtime_error, std::bad_alloc
  std::string finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rondel::cli
