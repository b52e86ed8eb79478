// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "plot_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "globe.h"

namespace rondel::cli {
namespace {

constexpr Color bar_text_color{0.06, 0.06, 0.08};
constexpr Color bar_end_color{0.36, 0.42, 0.48};

Point cross_product(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double dot_product(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

double squared_chord(const Point& a, const Point& b) {
  const Point d{a.x - b.x, a.y - b.y, a.z - b.z};
  return dot_product(d, d);
}

// Returns the color in Cairo's format ARGB32.
std::uint32_t opaque(const Color& color) {
  const auto byte = [](double c) {
    return static_cast<std::uint32_t>(std::lround(255 * std::clamp(c, 0.0, 1.0)));
  };
  return 0xff00'0000U | byte(color.red) << 16U | byte(color.green) << 8U | byte(color.blue);
}

// The colors of a scale in steps that are too small to be seen.
class ColorTable {
 public:
  explicit ColorTable(const ValueScale& scale) : scale_(scale) {
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      const double t = static_cast<double>(i) / last;
      colors_[i] = opaque(value_color(t));
    }
  }
  [[nodiscard]] std::uint32_t at(double value) const {
    const double range = scale_.most - scale_.least;
    const double t = range > 0 ? (value - scale_.least) / range : 0.5;
    return colors_[static_cast<std::size_t>(std::lround(std::clamp(t, 0.0, 1.0) * last))];
  }

 private:
  const ValueScale& scale_;
  static constexpr int last = 1023;
  std::array<std::uint32_t, last + 1> colors_;
};

// A face in the view frame: a unit vector u has the weights dot(u, normals[i]) at its corners.
struct FaceInView {
  std::array<Point, 3> normals;
  std::array<double, 3> values;
};

class FieldPainter {
 public:
  FieldPainter(const ValueScale& scale, int size, double radius, int first_row, int past_row,
               std::span<std::uint32_t> argb)
      : colors_(scale),
        size_(size),
        radius_(radius),
        first_row_(first_row),
        past_row_(past_row),
        argb_(argb) {}

  void add(const ValueField& field, const Triple& face) {
    std::array<Point, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = field.sites[face[i]];
    const auto& [a, b, c] = corners;
    if (a.z < 0 && b.z < 0 && c.z < 0) return;
    // The face bulges out from its chords, by no more than this.
    const double reach =
        std::max({squared_chord(a, b), squared_chord(b, c), squared_chord(c, a)}) / 2;
    const double middle = size_ / 2.0;
    const auto pixels = [&](double low, double high, int begin, int end) {
      const double from = middle + radius_ * (low - reach) - 2;
      const double to = middle + radius_ * (high + reach) + 2;
      return std::pair(static_cast<int>(std::clamp<double>(from, begin, end)),
                       static_cast<int>(std::clamp<double>(to, begin, end)));
    };
    const auto [top, bottom] =
        pixels(-std::max({a.y, b.y, c.y}), -std::min({a.y, b.y, c.y}), first_row_, past_row_);
    if (top == bottom) return;
    const auto [left, right] =
        pixels(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), 0, size_);
    FaceInView in_view{{cross_product(b, c), cross_product(c, a), cross_product(a, b)},
                       {field.values[face[0]], field.values[face[1]], field.values[face[2]]}};
    for (int row = top; row < bottom; ++row) add_row(in_view, row, left, right);
  }

 private:
  void add_row(const FaceInView& face, int row, int left, int right) {
    const double y = (size_ / 2.0 - row - 0.5) / radius_;
    for (int column = left; column < right; ++column) {
      const double x = (column + 0.5 - size_ / 2.0) / radius_;
      const double square = x * x + y * y;
      if (square > rim_ * rim_) continue;
      // A pixel that the limb cuts has the color of the limb.
      const double shrunk = square > 1 ? 1 / std::sqrt(square) : 1;
      const Point u{x * shrunk, y * shrunk, std::sqrt(std::max(0.0, 1 - square))};
      std::array<double, 3> weights{};
      double sum = 0;
      double value = 0;
      bool is_inside = true;
      for (std::size_t i = 0; i < 3; ++i) {
        weights[i] = dot_product(u, face.normals[i]);
        is_inside = is_inside && weights[i] >= 0;
        sum += weights[i];
        value += weights[i] * face.values[i];
      }
      if (!is_inside || sum <= 0) continue;
      const auto at = static_cast<std::size_t>(row - first_row_) * static_cast<std::size_t>(size_) +
                      static_cast<std::size_t>(column);
      argb_[at] = colors_.at(value / sum);
    }
  }

  ColorTable colors_;
  int size_;
  double radius_;
  int first_row_;
  int past_row_;
  std::span<std::uint32_t> argb_;
  double rim_ = 1 + 0.75 / radius_;
};

std::string text_of(double value, int digits) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value + 0.0);
  return text.data();
}

}  // namespace

Color ValueScale::color(double value) const {
  return value_color(most > least ? (value - least) / (most - least) : 0.5);
}

ValueScale scale_of(std::span<const double> values, const std::string& name) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  if (most < least) return {0, 0, name};
  return {least, most, name};
}

void paint_field(const ValueField& field, const ValueScale& scale, int size, double radius,
                 int first_row, int past_row, std::span<std::uint32_t> argb) {
  FieldPainter painter(scale, size, radius, first_row, past_row, argb);
  for (const Triple& face : field.faces) painter.add(field, face);
}

std::vector<double> round_values(double least, double most) {
  if (!(least < most) || !std::isfinite(most - least)) return {};
  constexpr double marks = 5;
  const double rough = (most - least) / marks;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double factor = rough / power;
  const double step = power * (factor < 1.5 ? 1 : factor < 3.5 ? 2 : factor < 7.5 ? 5 : 10);
  if (!(step > 0)) return {};
  std::vector<double> values;
  for (double k = std::ceil(least / step); k * step <= most; ++k) values.push_back(k * step);
  return values;
}

int bar_height(int size) { return static_cast<int>(std::lround(0.13 * size)); }

// The bar takes the middle three fifths of the width; the ends of the range are written beside it.
void draw_bar(Canvas& canvas, const ValueScale& scale, int size) {
  const double left = 0.2 * size;
  const double width = 0.6 * size;
  const double top = 1.005 * size;
  const double height = 0.028 * size;
  const double letters = 0.024 * size;
  const int steps = 256;
  for (int i = 0; i < steps; ++i) {
    const double x = left + width * i / steps;
    canvas.box(x, top, left + width - x, height);  // up to the end, so that no seam shows
    canvas.fill(value_color((i + 0.5) / steps));
  }
  canvas.box(left, top, width, height);
  canvas.stroke(bar_end_color, 0.001 * size);
  const double base = top + height / 2 + 0.36 * letters;
  canvas.text(text_of(scale.least, 4), left - 0.5 * letters, base, letters, TextAlign::right,
              bar_end_color);
  canvas.text(text_of(scale.most, 4), left + width + 0.5 * letters, base, letters, TextAlign::left,
              bar_end_color);
  for (const double value : round_values(scale.least, scale.most)) {
    const double x = left + width * ((value - scale.least) / (scale.most - scale.least));
    canvas.box(x - 0.0006 * size, top + height, 0.0012 * size, 0.008 * size);
    canvas.fill(bar_text_color);
    const bool is_zero = std::abs(value) < 1e-9 * (scale.most - scale.least);
    canvas.text(is_zero ? "0" : text_of(value, 6), x, top + height + 0.012 * size + letters,
                letters, TextAlign::center, bar_text_color);
  }
  canvas.text(scale.name, left + width / 2, top + height + 0.022 * size + 2.2 * letters,
              1.1 * letters, TextAlign::center, bar_text_color);
}

}  // namespace rondel::cli
