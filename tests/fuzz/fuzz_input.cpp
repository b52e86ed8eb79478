// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "fuzz/fuzz_input.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <utility>

#include "rondel/delaunay.h"

namespace rondel::fuzz {
namespace {

double& coordinate(Point& p, std::size_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

// Overflow becomes the largest double: sites must be finite.
double clamped(double value) {
  constexpr double largest = std::numeric_limits<double>::max();
  return std::isfinite(value) ? value : std::copysign(largest, value);
}

Point scaled(const Point& p, double factor) {
  return {clamped(p.x * factor), clamped(p.y * factor), clamped(p.z * factor)};
}

Point moved_by_ulps(Point p, ByteSource& source) {
  double& value = coordinate(p, source.below(3));
  const int ulps = source.small() % 4;
  for (int i = 0; i < std::abs(ulps); ++i) {
    value = clamped(std::nextafter(value, ulps > 0 ? HUGE_VAL : -HUGE_VAL));
  }
  return p;
}

Point mirrored(Point p, ByteSource& source) {
  const std::uint8_t how = source.byte();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if ((how >> axis & 1U) != 0) coordinate(p, axis) = -coordinate(p, axis);
  }
  if ((how & 8U) != 0) std::swap(p.x, p.y);
  if ((how & 16U) != 0) std::swap(p.y, p.z);
  return p;
}

// A few bits of mantissa and any exponent.
double short_double(ByteSource& source) {
  const double mantissa = source.small();
  return clamped(std::ldexp(mantissa, 9 * source.small()));
}

}  // namespace

std::uint8_t ByteSource::byte() {
  if (bytes_.empty()) return 0;
  const std::uint8_t first = bytes_.front();
  bytes_ = bytes_.subspan(1);
  return first;
}

double ByteSource::any_double() {
  std::uint64_t bits = 0;
  for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
  return std::bit_cast<double>(bits);
}

double ByteSource::finite_double() {
  const double value = any_double();
  return std::isfinite(value) ? value : 0;
}

Point next_site(ByteSource& source, std::span<const Point> earlier) {
  const std::uint8_t kind = source.byte();
  const Point model = earlier.empty() ? Point{1, 0, 0} : earlier[source.below(earlier.size())];
  switch (kind % 10) {
    case 0:
    case 1: {
      const auto digit = [&] { return static_cast<double>(source.below(7)) - 3; };
      return {digit(), digit(), digit()};
    }
    case 2:
      return unit_vector({15.0 * source.small(), 15.0 * (source.small() % 7)});
    case 3:
      return unit_vector({source.small() / 8.0, source.small() % 90 + source.small() / 256.0});
    case 4:
      return moved_by_ulps(model, source);
    case 5:
      return scaled(model, 1 + static_cast<double>(source.below(5)));
    case 6:
      return scaled(model, std::ldexp(1.0, 8 * source.small()));
    case 7:
      return mirrored(model, source);
    case 8:
      return {short_double(source), short_double(source), short_double(source)};
    default:
      return {source.finite_double(), source.finite_double(), source.finite_double()};
  }
}

std::vector<Point> all_sites(ByteSource& source, std::size_t limit) {
  std::vector<Point> sites;
  while (!source.is_empty() && sites.size() < limit) sites.push_back(next_site(source, sites));
  return sites;
}

Sphere next_sphere(ByteSource& source) {
  Sphere sphere;
  switch (source.byte() % 8) {
    case 0:
      sphere.center = next_site(source, {});
      sphere.squared_radius = 1 + source.byte();
      break;
    case 1:
      sphere.center = {source.small() / 16.0, 0, source.small() / 64.0};
      break;
    default:
      break;
  }
  return sphere;
}

void remove_center(std::vector<Point>& sites, const Sphere& sphere) {
  std::erase(sites, sphere.center);
}

void require(bool holds, const std::string& law) {
  if (holds) return;
  std::fprintf(stderr, "broken law: %s\n", law.c_str());
  std::abort();
}

}  // namespace rondel::fuzz
