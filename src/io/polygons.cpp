// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes polygons and lines in flat arrays: pieces of polygons are drawn in parallel and joined in
// order.
#include "rondel/polygons.h"

#include "io/cell_formats.h"
#include "map/arc.h"
#include "map/cell_map.h"
#include "map/face_map.h"
#include "map/region.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel {
namespace {

constexpr std::size_t grain = 512;

// Appends the polygons of an owner to the flat arrays.
void append(LonLatPolygons& all, const std::vector<map::LonLatPolygon>& polygons, Index owner) {
  for (const map::LonLatPolygon& polygon : polygons) {
    all.rings.append(polygon.ring);
    all.owners.push_back(owner);
  }
}

// Joins the flat arrays of pieces.
LonLatPolygons joined(const std::vector<LonLatPolygons>& pieces) {
  std::size_t num_positions = 0;
  std::size_t num_rings = 0;
  for (const LonLatPolygons& piece : pieces) {
    num_positions += piece.rings.values.size();
    num_rings += piece.owners.size();
  }
  LonLatPolygons all;
  all.rings.values.reserve(num_positions);
  all.owners.reserve(num_rings);
  all.rings.offsets.reserve(num_rings + 1);
  for (const LonLatPolygons& piece : pieces) {
    all.rings.append_rows(piece.rings);
    all.owners.insert(all.owners.end(), piece.owners.begin(), piece.owners.end());
  }
  return all;
}

// Calls draw(piece, begin, end) for the pieces of [0, count), in parallel.
template <class Draw>
LonLatPolygons collect(unsigned threads, std::size_t count, const Draw& draw) {
  std::vector<LonLatPolygons> pieces(system::num_pieces(count, grain));
  system::parallel_for(threads, count, grain, [&](std::size_t begin, std::size_t end) {
    draw(pieces[begin / grain], begin, end);
  });
  return joined(pieces);
}

}  // namespace

LonLatPolygons cell_polygons(const Triangulation& triangulation, const Diagram& diagram,
                             double tolerance_deg, const Execution& execution) {
  const system::Call call(execution);
  io::require_diagram(triangulation, diagram);
  const map::CellMap cell_map(triangulation, diagram.cells, io::checked_tolerance(tolerance_deg),
                              execution);
  return collect(execution.threads, triangulation.num_sites(),
                 [&](LonLatPolygons& piece, std::size_t begin, std::size_t end) {
                   map::CellMap::Pen pen;
                   for (std::size_t site = begin; site < end; ++site) {
                     if (!cell_map.has_cell(site)) continue;
                     append(piece, cell_map.polygons(site, pen), static_cast<Index>(site));
                   }
                 });
}

CompressedRows<LonLat> arc_lines(std::span<const std::array<Point, 2>> ends, double tolerance_deg) {
  const system::ArithmeticScope arithmetic;
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  CompressedRows<LonLat> lines;
  for (const auto& arc : ends) {
    // Between opposite ends every half of a great circle is as short as the others.
    if (arc[0] == Point{-arc[1].x, -arc[1].y, -arc[1].z}) continue;
    for (const auto& part : map::line_parts(arc, false, tolerance)) lines.append(part);
  }
  return lines;
}

LonLatPolygons face_polygons(const Triangulation& triangulation, const Execution& execution) {
  const system::Call call(execution);
  const map::FaceMap face_map(triangulation, execution);
  return collect(execution.threads, triangulation.num_faces(),
                 [&](LonLatPolygons& piece, std::size_t begin, std::size_t end) {
                   map::FaceMap::Pen pen;
                   for (std::size_t f = begin; f < end; ++f) {
                     const auto face = static_cast<Index>(f);
                     if (!triangulation.is_ghost(face))
                       append(piece, face_map.polygons(face, pen), face);
                   }
                 });
}

}  // namespace rondel
