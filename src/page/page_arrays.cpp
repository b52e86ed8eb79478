// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "page/page_arrays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
#include "io/binary.h"

namespace rondel::page {
namespace {

// Returns rows of numbers as little-endian bytes; `width` is the size of one number.
template <class Row>
PageArray page_array(std::string name, const char* kind, std::size_t width,
                     std::span<const Row> rows) {
  const io::NumberBytes numbers(rows);
  std::string bytes(static_cast<std::string_view>(numbers));
  const std::size_t length = bytes.size() / width;
  return {std::move(name), kind, std::move(bytes), length};
}

template <class Row>
PageArray doubles(std::string name, const std::vector<Row>& rows) {
  return page_array(std::move(name), "f64", sizeof(double), std::span<const Row>(rows));
}

template <class Row>
PageArray indices(std::string name, std::span<const Row> rows) {
  return page_array(std::move(name), "u32", sizeof(Index), rows);
}

// Returns the unit vector from the center to a site, or (0, 0, 0). Coordinates are halved first, so
// that the difference of huge ones is finite.
Point direction(const Point& site, const Point& center) {
  const Point half{site.x / 2 - center.x / 2, site.y / 2 - center.y / 2, site.z / 2 - center.z / 2};
  const double largest = std::max({std::abs(half.x), std::abs(half.y), std::abs(half.z)});
  if (largest == 0) return {};
  const Point p{half.x / largest, half.y / largest, half.z / largest};
  const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
  return {p.x / length, p.y / length, p.z / length};
}

// Returns the distance of a site from the center of the sphere, in radii of the sphere.
double length_in_radii(const Point& site, const Sphere& sphere) {
  const Point& c = sphere.center;
  const double half = exact::length_of(site / 2 - c / 2);
  return half / std::sqrt(sphere.squared_radius) * 2;
}

// Returns the radius in radians of the circle that a site at this distance from the center (in
// radii) sees: arccos(1 / length), or 0 inside of the sphere. The arctangent is accurate for small
// circles too.
double radius_of_circle(double length) {
  return length > 1 ? exact::argument(std::sqrt(length - 1) * std::sqrt(length + 1), 1) : 0;
}

// Returns the radius of each site's circle in radians: that of the table if it has radii, or else
// from the site's distance. Duplicates get 0.
std::vector<double> radii(const SiteTable& table, const Triangulation& triangulation,
                          const std::vector<double>& lengths) {
  constexpr double degree = std::numbers::pi / 180;
  std::vector<double> result(lengths.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] =
        table.radii_deg.empty() ? radius_of_circle(lengths[i]) : degree * table.radii_deg[i];
  }
  for (const Duplicate& duplicate : triangulation.duplicates()) result[duplicate.site] = 0;
  return result;
}

// Returns the circumcenter as the page computes it, operation by operation (viewer/src/surface.js,
// plainCenter), so that both have the same bits.
Point plain_center(const Point& a, const Point& b, const Point& c) {
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double x = uy * vz - uz * vy;
  const double y = uz * vx - ux * vz;
  const double z = ux * vy - uy * vx;
  const double length = std::sqrt(x * x + y * y + z * z);
  if (!(length > 0 && length < HUGE_VAL)) return {};
  return {x / length, y / length, z / length};
}

// Returns the bits in which two doubles differ, as a double.
double different_bits(double a, double b) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) ^ std::bit_cast<std::uint64_t>(b));
}

// Returns the points of the diagram, with each circumcenter replaced by the bits in which it
// differs from plain_center().
std::vector<Point> stored_points(const Triangulation& triangulation, std::vector<Point> points,
                                 const std::vector<Point>& directions,
                                 const std::vector<double>& lengths) {
  const auto site = [&](Index i) {
    const double length = lengths.empty() ? 1 : lengths[i];
    const Point& p = directions[i];
    return Point{p.x * length, p.y * length, p.z * length};
  };
  for (std::size_t f = 0; f < triangulation.num_faces(); ++f) {
    const auto& [a, b, c] = triangulation.faces()[f];
    const Point plain = plain_center(site(a), site(b), site(c));
    Point& p = points[f];
    p = {different_bits(p.x, plain.x), different_bits(p.y, plain.y), different_bits(p.z, plain.z)};
  }
  return points;
}

// True if the rings of the cells have to be stored. Otherwise each ring has just the faces around
// its site, which the page finds by itself.
bool has_own_rings(const Triangulation& triangulation, const Cells& cells) {
  return triangulation.dimension() < 2 || cells.points.size() != triangulation.num_faces();
}

// Appends the isolines as two arrays. A closed line gets its first point again at its end.
void add_isolines(const Isolines& lines, std::vector<PageArray>& arrays) {
  std::vector<Point> points;
  std::vector<Index> ends;
  for (std::size_t i = 0; i < lines.num_lines(); ++i) {
    const std::span<const Point> line = lines.lines.rows[i];
    points.insert(points.end(), line.begin(), line.end());
    if (lines.is_closed[i] != 0 && !line.empty()) points.push_back(line.front());
    ends.push_back(static_cast<Index>(points.size()));
  }
  arrays.push_back(doubles("isolines", points));
  arrays.push_back(indices("isolineEnds", std::span<const Index>(ends)));
}

}  // namespace

std::vector<Point> site_directions(const Triangulation& triangulation) {
  const std::span<const Point> sites = triangulation.sites().points();
  std::vector<Point> directions(sites.size());
  std::ranges::transform(sites, directions.begin(), [&](const Point& site) {
    return direction(site, triangulation.sphere().center);
  });
  return directions;
}

std::vector<PageArray> page_arrays(const SiteTable& table, const Triangulation& triangulation,
                                   const Diagram& diagram, const GlobeOptions& options,
                                   const std::vector<Point>& directions) {
  std::vector<PageArray> arrays;
  std::vector<double> lengths;
  arrays.push_back(doubles("directions", directions));
  if (triangulation.model() == Model::weighted) {
    for (const Point& p : triangulation.sites().points()) {
      lengths.push_back(length_in_radii(p, triangulation.sphere()));
    }
    arrays.push_back(doubles("lengths", lengths));
    arrays.push_back(doubles("radii", radii(table, triangulation, lengths)));
  }
  arrays.push_back(indices("faces", triangulation.faces()));
  arrays.push_back(indices("ghosts", triangulation.ghost_faces()));
  arrays.push_back(indices("duplicates", triangulation.duplicates()));
  arrays.push_back(indices("hidden", triangulation.hidden()));
  arrays.push_back(indices("ring", triangulation.ring()));
  const Cells& cells = diagram.cells;
  arrays.push_back(
      doubles("points", stored_points(triangulation, cells.points, directions, lengths)));
  if (has_own_rings(triangulation, cells)) {
    const std::vector<Index> offsets(cells.rings.offsets.begin(), cells.rings.offsets.end());
    arrays.push_back(indices("ringOffsets", std::span<const Index>(offsets)));
    arrays.push_back(indices("ringPoints", std::span<const Index>(cells.rings.values)));
  }
  arrays.push_back(doubles("areas", diagram.areas));
  if (!options.values.empty()) {
    arrays.push_back(page_array("values", "f64", sizeof(double), options.values));
  }
  if (options.isolines != nullptr) add_isolines(*options.isolines, arrays);
  return arrays;
}

std::vector<PageArray> column_arrays(const SiteTable& table) {
  std::vector<PageArray> arrays;
  for (const Column& column : table.columns) {
    const std::string name = "column" + std::to_string(arrays.size() / 2);
    std::vector<Index> lengths;
    std::uint64_t begin = 0;
    for (const std::uint64_t end : column.ends) {
      lengths.push_back(static_cast<Index>(end - begin));
      begin = end;
    }
    arrays.push_back({name, "u8", column.text, column.text.size()});
    arrays.push_back(indices(name + "Lengths", std::span<const Index>(lengths)));
  }
  return arrays;
}

}  // namespace rondel::page
