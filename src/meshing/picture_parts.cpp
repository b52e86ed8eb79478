// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/picture_parts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>

namespace rondel::meshing {
namespace {

constexpr double histogram_height = 180;
constexpr double histogram_top = 40;

}  // namespace

void count_in(mesh::Histogram& histogram, double value) {
  const double step = (value - histogram.low) / (histogram.high - histogram.low) *
                      static_cast<double>(histogram.counts.size());
  const double last = static_cast<double>(histogram.counts.size() - 1);
  // NaN is counted in the first step.
  ++histogram.counts[step > 0 ? static_cast<std::size_t>(std::min(step, last)) : 0];
}

std::string fixed(double value) {
  std::array<char, 32> digits;
  std::snprintf(digits.data(), digits.size(), "%.2f", value);
  return digits.data();
}

std::string text_at(double x, double y, const std::string& text) {
  return "<text x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\">" + text + "</text>\n";
}

std::string begin_picture(double height) {
  return R"(<svg xmlns="http://www.w3.org/2000/svg" width=")" + fixed(picture_width) +
         R"(" height=")" + fixed(height) +
         R"(" font-family="sans-serif" font-size="12">)"
         "\n"
         R"(<rect width="100%" height="100%" fill="white"/>)"
         "\n"
         R"(<g fill="#456" stroke="none">)"
         "\n";
}

std::string bars(const mesh::Histogram& histogram, int column, const std::string& title) {
  const double left = margin + column * (picture_width - margin) / 3;
  const double width = (picture_width - 4 * margin) / 3;
  const double step = width / static_cast<double>(histogram.counts.size());
  const auto most = static_cast<double>(*std::ranges::max_element(histogram.counts));
  const double bottom = histogram_top + histogram_height;
  std::string svg = text_at(left, histogram_top - 10, title);
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    if (histogram.counts[i] == 0) continue;
    const double height =
        std::max(1.0, histogram_height * static_cast<double>(histogram.counts[i]) / most);
    svg += "<rect x=\"" + fixed(left + step * static_cast<double>(i)) + "\" y=\"" +
           fixed(bottom - height) + "\" width=\"" + fixed(step) + "\" height=\"" + fixed(height) +
           "\"/>\n";
  }
  svg += "<path d=\"M" + fixed(left) + ' ' + fixed(bottom) + 'h' + fixed(width) + "\"/>\n";
  svg += text_at(left, bottom + 16, fixed(histogram.low));
  return svg + text_at(left + width - 30, bottom + 16, fixed(histogram.high));
}

}  // namespace rondel::meshing
