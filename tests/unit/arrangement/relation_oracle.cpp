// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "unit/arrangement/relation_oracle.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "rondel/types.h"

namespace rondel::test {
namespace {

using Integer = mpz_class;

// A ray: its length does not matter.
struct Ray {
  Integer x;
  Integer y;
  Integer z;
};

Ray cross(const Ray& a, const Ray& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Integer dot(const Ray& a, const Ray& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Ray sum(const Ray& a, const Ray& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Ray times(const Integer& s, const Ray& a) { return {s * a.x, s * a.y, s * a.z}; }
bool is_zero(const Ray& a) { return a.x == 0 && a.y == 0 && a.z == 0; }
bool is_same(const Ray& a, const Ray& b) { return is_zero(cross(a, b)) && dot(a, b) > 0; }

// Doubles are integers of 2^-204: coordinates are 0 or not below 2^-150. Factors of 2 are left out.
Ray ray_of(const Point& p) {
  constexpr int exponent = 204;
  Ray ray = {Integer(std::ldexp(p.x, exponent)), Integer(std::ldexp(p.y, exponent)),
             Integer(std::ldexp(p.z, exponent))};
  while (mpz_even_p(ray.x.get_mpz_t()) != 0 && mpz_even_p(ray.y.get_mpz_t()) != 0 &&
         mpz_even_p(ray.z.get_mpz_t()) != 0) {
    for (Integer* x : {&ray.x, &ray.y, &ray.z}) *x /= 2;
  }
  return ray;
}

// Returns the number of bits of a ray's length.
std::size_t size(const Ray& v) { return mpz_sizeinbase(Integer(dot(v, v)).get_mpz_t(), 2) / 2; }

struct Arc {
  Ray from;
  Ray to;
  Ray normal;
};

Arc arc(const Ray& from, const Ray& to) { return {from, to, cross(from, to)}; }

// True if a ray is on an arc, its ends included.
bool is_on(const Ray& p, const Arc& s) {
  return dot(s.normal, p) == 0 && dot(cross(s.from, p), s.normal) >= 0 &&
         dot(cross(p, s.to), s.normal) >= 0;
}

// A geometry of one dimension.
class Shape {
 public:
  Shape(const Geometries& geometries, std::size_t g) : Shape(geometries.polygons, g) {
    const FeatureLines& lines = geometries.lines;
    is_polygon_ = lines.offsets[g] == lines.offsets[g + 1];
    for (std::uint64_t i = lines.offsets[g]; i < lines.offsets[g + 1]; ++i) {
      const auto line = lines.rows[i];
      if (line.size() == 1) {
        points_.push_back(ray_of(line[0]));
        continue;
      }
      ends_.push_back(ray_of(line.front()));
      ends_.push_back(ray_of(line.back()));
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        sides_.push_back(arc(ray_of(line[k]), ray_of(line[k + 1])));
      }
    }
  }
  Shape(const CellRings& cells, std::size_t cell) : is_whole_(cells.is_whole(cell)) {
    for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
      const auto ring = cells.corners_of(r);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        sides_.push_back(
            arc(ray_of(cells.points[ring[k]]), ray_of(cells.points[ring[(k + 1) % ring.size()]])));
      }
    }
  }
  [[nodiscard]] const std::vector<Arc>& sides() const { return sides_; }
  [[nodiscard]] const std::vector<Ray>& points() const { return points_; }
  // True if a place inside has to be known.
  [[nodiscard]] bool has_inside() const { return is_polygon_ && !sides_.empty(); }
  void set_inside(const Ray& place) { inside_ = place; }

  // Returns 0 for the interior, 1 for the boundary, 2 for the exterior.
  [[nodiscard]] int part(const Ray& place) const {
    const auto is_place = [&](const Ray& other) { return is_same(place, other); };
    if (!is_polygon_) {
      if (std::ranges::count_if(ends_, is_place) % 2 != 0) return 1;
      const bool is_on_any =
          std::ranges::any_of(points_, is_place) ||
          std::ranges::any_of(sides_, [&](const Arc& side) { return is_on(place, side); });
      return is_on_any ? 0 : 2;
    }
    if (sides_.empty()) return is_whole_ ? 0 : 2;
    for (const Arc& side : sides_) {
      if (is_on(place, side)) return 1;
    }
    // The way leads over a third place, so that it meets no corner.
    for (int attempt = 1;; ++attempt) {
      const Ray over = {Integer(17 * attempt % 101 - 50), Integer(31 * attempt % 103 - 51),
                        Integer(43 * attempt % 107 - 53)};
      const int first = num_crossings(place, over);
      const int second = num_crossings(over, inside_);
      if (first >= 0 && second >= 0) return (first + second) % 2 == 0 ? 0 : 2;
    }
  }

 private:
  // Returns how many sides an arc between places that are not on sides crosses; -1 if it meets a
  // corner, or one of its ends is on a side.
  [[nodiscard]] int num_crossings(const Ray& p, const Ray& q) const {
    const Arc way = arc(p, q);
    int number = 0;
    for (const Arc& side : sides_) {
      if (is_on(p, side) || is_on(q, side)) return -1;
      const int of_from = sgn(dot(way.normal, side.from));
      const int of_to = sgn(dot(way.normal, side.to));
      if (of_from * of_to == 0) {
        if (of_from == of_to || is_on(side.from, way) || is_on(side.to, way)) return -1;
        continue;
      }
      const int of_p = sgn(dot(side.normal, p));
      const int of_q = sgn(dot(side.normal, q));
      number += of_from == -of_to && of_p == -of_from && of_q == of_from ? 1 : 0;
    }
    return number;
  }

  std::vector<Arc> sides_;
  std::vector<Ray> ends_;  // of lines
  std::vector<Ray> points_;
  Ray inside_;
  bool is_whole_;
  bool is_polygon_ = true;
};

// Returns a place in the middle of an arc, or so.
Ray middle(const Ray& a, const Ray& b) {
  const std::size_t of_a = size(a);
  const std::size_t of_b = size(b);
  Integer factor = 1;
  factor <<= of_a > of_b ? of_a - of_b : of_b - of_a;
  return of_a > of_b ? sum(a, times(factor, b)) : sum(times(factor, a), b);
}

// True if a step from a place meets a side at which it does not begin, or may do so.
bool meets(const Arc& step, const Arc& side) {
  if (is_on(step.to, side)) return true;
  if (is_on(step.from, side)) return false;
  const int of_place = sgn(dot(side.normal, step.from));
  const int of_end = sgn(dot(side.normal, step.to));
  if (of_place == 0) {
    return of_end == 0 && (is_on(side.from, step) || is_on(side.to, step));
  }
  return of_place != of_end &&
         sgn(dot(step.normal, side.from)) * sgn(dot(step.normal, side.to)) <= 0;
}

// Returns a place to the left of an arc with this normal, so near to a place on it that nothing
// else is between them.
Ray beside(const Ray& place, const Ray& normal, const std::vector<Arc>& sides) {
  Integer factor = 4;
  factor <<= std::max(size(place), size(normal)) - size(place);
  for (;; factor <<= 16) {
    const Ray result = sum(times(factor, place), normal);
    const Arc step = arc(place, result);
    if (std::ranges::none_of(sides, [&](const Arc& side) { return meets(step, side); })) {
      return result;
    }
  }
}

// Returns the places where an arc meets others or points, and its ends, from its start to its end.
std::vector<Ray> places_along(const Arc& s, const std::vector<Arc>& sides,
                              const std::vector<Ray>& points) {
  std::vector<Ray> places = {s.from, s.to};
  const auto add = [&](const Ray& place) {
    if (is_on(place, s)) places.push_back(place);
  };
  for (const Ray& point : points) add(point);
  for (const Arc& t : sides) {
    add(t.from);
    add(t.to);
    const Ray line = cross(s.normal, t.normal);
    if (is_zero(line)) continue;
    for (const Ray& place : {line, times(-1, line)}) {
      if (is_on(place, t)) add(place);
    }
  }
  std::ranges::sort(places,
                    [&](const Ray& p, const Ray& q) { return dot(cross(p, q), s.normal) > 0; });
  const auto same = std::unique(places.begin(), places.end(), is_same);
  places.erase(same, places.end());
  return places;
}

std::string relation_of(std::array<Shape, 2> shapes) {
  std::vector<Arc> sides = shapes[0].sides();
  sides.insert(sides.end(), shapes[1].sides().begin(), shapes[1].sides().end());
  std::vector<Ray> points = shapes[0].points();
  points.insert(points.end(), shapes[1].points().begin(), shapes[1].points().end());
  for (Shape& shape : shapes) {
    if (!shape.has_inside()) continue;
    const Arc& side = shape.sides()[0];
    const std::vector<Ray> places = places_along(side, sides, {});
    shape.set_inside(beside(middle(places[0], places[1]), side.normal, sides));
  }
  std::string matrix(9, 'F');
  const auto add = [&](const Ray& place, char dimension) {
    char& entry =
        matrix[static_cast<std::size_t>(3 * shapes[0].part(place) + shapes[1].part(place))];
    if (entry == 'F' || entry < dimension) entry = dimension;
  };
  for (const Ray& point : points) add(point, '0');
  for (const Arc& side : sides) {
    const std::vector<Ray> places = places_along(side, sides, points);
    for (std::size_t k = 0; k < places.size(); ++k) {
      add(places[k], '0');
      if (k + 1 == places.size()) break;
      const Ray place = middle(places[k], places[k + 1]);
      add(place, '1');
      add(beside(place, side.normal, sides), '2');
      add(beside(place, times(-1, side.normal), sides), '2');
    }
  }
  if (sides.empty()) add({101, 203, 307}, '2');
  return matrix;
}

}  // namespace

std::string relation_by_places(const Geometries& a, std::size_t of_a, const Geometries& b,
                               std::size_t of_b) {
  return relation_of({Shape(a, of_a), Shape(b, of_b)});
}

std::string relation_by_places(const CellRings& a, std::size_t cell_a, const CellRings& b,
                               std::size_t cell_b) {
  return relation_of({Shape(a, cell_a), Shape(b, cell_b)});
}

}  // namespace rondel::test
