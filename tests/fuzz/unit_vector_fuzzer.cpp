// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// unit_vector, unit_vectors: any angles give a unit vector, turns change nothing, and the pole is
// one point.
#include <array>
#include <cmath>

#include "fuzz/fuzz_input.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"

namespace rondel::fuzz {
namespace {

// An angle that is often a multiple of a simple one, or next to one.
double next_angle(ByteSource& source) {
  switch (source.byte() % 4) {
    case 0:
      return 15.0 * source.small();
    case 1:
      return std::nextafter(15.0 * source.small(), source.small());
    case 2:
      return source.small() + source.byte() / 256.0;
    default:
      return source.finite_double();
  }
}

// Whether value + 360 is exact, so that both are the same direction.
bool turns_exactly(double value) {
  const double turned = value + 360;
  return std::isfinite(turned) && turned - 360 == value && turned - value == 360;
}

void test(const LonLat& position) {
  const Point p = unit_vector(position);
  require(std::abs(p.x * p.x + p.y * p.y + p.z * p.z - 1) < 1e-15, "a unit vector is a unit long");
  const auto [lon, lat] = position;
  if (turns_exactly(lon)) {
    require(unit_vector({lon + 360, lat}) == p, "a turn of longitude changes nothing");
  }
  if (turns_exactly(lat)) {
    require(unit_vector({lon, lat + 360}) == p, "a turn of latitude changes nothing");
  }
  require(unit_vector({-lon, lat}) == Point{p.x, -p.y, p.z}, "west mirrors east");
  require(unit_vector({lon, -lat}) == Point{p.x, p.y, -p.z}, "south mirrors north");
  require(unit_vector({lon, 90}) == Point{0, 0, 1}, "the pole is one point");

  const std::array<LonLat, 2> both = {LonLat{0, 0}, position};
  try {
    require(unit_vectors(both)[1] == p, "one or many, the vector is the same");
    require(std::abs(lat) <= 90, "a latitude beyond 90 is refused");
  } catch (const InvalidInput& error) {
    require(std::abs(lat) > 90 && error.index() == 1, "only a latitude beyond 90 is refused");
  }
}

void test_circle(const LonLat& center, double radius_deg) {
  const Point q = unit_vector(center);
  const bool is_circle = radius_deg >= 0 && radius_deg < 90;
  try {
    const Point p = polar_point(center, radius_deg);
    require(is_circle, "a radius of no circle is refused");
    require(p == polar_points(std::array{q}, std::array{radius_deg})[0], "one or many, the same");
    const double length = std::hypot(p.x, p.y, p.z);
    require(std::isfinite(length) && length > 1 - 1e-15, "a polar point is not inside");
    const double distance = std::hypot(p.x - length * q.x, p.y - length * q.y, p.z - length * q.z);
    require(distance <= 1e-15 * length, "a polar point is in the direction of the center");
    require(radius_deg != 0 || p == q, "a circle of radius 0 is its center");
  } catch (const InvalidInput&) {
    require(!is_circle, "only a radius of no circle is refused");
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rondel::fuzz::ByteSource source(data, size);
  const double lon = rondel::fuzz::next_angle(source);
  const double lat = rondel::fuzz::next_angle(source);
  rondel::fuzz::test({lon, lat});
  rondel::fuzz::test_circle({lon, lat}, rondel::fuzz::next_angle(source));
  return 0;
}
