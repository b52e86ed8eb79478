// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes binary .stl. The format has neither indices nor doubles: corners are repeated as 32-bit
// floats, so that close sites may coincide. It serves printing and viewing, not exchange.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "exact/vector.h"
#include "io/binary.h"
#include "io/triangle_formats.h"
#include "rondel/error.h"

namespace rondel::io {
namespace {

// Returns the unit normal, or zero if rounding leaves none; readers then compute it themselves.
Point normal(const Point& a, const Point& b, const Point& c) {
  const Point n = scaled(cross(scaled(b - a), scaled(c - a)));
  const double length = norm(n);
  return length > 0 ? n / length : n;
}

void require_floats(const SiteTable& table) {
  constexpr double limit = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < table.sites.size(); ++i) {
    if (largest_coordinate(table.sites[i]) > limit) {
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
  const auto num_faces = static_cast<std::uint32_t>(mesh.faces.size());
  write_values<std::uint32_t>(file, 1, [=](std::size_t) { return num_faces; });
  const auto append = [&](std::string& bytes, const Triple& face) {
    const auto& [a, b, c] = face;
    std::array<char, 12 * sizeof(float) + 2> record = {};  // the last two bytes: no attributes
    char* end = record.data();
    for (const Point& p : {normal(sites[a], sites[b], sites[c]), sites[a], sites[b], sites[c]}) {
      for (const double value : {p.x, p.y, p.z}) end = store(static_cast<float>(value), end);
    }
    bytes.append(record.data(), record.size());
  };
  mesh.write_faces(file, [&](std::string& bytes, Index begin, Index end) {
    const auto faces = mesh.faces.subspan(begin, end - begin);
    for (const Triple& face : faces) append(bytes, face);
  });
}

}  // namespace rondel::io
