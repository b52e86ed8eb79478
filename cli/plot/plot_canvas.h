// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// A square picture of the globe in one of the formats that Cairo writes. Only plot_canvas.cpp uses
/// Cairo.
///
/// in    curves in the unit disc, shapes in pixels, colors
/// out   the bytes of a file: the same picture gives the same bytes
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "globe.h"
#include "plot_color.h"

namespace rondel::cli {

/// The formats of pictures: pixels, or paths in two languages.
enum class FigureFormat { png, svg, pdf };

/// The part of a text that is at its place.
enum class TextAlign { left, center, right };

/// A picture. Paths are in the coordinates of the unit disc; widths and radii are in pixels (points
/// in a PDF).
class Canvas final : public Pen {
 public:
  /// The picture is `size` wide and `size + below` high; `below` is room for a legend.
  Canvas(FigureFormat format, int size, int below = 0);
  ~Canvas() override;
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Returns the radius of the globe in pixels. Its center is the middle of the square.
  [[nodiscard]] double radius() const noexcept;
  /// Returns the radius of the globe in a picture of this size, without making one.
  static double radius_of(int size) noexcept;

  /// These three continue the path of the canvas; see Pen.
  void move_to(Spot to) override;
  void line_to(Spot to) override;
  void curve_to(Spot control1, Spot control2, Spot to) override;
  /// Adds a small disc to the path; its radius is in pixels.
  void dot(Spot center, double radius);
  /// Adds the outline of the globe to the path.
  void globe();

  /// Adds a rectangle to the path, in pixels from the corner at the top left.
  void box(double left, double top, double width, double height);
  /// Writes UTF-8 at a place in pixels, in a font without serifs.
  /// \param x  the place across, at the left end, the middle or the right end of the text
  /// \param base  the place of the base line, from the top
  /// \param letter_size  the size of the font in pixels
  void text(const std::string& utf8, double x, double base, double letter_size, TextAlign align,
            const Color& color);

  /// These two paint the path and end it.
  void stroke(const Color& color, double width);
  void fill(const Color& color);
  /// Paints pixels over the whole picture; `argb` has its rows in Cairo's format ARGB32.
  void paint(std::span<const std::uint32_t> argb);
  /// Fills the globe with colors from `inner`, where the light falls, to `outer` at the limb.
  void shade(const Color& inner, const Color& outer);
  /// Fills the path, and covers the seam to neighbors of the same color by a line of that color.
  static constexpr double seam_width = 0.6;
  void fill_to_seam(const Color& color);

  /// Returns the bytes of the file, without dates: equal pictures give equal bytes. \throws
  /// std::runtime_error, std::bad_alloc
  std::string finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rondel::cli
