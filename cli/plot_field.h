// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Values on the globe as colors, pixel by pixel, and the bar that says what they mean.
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

/// From values to the colors of value_color(): from the least to the largest one.
struct ValueScale {
  double least = 0;
  double most = 0;
  std::string name;  ///< of the column

  [[nodiscard]] Color color(double value) const;
};

/// Of the numbers among the values; 0 to 0 if there are none.
ValueScale scale_of(std::span<const double> values, const std::string& name);

/// A field that is linear in the plane of each face, seen from the center.
struct ValueField {
  std::vector<Point> sites;    ///< unit vectors in the view frame
  std::vector<double> values;  ///< of the sites
  std::vector<Triple> faces;   ///< solid ones, all of whose corners have values
};

/// Colors the pixels whose middle is in a face, some rows of a square picture of `size`. `argb` are these rows,
/// transparent at first.
void paint_field(const ValueField& field, const ValueScale& scale, int size, double radius,
                 int first_row, int past_row, std::span<std::uint32_t> argb);

/// The values at which a bar has marks: about five round ones in [least, most].
std::vector<double> round_values(double least, double most);

/// What a bar needs below a picture of `size`, in pixels.
int bar_height(int size);

/// Draws the bar below the globe: the colors, the least and the largest value, marks, the name.
void draw_bar(Canvas& canvas, const ValueScale& scale, int size);

}  // namespace rondel::cli
