// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Colors of figures.
///
/// in    a place t in a range, from 0 to 1; places outside of it have the color of the nearer end
/// out   a color in sRGB
#pragma once

namespace rondel::cli {

/// An sRGB color, components from 0 to 1.
struct Color {
  double red = 0;
  double green = 0;
  double blue = 0;
  double alpha = 1;
};

/// Returns a color between a (t = 0) and b (t = 1), in perceptually even steps, by Oklab
/// coordinates (Björn Ottosson, "A perceptual color space for image processing", 2020).
Color blend(const Color& a, const Color& b, double t);

/// Returns the color of a cell area: from navy for the smallest (t = 0) over teal to cream (t = 1).
/// Its lightness grows with t, so that it can be read in grey.
Color area_color(double t);

/// Returns the color of a value in the map viridis (Nathaniel Smith, Stéfan van der Walt, Eric
/// Firing, 2015; CC0): from purple for the least (t = 0) to yellow, in perceptually even steps,
/// also for color-blind people. A polynomial by Matt Zucker (CC0) is within 0.02 of its table.
Color value_color(double t);

}  // namespace rondel::cli
