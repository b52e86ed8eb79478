// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "fuzz/fuzz_input.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>
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

// A few bits of mantissa.
double short_double(ByteSource& source, Scales scales) {
  const double mantissa = source.small();
  const int exponent = source.small();
  return clamped(std::ldexp(mantissa, scales == Scales::all ? 9 * exponent : exponent / 16));
}

// All bits of mantissa.
double full_double(ByteSource& source, Scales scales) {
  const double value = source.any_double();
  if (scales == Scales::all) return std::isfinite(value) ? value : 0;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
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

Scales next_scales(ByteSource& source) {
  static const char* const wanted = std::getenv("RONDEL_FUZZ_SCALES");
  static const bool is_near = wanted != nullptr && std::string_view(wanted) == "near";
  return source.byte() % 8 == 0 && !is_near ? Scales::all : Scales::near;
}

Point next_site(ByteSource& source, std::span<const Point> earlier, Scales scales) {
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
    case 6: {
      const int exponent = source.small();
      return scaled(model, std::ldexp(1.0, scales == Scales::all ? 8 * exponent : exponent / 16));
    }
    case 7:
      return mirrored(model, source);
    case 8:
      return {short_double(source, scales), short_double(source, scales),
              short_double(source, scales)};
    default:
      return {full_double(source, scales), full_double(source, scales),
              full_double(source, scales)};
  }
}

std::vector<Point> all_sites(ByteSource& source, std::size_t limit, Scales scales) {
  std::vector<Point> sites;
  while (!source.is_empty() && sites.size() < limit) {
    sites.push_back(next_site(source, sites, scales));
  }
  return sites;
}

std::size_t next_limit(ByteSource& source, std::size_t most) {
  return source.byte() % 8 == 0 ? most : 12;
}

Sphere next_sphere(ByteSource& source, Scales scales) {
  Sphere sphere;
  switch (source.byte() % 8) {
    case 0:
      sphere.center = next_site(source, {}, scales);
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

std::vector<Point> all_sites(ByteSource& source, std::size_t limit, Scales scales,
                             const Options& options) {
  std::vector<Point> sites = all_sites(source, limit, scales);
  if (options.model == Model::projected) remove_center(sites, options.sphere);
  return sites;
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
