// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Binary .stl. The format has neither indices nor doubles: corners are repeated as 32-bit
// floats, so close sites may fall together. It serves printing and viewing, not exchange.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/binary.h"
#include "io/triangle_formats.h"
#include "rondel/error.h"

namespace rondel::io {
namespace {

using Vector = std::array<double, 3>;

Vector difference(const Point& p, const Point& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }

// Scaled so that the largest coordinate is 1: no product below over- or underflows.
Vector scaled(const Vector& v) {
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  return largest > 0 ? Vector{v[0] / largest, v[1] / largest, v[2] / largest} : v;
}

// The unit normal; zero, which readers then compute themselves, where rounding leaves none.
Vector normal(const Point& a, const Point& b, const Point& c) {
  const Vector u = scaled(difference(b, a));
  const Vector v = scaled(difference(c, a));
  const Vector n =
      scaled({u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]});
  const double length = std::hypot(n[0], n[1], n[2]);
  return length > 0 ? Vector{n[0] / length, n[1] / length, n[2] / length} : n;
}

void require_floats(const SiteTable& table) {
  constexpr double limit = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < table.sites.size(); ++i) {
    const Point& p = table.sites[i];
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > limit) {
      throw FileError(table.where(i) + ": the site does not fit the 32-bit floats of .stl");
    }
  }
}

}  // namespace

void write_stl(AtomicFile& file, const MeshToWrite& mesh) {
  const auto& sites = mesh.table.sites;
  require_floats(mesh.table);
  std::string head = "Rondel; 32-bit floats, see the other formats for exact coordinates";
  head.resize(80, ' ');
  file.write(head);
  const auto num_faces = static_cast<std::uint32_t>(mesh.triangulation.num_faces());
  write_values<std::uint32_t>(file, 1, [=](std::size_t) { return num_faces; });
  mesh.write_faces(file, [&](std::string& bytes, Index face) {
    const auto& [a, b, c] = mesh.triangulation.faces()[face];
    const Vector n = normal(sites[a], sites[b], sites[c]);
    std::array<float, 12> numbers = {};
    std::size_t size = 0;
    const auto append = [&](double value) { numbers[size++] = static_cast<float>(value); };
    for (const double value : n) append(value);
    for (const Index corner : {a, b, c}) {
      append(sites[corner].x);
      append(sites[corner].y);
      append(sites[corner].z);
    }
    bytes.append(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers));
    bytes.append(2, '\0');  // no attributes
  });
}

}  // namespace rondel::io
