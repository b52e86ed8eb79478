// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "plot_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rondel::cli {
namespace {

// A color in Oklab coordinates: lightness, green to red, and blue to yellow.
struct Oklab {
  double lightness, a, b;
};

// The transfer function of sRGB (IEC 61966-2-1) and its inverse.
double to_linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double from_linear(double c) {
  const double clipped = std::clamp(c, 0.0, 1.0);
  return clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * std::pow(clipped, 1 / 2.4) - 0.055;
}

// The matrices of Ottosson's article: linear sRGB to cones, whose cube roots are mixed to Oklab.
Oklab to_oklab(const Color& color) {
  const double r = to_linear(color.red), g = to_linear(color.green), b = to_linear(color.blue);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

// The inverse of to_oklab(); components outside of sRGB are clipped.
Color to_color(const Oklab& lab, double alpha) {
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(lab.lightness + 0.3963377774 * lab.a + 0.2158037573 * lab.b);
  const double m = cube(lab.lightness - 0.1055613458 * lab.a - 0.0638541728 * lab.b);
  const double s = cube(lab.lightness - 0.0894841775 * lab.a - 1.2914855480 * lab.b);
  return {from_linear(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          from_linear(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          from_linear(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s), alpha};
}

// Colors at t = 0, 1/3, 2/3 and 1; between them blend() is used.
constexpr std::array<Color, 4> area_stops{
    {{0.090, 0.180, 0.380}, {0.155, 0.455, 0.560}, {0.560, 0.770, 0.680}, {0.985, 0.960, 0.860}}};

}  // namespace

Color blend(const Color& a, const Color& b, double t) {
  const Oklab from = to_oklab(a), to = to_oklab(b);
  return to_color({std::lerp(from.lightness, to.lightness, t), std::lerp(from.a, to.a, t),
                   std::lerp(from.b, to.b, t)},
                  std::lerp(a.alpha, b.alpha, t));
}

Color area_color(double t) {
  const double place = std::clamp(t, 0.0, 1.0) * (area_stops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(place), area_stops.size() - 2);
  return blend(area_stops[stop], area_stops[stop + 1], place - static_cast<double>(stop));
}

Color value_color(double t) {
  // The coefficients of t^0 to t^6.
  constexpr std::array<Color, 7> powers{{{0.2777273272, 0.0054073445, 0.3340998053},
                                         {0.1050930431, 1.4046135299, 1.3845901626},
                                         {-0.3308618287, 0.2148475595, 0.0950951630},
                                         {-4.6342304990, -5.7991009734, -19.3324409563},
                                         {6.2282699363, 14.1799333668, 56.6905526007},
                                         {4.7763849977, -13.7451453777, -65.3530326334},
                                         {-5.4354558559, 4.6458526122, 26.3124352496}}};
  const double place = std::clamp(t, 0.0, 1.0);
  Color color{0, 0, 0};
  for (std::size_t i = powers.size(); i-- > 0;) {
    color.red = color.red * place + powers[i].red;
    color.green = color.green * place + powers[i].green;
    color.blue = color.blue * place + powers[i].blue;
  }
  const auto clipped = [](double c) { return std::clamp(c, 0.0, 1.0); };
  return {clipped(color.red), clipped(color.green), clipped(color.blue)};
}

}  // namespace rondel::cli
