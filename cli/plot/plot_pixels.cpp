// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "plot_pixels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace rondel::cli {
namespace {

// Returns the largest integer that is not greater. Precondition: the value is not negative.
int floor_of(double value) { return static_cast<int>(value); }

// Returns a component from 0 to 1 as a number from 0 to 255.
std::uint32_t byte(float value) {
  return static_cast<std::uint32_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
}

// Returns the vector from p to q turned to the right and scaled to `length`; zero if p is q.
Spot side_of(const Spot& p, const Spot& q, double length) {
  const double dx = q.x - p.x, dy = q.y - p.y;
  const double norm = std::sqrt(dx * dx + dy * dy);
  return norm > 0 ? Spot{dy / norm * length, -dx / norm * length} : Spot{};
}

}  // namespace

Pixels::Pixels(int size, int first_row, int past_row)
    : size_(size),
      first_row_(first_row),
      past_row_(past_row),
      colors_(static_cast<std::size_t>(size) * static_cast<std::size_t>(past_row - first_row)) {}

// Adds the edges to the sums of the window. In each row the sum up to a pixel is then the share of
// the pixel that the shape covers; its sign tells the orientation of the shape.
void Pixels::fill(std::span<const Spot> polygon, const Color& color) {
  if (polygon.size() < 3) return;
  const double last = size_;
  Spot low{last, last}, high{0, 0};
  corners_.clear();
  for (const Spot& spot : polygon) {
    if (!std::isfinite(spot.x) || !std::isfinite(spot.y)) return;
    const Spot inside{std::clamp(spot.x, 0.0, last), std::clamp(spot.y, 0.0, last)};
    low = {std::min(low.x, inside.x), std::min(low.y, inside.y)};
    high = {std::max(high.x, inside.x), std::max(high.y, inside.y)};
    corners_.push_back(inside);
  }
  const Window window{floor_of(low.x), floor_of(low.y), floor_of(high.x) - floor_of(low.x) + 1,
                      floor_of(high.y) - floor_of(low.y) + 1};
  const int first = std::max(window.top, first_row_);
  const int past = std::min(window.top + window.rows, past_row_);
  if (first >= past) return;
  sums_.assign(
      static_cast<std::size_t>(window.rows) * (static_cast<std::size_t>(window.columns) + 1), 0);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    add_edge(window, corners_[i], corners_[i + 1 == corners_.size() ? 0 : i + 1]);
  }
  const auto alpha = static_cast<float>(color.alpha);
  const std::array<float, 4> paint{static_cast<float>(color.red), static_cast<float>(color.green),
                                   static_cast<float>(color.blue), 1};
  const int columns = std::min(window.columns, size_ - window.left);
  for (int row = first; row < past; ++row) {
    const double* const sums = sums_of(window, row - window.top, 0);
    std::array<float, 4>* const pixels =
        colors_.data() + static_cast<std::ptrdiff_t>(row - first_row_) * size_ + window.left;
    double sum = 0;
    for (int column = 0; column < columns; ++column) {
      sum += sums[column];
      const float share = alpha * static_cast<float>(std::min(1.0, std::abs(sum)));
      std::array<float, 4>& pixel = pixels[column];
      for (std::size_t k = 0; k < 4; ++k) pixel[k] += (paint[k] - pixel[k]) * share;
    }
  }
}

double* Pixels::sums_of(const Window& window, int row, int column) {
  return sums_.data() + static_cast<std::ptrdiff_t>(row) * (window.columns + 1) + column;
}

void Pixels::add_edge(const Window& window, const Spot& from, const Spot& to) {
  if (from.y == to.y) return;
  // `middle` is the mean distance m of a piece of the edge from the left side of the pixel.
  const auto add = [](double* sums, double rise, double middle) {
    sums[0] += rise * (1 - middle);
    sums[1] += rise * middle;
  };
  const int row = floor_of(from.y), column = floor_of(from.x);
  if (row == floor_of(to.y) && column == floor_of(to.x)) {
    add(sums_of(window, row - window.top, column - window.left), to.y - from.y,
        (from.x + to.x) / 2 - column);
    return;
  }
  const bool is_down = from.y < to.y;
  const auto& [top, bottom] = is_down ? std::tie(from, to) : std::tie(to, from);
  const auto [left, right] = std::minmax(from.x, to.x);
  const double slope = (bottom.x - top.x) / (bottom.y - top.y);
  // The edge is cut at the lines between rows, and in each row at the lines between columns.
  for (int y = floor_of(top.y); y < bottom.y; ++y) {
    const double first = std::max<double>(y, top.y), past = std::min<double>(y + 1, bottom.y);
    const double a = std::clamp(top.x + (first - top.y) * slope, left, right);
    const double b = std::clamp(top.x + (past - top.y) * slope, left, right);
    const auto [low, high] = std::minmax(a, b);
    const double rise = is_down ? past - first : first - past;
    for (int x = floor_of(low); x <= high; ++x) {
      const double enter = std::max<double>(x, low), leave = std::min<double>(x + 1, high);
      const double part = high > low ? rise * (leave - enter) / (high - low) : rise;
      add(sums_of(window, y - window.top, x - window.left), part, (enter + leave) / 2 - x);
    }
  }
}

void Pixels::copy_row(int row, std::span<std::uint32_t> argb) const {
  const auto* const colors = colors_.data() + static_cast<std::ptrdiff_t>(row - first_row_) * size_;
  std::transform(colors, colors + size_, argb.begin(), [](const std::array<float, 4>& color) {
    return byte(color[3]) << 24U | byte(color[0]) << 16U | byte(color[1]) << 8U | byte(color[2]);
  });
}

void PixelPen::move_to(Spot to) {
  starts_.push_back(path_.size());
  path_.push_back(place(to));
}

void PixelPen::line_to(Spot to) { path_.push_back(place(to)); }

// Draws lines shorter than two pixels, at most 64 of them: pieces of an ellipse turn by at most 30
// degrees.
void PixelPen::curve_to(Spot control1, Spot control2, Spot to) {
  const Spot a = path_.back(), b = place(control1), c = place(control2), d = place(to);
  const double length = std::hypot(b.x - a.x, b.y - a.y) + std::hypot(c.x - b.x, c.y - b.y) +
                        std::hypot(d.x - c.x, d.y - c.y);
  const int lines = length < 128 ? static_cast<int>(length / 2) + 1 : 64;
  for (int i = 1; i <= lines; ++i) {
    const double t = static_cast<double>(i) / lines, s = 1 - t;
    const double wa = s * s * s, wb = 3 * s * s * t, wc = 3 * s * t * t, wd = t * t * t;
    path_.push_back(
        {wa * a.x + wb * b.x + wc * c.x + wd * d.x, wa * a.y + wb * b.y + wc * c.y + wd * d.y});
  }
}

// An arc with a chord c deviates from the chord by 1 - cos of half of its angle, which is less than
// c^2 / 4.
bool PixelPen::is_elsewhere(const Point& a, const Point& b, double width) const {
  const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
  const double reach = (dx * dx + dy * dy + dz * dz) / 4 * radius_ + width + 1;
  const double high = center_ - radius_ * std::max(a.y, b.y);
  const double low = center_ - radius_ * std::min(a.y, b.y);
  return low + reach < pixels_.first_row() || high - reach > pixels_.past_row();
}

bool PixelPen::is_elsewhere(Spot center, double radius) const {
  const double y = place(center).y;
  return y + radius + 1 < pixels_.first_row() || y - radius - 1 > pixels_.past_row();
}

// Each line is a rectangle; rectangles of one path overlap at its corners.
void PixelPen::stroke(const Color& color, double width) {
  for (std::size_t part = 0; part < starts_.size(); ++part) {
    const std::size_t past = part + 1 < starts_.size() ? starts_[part + 1] : path_.size();
    for (std::size_t i = starts_[part]; i + 1 < past; ++i) {
      const Spot& p = path_[i];
      const Spot& q = path_[i + 1];
      const Spot side = side_of(p, q, width / 2);
      const std::array<Spot, 4> line{{{p.x + side.x, p.y + side.y},
                                      {q.x + side.x, q.y + side.y},
                                      {q.x - side.x, q.y - side.y},
                                      {p.x - side.x, p.y - side.y}}};
      pixels_.fill(line, color);
    }
  }
  path_.clear();
  starts_.clear();
}

void PixelPen::fill(const Color& color, double rim) {
  // The side of the polygon that is outside, for either orientation.
  const double out = signed_area(std::span<const Spot>(path_)) > 0 ? rim / 2 : -rim / 2;
  outline_.clear();
  for (std::size_t i = 0; i < path_.size(); ++i) {
    const Spot& p = path_[i];
    const Spot& q = path_[(i + 1) % path_.size()];
    const Spot side = side_of(p, q, out);
    if (side.x == 0 && side.y == 0) continue;
    outline_.push_back({p.x + side.x, p.y + side.y});
    outline_.push_back({q.x + side.x, q.y + side.y});
  }
  pixels_.fill(outline_, color);
  path_.clear();
  starts_.clear();
}

// Paints a polygon with the area of the disc: with 16 corners, or 8 if the disc is not much larger
// than a pixel.
void PixelPen::dot(Spot center, double radius, const Color& color) {
  constexpr std::size_t most = 16;
  static const std::array<Spot, most> unit = [] {
    std::array<Spot, most> spots;
    for (std::size_t i = 0; i < most; ++i) {
      const double angle = 2 * std::numbers::pi / most * static_cast<double>(i);
      spots[i] = {std::cos(angle), std::sin(angle)};
    }
    return spots;
  }();
  const std::size_t step = radius < 1 ? 2 : 1;
  const std::size_t num_corners = most / step;
  const double angle = 2 * std::numbers::pi / static_cast<double>(num_corners);
  const double reach = radius * std::sqrt(angle / unit[step].y);
  const Spot middle = place(center);
  std::array<Spot, most> disc;
  for (std::size_t i = 0; i < num_corners; ++i) {
    disc[i] = {middle.x + reach * unit[i * step].x, middle.y + reach * unit[i * step].y};
  }
  pixels_.fill(std::span(disc).first(num_corners), color);
}

}  // namespace rondel::cli
