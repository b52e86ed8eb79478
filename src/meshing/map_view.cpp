// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/map_view.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "exact/angles.h"
#include "exact/vector.h"
#include "meshing/picture_parts.h"
#include "rondel/delaunay.h"

namespace rondel::meshing {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// Returns 1, 2 or 5 times a power of ten: the least one with which so many steps are the extent.
double round_step(double extent, double most_steps) {
  double power = 1e-6;
  while (true) {
    for (const double factor : {1, 2, 5}) {
      if (extent <= factor * power * most_steps) return factor * power;
    }
    power *= 10;
  }
}

}  // namespace

MapView::MapView(std::span<const Point> places, const MapFrame& most) {
  Point sum;
  for (const Point& p : places) sum = sum + p;
  center_ = norm(sum) > 0 ? normalized(sum) : Point{1, 0, 0};
  is_round_ = std::ranges::all_of(places, [&](const Point& p) { return dot(p, center_) >= 0; });
  const Point east{-center_.y, center_.x, 0};
  east_ = norm(east) > 0 ? normalized(east) : Point{0, 1, 0};
  north_ = cross(center_, east_);
  least_ = {-turn / 2, -turn / 4};
  MapPixel greatest = {turn / 2, turn / 4};
  if (is_round_) {
    least_ = greatest = plane(places.front());
    const double center_lon_deg = lonlats({&center_, 1}).front().lon_deg;
    for (const LonLat& place : lonlats(places)) {
      const double lon_deg = center_lon_deg + std::remainder(place.lon_deg - center_lon_deg, 360);
      least_deg_ = {std::min(least_deg_.lon_deg, lon_deg),
                    std::min(least_deg_.lat_deg, place.lat_deg)};
      greatest_deg_ = {std::max(greatest_deg_.lon_deg, lon_deg),
                       std::max(greatest_deg_.lat_deg, place.lat_deg)};
    }
    for (const Point& p : places) {
      const MapPixel at = plane(p);
      least_ = {std::min(least_.x, at.x), std::min(least_.y, at.y)};
      greatest = {std::max(greatest.x, at.x), std::max(greatest.y, at.y)};
    }
  }
  constexpr double border = 0.02;  // around the places, by the larger side
  const double around =
      is_round_ ? border * std::max(greatest.x - least_.x, greatest.y - least_.y) : 0;
  const double width = greatest.x - least_.x + 2 * around;
  const double height = greatest.y - least_.y + 2 * around;
  least_ = {least_.x - around, least_.y - around};
  scale_ = std::min(most.width / width, most.height / height);
  frame_ = {most.corner, width * scale_, height * scale_};
}

MapPixel MapView::plane(const Point& p) const {
  if (is_round_) {
    const double k = std::sqrt(2 / (1 + dot(center_, p)));
    return {k * dot(east_, p), -k * dot(north_, p)};
  }
  return {exact::argument(p.y, p.x), -exact::argument(p.z, std::sqrt(p.x * p.x + p.y * p.y))};
}

MapPixel MapView::to_pixel(const MapPixel& in_plane) const {
  return {frame_.corner.x + scale_ * (in_plane.x - least_.x),
          frame_.corner.y + scale_ * (in_plane.y - least_.y)};
}

MapPixel MapView::pixel(const Point& p) const { return to_pixel(plane(p)); }

std::vector<MapPixel> MapView::outline(const std::array<Point, 3>& triangle) const {
  std::vector<MapPixel> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const MapPixel at = plane(triangle[k]);
    if (is_round_ || !exact::is_pole(triangle[k])) {
      corners.push_back(at);
      continue;
    }
    // A pole has the longitudes of both neighbors.
    corners.push_back({plane(triangle[(k + 2) % 3]).x, at.y});
    corners.push_back({plane(triangle[(k + 1) % 3]).x, at.y});
  }
  if (!is_round_) {
    const auto after = [](double x, double next) { return x + std::remainder(next - x, turn); };
    for (std::size_t k = 1; k < corners.size(); ++k) {
      corners[k].x = after(corners[k - 1].x, corners[k].x);
    }
    const double last = after(corners.back().x, corners.front().x);
    if (std::abs(last - corners.front().x) > turn / 2) {
      const double pole = corners.front().y < 0 ? -turn / 4 : turn / 4;
      corners.push_back({last, corners.front().y});
      corners.push_back({last, pole});
      corners.push_back({corners.front().x, pole});
    }
  }
  for (MapPixel& corner : corners) corner = to_pixel(corner);
  return corners;
}

// Appends a meridian or parallel, and its degrees where it is first seen.
void MapView::append_line(double value_deg, bool is_meridian, double along_begin_deg,
                          double along_end_deg, Lines& lines) const {
  constexpr int pieces = 48;
  bool has_text = false;
  for (int k = 0; k <= pieces; ++k) {
    const double along = along_begin_deg + (along_end_deg - along_begin_deg) * k / pieces;
    const LonLat place = is_meridian ? LonLat{value_deg, along} : LonLat{along, value_deg};
    const MapPixel at = is_round_ ? pixel(unit_vector(place))
                                  : to_pixel({place.lon_deg / exact::degrees_per_radian,
                                              -place.lat_deg / exact::degrees_per_radian});
    lines.path += (k == 0 ? 'M' : 'L') + fixed(at.x) + ' ' + fixed(at.y);
    const bool is_seen = at.x > frame_.corner.x && at.x < frame_.corner.x + frame_.width - 30 &&
                         at.y > frame_.corner.y + 12 && at.y < frame_.corner.y + frame_.height;
    if (has_text || !is_seen) continue;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.8g", std::remainder(value_deg, 360));
    lines.texts += text_at(at.x + 2, at.y - 2, text.data());
    has_text = true;
  }
}

std::string MapView::lines() const {
  LonLat least = {-180, -90};
  LonLat greatest = {180, 90};
  double step = 30;
  if (is_round_) {
    step = std::min(30.0, round_step((greatest_deg_.lat_deg - least_deg_.lat_deg), 6));
    least = {least_deg_.lon_deg - step, std::max(least_deg_.lat_deg - step, -90.0)};
    greatest = {greatest_deg_.lon_deg + step, std::min(greatest_deg_.lat_deg + step, 90.0)};
    if (greatest.lon_deg - least.lon_deg > 360) greatest.lon_deg = least.lon_deg + 360;
  }
  const double lon_step =
      is_round_ ? std::min(30.0, round_step(greatest.lon_deg - least.lon_deg, 12)) : 30;
  Lines all;
  for (double k = std::ceil(least.lon_deg / lon_step); k * lon_step < greatest.lon_deg; ++k) {
    append_line(k * lon_step, true, least.lat_deg, greatest.lat_deg, all);
  }
  for (double k = std::ceil(least.lat_deg / step); k * step <= greatest.lat_deg; ++k) {
    append_line(k * step, false, least.lon_deg, greatest.lon_deg, all);
  }
  return "<path d=\"" + all.path + "\" fill=\"none\" stroke=\"#bbb\" stroke-width=\"0.5\"/>\n" +
         "<g fill=\"#666\" stroke=\"#fff\" stroke-width=\"2\" paint-order=\"stroke\" "
         "font-size=\"10\">\n" +
         all.texts + "</g>\n";
}

}  // namespace rondel::meshing
