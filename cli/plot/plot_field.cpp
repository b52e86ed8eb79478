// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "plot_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "globe.h"

namespace rondel::cli {
namespace {

// The colors of the texts and marks below the bar, and of its outline and the texts beside it.
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
  ColorTable() {
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      const double t = static_cast<double>(i) / last;
      colors_[i] = opaque(value_color(t));
    }
  }
  // Returns the color at a place of the scale, which rounding may have moved beyond its ends.
  [[nodiscard]] std::uint32_t at(double t) const {
    return colors_[static_cast<std::size_t>(std::lround(std::clamp(t, 0.0, 1.0) * last))];
  }

 private:
  static constexpr int last = 1023;
  std::array<std::uint32_t, last + 1> colors_;
};

// A face in the view frame: a unit vector u has the weights dot(u, normals[i]) at its corners. The
// values are places in the scale, whose sums are finite.
struct FaceInView {
  std::array<Point, 3> normals;
  std::array<double, 3> places;
};

// Paints faces into some rows of the picture.
class FieldPainter {
 public:
  FieldPainter(const ValueScale& scale, int size, double radius, int first_row, int past_row,
               std::span<std::uint32_t> argb)
      : scale_(scale),
        size_(size),
        radius_(radius),
        first_row_(first_row),
        past_row_(past_row),
        argb_(argb) {}

  // Paints the pixels of one face: it looks at all pixels of the rectangle around the face.
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
                       {scale_.place(field.values[face[0]]), scale_.place(field.values[face[1]]),
                        scale_.place(field.values[face[2]])}};
    for (int row = top; row < bottom; ++row) add_row(in_view, row, left, right);
  }

 private:
  // Colors the pixels of a row whose middle, lifted to the sphere, is in the face.
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
      double place = 0;
      bool is_inside = true;
      for (std::size_t i = 0; i < 3; ++i) {
        weights[i] = dot_product(u, face.normals[i]);
        is_inside = is_inside && weights[i] >= 0;
        sum += weights[i];
        place += weights[i] * face.places[i];
      }
      if (!is_inside || sum <= 0) continue;
      const auto at = static_cast<std::size_t>(row - first_row_) * static_cast<std::size_t>(size_) +
                      static_cast<std::size_t>(column);
      argb_[at] = colors_.at(place / sum);
    }
  }

  ColorTable colors_;
  const ValueScale& scale_;
  int size_;
  double radius_;
  int first_row_;
  int past_row_;
  std::span<std::uint32_t> argb_;
  double rim_ = 1 + 0.75 / radius_;
};

// Returns a number with so many significant digits; -0 is written as 0.
std::string text_of(double value, int digits) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value + 0.0);
  return text.data();
}

// Returns how many marks apart the texts must be that they do not touch each other.
std::size_t marks_per_text(const std::vector<std::string>& texts, double spacing, double letters) {
  std::size_t longest = 0;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  const double width = 0.6 * letters * static_cast<double>(longest + 1);
  return static_cast<std::size_t>(std::max(1.0, std::ceil(width / spacing)));
}

}  // namespace

double ValueScale::place(double value) const {
  if (!(most > least)) return 0.5;
  if (std::isfinite(most - least)) return (value - least) / (most - least);
  return (value / 2 - least / 2) / (most / 2 - least / 2);
}

Color ValueScale::color(double value) const { return value_color(place(value)); }

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
  if (!(least < most)) return {};
  constexpr double marks = 5;
  // The steps of a scale are 1, 2 or 5 times a power of ten.
  const double rough = most / marks - least / marks;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double factor = rough / power;
  const double step = power * (factor < 1.5 ? 1 : factor < 3.5 ? 2 : factor < 7.5 ? 5 : 10);
  if (!(step > 0)) return {};
  std::vector<double> values;
  for (double k = std::ceil(least / step); k * step <= most; ++k) values.push_back(k * step);
  return values;
}

std::vector<std::string> texts_within(std::span<const double> values, double range, int digits) {
  constexpr int max_digits = 12;  // as many as there is room for beside the bar
  std::vector<std::string> texts;
  for (; digits <= max_digits; ++digits) {
    texts.clear();
    bool are_close = true;
    for (const double value : values) {
      texts.push_back(text_of(value, digits));
      are_close &= std::abs(std::strtod(texts.back().c_str(), nullptr) - value) <= range / 100;
    }
    if (are_close || !(range > 0)) break;
  }
  return texts;
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
  const double range = scale.most / 2 - scale.least / 2;  // half of it, which is finite
  const std::vector<std::string> ends = texts_within(std::array{scale.least, scale.most}, range, 4);
  canvas.text(ends[0], left - 0.5 * letters, base, letters, TextAlign::right, bar_end_color);
  canvas.text(ends[1], left + width + 0.5 * letters, base, letters, TextAlign::left, bar_end_color);
  std::vector<double> marks = round_values(scale.least, scale.most);
  for (double& mark : marks) mark = std::abs(mark) < 1e-9 * range ? 0 : mark;
  const std::vector<std::string> texts = texts_within(marks, range, 6);
  const std::size_t step = marks_per_text(
      texts, marks.size() < 2 ? width : width * (scale.place(marks[1]) - scale.place(marks[0])),
      letters);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const double x = left + width * scale.place(marks[i]);
    canvas.box(x - 0.0006 * size, top + height, 0.0012 * size, 0.008 * size);
    canvas.fill(bar_text_color);
    if (i % step != 0) continue;
    canvas.text(texts[i], x, top + height + 0.012 * size + letters, letters, TextAlign::center,
                bar_text_color);
  }
  canvas.text(scale.name, left + width / 2, top + height + 0.022 * size + 2.2 * letters,
              1.1 * letters, TextAlign::center, bar_text_color);
}

}  // namespace rondel::cli
