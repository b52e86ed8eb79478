// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Colors of figures.
#pragma once

namespace rondel::cli {

/// An sRGB color, components from 0 to 1.
struct Color {
  double red = 0;
  double green = 0;
  double blue = 0;
  double alpha = 1;
};

/// From a (t = 0) to b (t = 1) in even steps for the eye, in Oklab coordinates (Björn
/// Ottosson, "A perceptual color space for image processing", 2020).
Color blend(const Color& a, const Color& b, double t);

/// The color map of cell areas: navy for the smallest (t = 0), over teal, to cream (t = 1). Its
/// lightness grows with t, so it also reads in grey.
Color area_color(double t);

/// The color map of values: viridis (Nathaniel Smith, Stéfan van der Walt, Eric Firing, 2015; CC0), purple for
/// the least (t = 0) to yellow, in even steps for the eye, for color-blind people too. Within 0.02 of
/// its table: a polynomial by Matt Zucker (CC0).
Color value_color(double t);

}  // namespace rondel::cli
