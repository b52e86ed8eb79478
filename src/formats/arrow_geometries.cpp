// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Geometries from and to arrays of GeoArrow: multipolygons have polygons, these have rings, and rings
// have positions; multilinestrings have lines of positions, and multipoints positions.
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/arrow_export.h"
#include "formats/arrow_levels.h"
#include "rondel/arrow.h"
#include "rondel/error.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using formats::ArrowLevels;
using LonLatLineGroups = RowGroups<CompressedRows<LonLat>>;

// Returns the offsets of rows of one element each.
std::vector<std::uint64_t> single_offsets(std::size_t count) {
  return system::offsets_of(count, [](std::size_t) { return 1U; });
}

LonLatMultiPolygons polygons_in(ArrowLevels levels, bool is_multi) {
  LonLatMultiPolygons features;
  if (is_multi) {
    features.offsets = levels.next();
    features.rows.offsets = levels.next();
  } else {
    features.rows.offsets = levels.next();
    features.offsets = single_offsets(features.rows.size());
  }
  features.rows.rows.offsets = levels.next();
  features.rows.rows.values = levels.positions();
  return features;
}

// Returns points, each of which is a line of one position. A point that is null or NaN is none.
LonLatLineGroups points_in(const ArrowLevels& levels) {
  LonLatLineGroups features;
  const std::vector<LonLat> positions = levels.positions();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const LonLat& p = positions[i];
    const bool is_nothing = std::isnan(p.lon_deg) && std::isnan(p.lat_deg);
    if (!is_nothing && !levels.is_null(i)) features.rows.append({&p, 1});
    features.end_group();
  }
  return features;
}

// Returns the points or lines of an array of another type than point.
LonLatLineGroups lines_in(ArrowLevels levels, std::string_view type) {
  LonLatLineGroups features;
  if (type == "geoarrow.multilinestring") {
    features.offsets = levels.next();
    features.rows.offsets = levels.next();
  } else if (type == "geoarrow.multipoint") {
    features.offsets = levels.next();
    features.rows.offsets = single_offsets(features.offsets.back());
  } else {
    // A line without positions is none.
    const std::vector<std::uint64_t> ends = levels.next();
    const std::vector<LonLat> positions = levels.positions();
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const std::span line = std::span(positions).subspan(ends[i], ends[i + 1] - ends[i]);
      if (!line.empty()) features.rows.append(line);
      features.end_group();
    }
    return features;
  }
  features.rows.values = levels.positions();
  return features;
}

// Makes an array of the points or of the lines among the lines.
void export_rows(const LonLatLineGroups& features, bool are_points, PolygonEdges edges,
                 ArrowSchema& schema, ArrowArray& array) {
  // Offsets that do not fit are refused before they are followed.
  (void)formats::arrow_offsets(features.offsets, features.rows.size());
  (void)formats::arrow_offsets(features.rows.offsets, features.rows.values.size());
  LonLatLineGroups chosen;
  for (std::size_t i = 0; i < features.size(); ++i) {
    for (std::uint64_t r = features.offsets[i]; r < features.offsets[i + 1]; ++r) {
      if ((features.rows[r].size() == 1) == are_points) chosen.rows.append(features.rows[r]);
    }
    chosen.end_group();
  }
  const auto groups = formats::arrow_offsets(chosen.offsets, chosen.rows.size());
  if (are_points) {
    formats::export_lists("geoarrow.multipoint", edges, {{"", groups}}, "points",
                          chosen.rows.values, schema, array);
  } else {
    formats::export_lists(
        "geoarrow.multilinestring", edges,
        {{"", groups},
         {"linestrings", formats::arrow_offsets(chosen.rows.offsets, chosen.rows.values.size())}},
        "vertices", chosen.rows.values, schema, array);
  }
}

}  // namespace

LonLatMultiPolygons import_arrow(const ArrowSchema& schema, const ArrowArray& array) {
  const std::string_view type = formats::geoarrow_type(schema);
  const bool is_multi = type == "geoarrow.multipolygon";
  if (!is_multi && type != "geoarrow.polygon") {
    formats::refuse_arrow("has the type " + std::string(type) +
                          ", not geoarrow.polygon or geoarrow.multipolygon");
  }
  return polygons_in(ArrowLevels(schema, array), is_multi);
}

LonLatGeometries import_arrow_geometries(const ArrowSchema& schema, const ArrowArray& array) {
  const std::string_view type = formats::geoarrow_type(schema);
  const ArrowLevels levels(schema, array);
  LonLatGeometries geometries;
  if (type == "geoarrow.polygon" || type == "geoarrow.multipolygon") {
    geometries.polygons = polygons_in(levels, type == "geoarrow.multipolygon");
    geometries.lines.offsets.assign(geometries.polygons.size() + 1, 0);
    return geometries;
  }
  if (type == "geoarrow.point") {
    geometries.lines = points_in(levels);
  } else if (type == "geoarrow.multipoint" || type == "geoarrow.linestring" ||
             type == "geoarrow.multilinestring") {
    geometries.lines = lines_in(levels, type);
  } else {
    formats::refuse_arrow("has the type " + std::string(type) +
                          ", not geoarrow.point, geoarrow.linestring, geoarrow.polygon, or one of "
                          "several of them");
  }
  geometries.polygons.offsets.assign(geometries.lines.size() + 1, 0);
  return geometries;
}

void export_arrow(const LonLatMultiPolygons& features, PolygonEdges edges, ArrowSchema& schema,
                  ArrowArray& array) {
  const auto& polygons = features.rows;
  const auto& rings = polygons.rows;
  formats::export_lists("geoarrow.multipolygon", edges,
                        {{"", formats::arrow_offsets(features.offsets, polygons.size())},
                         {"polygons", formats::arrow_offsets(polygons.offsets, rings.size())},
                         {"rings", formats::arrow_offsets(rings.offsets, rings.values.size())}},
                        "vertices", rings.values, schema, array);
}

void export_arrow(const LonLatGeometries& geometries, ArrowParts parts, PolygonEdges edges,
                  ArrowSchema& schema, ArrowArray& array) {
  if (parts == ArrowParts::polygons) {
    export_arrow(geometries.polygons, edges, schema, array);
  } else {
    export_rows(geometries.lines, parts == ArrowParts::points, edges, schema, array);
  }
}

}  // namespace rondel
