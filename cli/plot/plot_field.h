// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Draws values on the globe as colors, pixel by pixel, and the bar that explains the colors.
///
/// in    values at sites, and the faces of their triangulation in the view frame (globe.h)
/// out   pixels in Cairo's format ARGB32, row by row from the top
/// index sites for values; faces refer to sites
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plot_canvas.h"
#include "plot_color.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::cli {

/// Maps values to the colors of value_color(), from the least to the largest value.
struct ValueScale {
  double least = 0;
  double most = 0;
  std::string name;  ///< of the column

  /// Returns the place of a value in the range, from 0 to 1; 0.5 if the range is one number. The
  /// range may exceed the largest double.
  [[nodiscard]] double place(double value) const;
  /// Returns the color of a value, which must not be NaN.
  [[nodiscard]] Color color(double value) const;
};

/// Returns the scale of the values that are not NaN; it is 0 to 0 if there are none.
ValueScale scale_of(std::span<const double> values, const std::string& name);

/// A field that is linear in the plane of each face, seen from the center.
struct ValueField {
  std::vector<Point> sites;    ///< unit vectors in the view frame
  std::vector<double> values;  ///< by site
  std::vector<Triple> faces;   ///< solid faces whose corners all have values
};

/// Colors the pixels whose middle is in a face, in rows first_row ... past_row - 1 of a square
/// picture of `size`. `argb` has these rows, which are transparent at first.
/// \param radius  the radius of the globe in pixels; its center is the middle of the picture
void paint_field(const ValueField& field, const ValueScale& scale, int size, double radius,
                 int first_row, int past_row, std::span<std::uint32_t> argb);

/// Returns the values at which a bar has marks: about five round numbers in [least, most].
std::vector<double> round_values(double least, double most);

/// Returns texts of numbers, all with the same number of significant digits: at least `digits`, and
/// up to 12 until none is off by more than a hundredth of `range`.
std::vector<std::string> texts_within(std::span<const double> values, double range, int digits);

/// Returns the height that a bar needs below a picture of `size`, in pixels.
int bar_height(int size);

/// Draws the bar below the globe: colors, least and largest value, marks and name.
void draw_bar(Canvas& canvas, const ValueScale& scale, int size);

}  // namespace rondel::cli
