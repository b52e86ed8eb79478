// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes isolines and bands as GeoJSON (RFC 7946): write_isolines() and write_bands().
//
// The file is a FeatureCollection. A feature of isolines has the property `level` and a
// MultiLineString; one of bands has `low` and `high` (null for the first and the last band, which
// are open) and a MultiPolygon. Several threads draw the geometries, and one writes them in order.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/cell_formats.h"
#include "io/ending.h"
#include "io/flat_arrays.h"
#include "io/geojson_writer.h"
#include "io/number.h"
#include "map/arc.h"
#include "map/merged_points.h"
#include "map/planar_loops.h"
#include "map/region.h"
#include "map/ring_area.h"
#include "map/valid_regions.h"
#include "rondel/contours.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::formats {
namespace {

// The arguments of write_isolines().
struct IsolinesToWrite {
  const Isolines& isolines;
  double tolerance;  // radians
  const Execution& execution;
};

// The arguments of write_bands().
struct BandsToWrite {
  const Bands& bands;
  double tolerance;  // radians
  const Execution& execution;
};

// Joins texts that end with a comma, without the last comma.
std::string joined(std::span<const std::string> texts) {
  std::string all;
  for (const std::string& text : texts) all += text;
  if (!all.empty()) all.pop_back();
  return all;
}

// Returns `count` texts, one for each item; several threads call append(text, item).
std::vector<std::string> made_texts(
    const Execution& execution, std::size_t count,
    const std::function<void(std::string& text, std::size_t item)>& append) {
  constexpr std::size_t grain = 16;
  std::vector<std::string> texts(count);
  system::parallel_for(execution.threads, count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) append(texts[i], i);
  });
  return texts;
}

// Writes a feature for each level, with the parts of its lines.
void write_isolines_geojson(io::AtomicFile& file, const IsolinesToWrite& job) {
  const Isolines& isolines = job.isolines;
  const std::vector<std::string> texts =
      made_texts(job.execution, isolines.num_lines(), [&](std::string& text, std::size_t line) {
        const auto points = isolines.lines.rows[line];
        const bool is_closed = isolines.is_closed[line] != 0;
        // A line is cut where it crosses the antimeridian.
        for (const auto& part : map::line_parts(points, is_closed, job.tolerance)) {
          io::append_positions(text, part);
          text += ',';
        }
      });
  file.write(io::features_begin);
  for (std::size_t k = 0; k < isolines.levels.size(); ++k) {
    std::string text;
    io::begin_feature(text, k == 0);
    text += R"("level":)";
    io::append_number(text, isolines.levels[k]);
    text += io::geometry_begin;
    const std::vector<std::uint64_t>& ends = isolines.lines.offsets;
    io::append_multi_line(text, joined(std::span(texts).subspan(ends[k], ends[k + 1] - ends[k])));
    file.write(text + '}');
  }
  file.write(io::features_end);
}

// True if each arc of the rings occurs in the other direction too, so that the bands cover the
// sphere.
bool is_closed_surface(const Bands& bands) {
  using Arc = std::array<double, 6>;
  std::vector<Arc> arcs;
  for (std::size_t ring = 0; ring < bands.rings().size(); ++ring) {
    const auto points = bands.rings()[ring];
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Point& p = points[k];
      const Point& q = points[k + 1 < points.size() ? k + 1 : 0];
      arcs.push_back({p.x, p.y, p.z, q.x, q.y, q.z});
    }
  }
  std::ranges::sort(arcs);
  return std::ranges::all_of(arcs, [&](const Arc& a) {
    return std::ranges::binary_search(arcs, Arc{a[3], a[4], a[5], a[0], a[1], a[2]});
  });
}

// True if it is not known on which side of its lines the region is.
bool is_unsure(const map::DrawnRegion& region) {
  return region.border != map::BorderKnowledge::is_known;
}

// If the bands cover the sphere, one of them contains the border of the map. If it is not known
// which, it is the first one for which it seems so, or else the first one.
void find_border(const Bands& bands, std::vector<map::DrawnRegion>& drawn) {
  using map::BorderKnowledge;
  // If the bands with known borders cover more than half of the map, its border is in one of them.
  double covered = 0;
  for (const map::DrawnRegion& region : drawn) {
    for (const map::Loop& loop : region.loops)
      covered += is_unsure(region) ? 0 : map::doubled_loop_area(loop) / 2;
  }
  constexpr double half_of_map = 180 * 180;
  if (covered > half_of_map || !is_closed_surface(bands)) return;
  auto chosen = std::ranges::find(drawn, BorderKnowledge::seems_inside, &map::DrawnRegion::border);
  if (chosen == drawn.end()) chosen = std::ranges::find_if(drawn, is_unsure);
  chosen->loops.push_back(map::border_loop());
}

// Returns the rings of a band as unit vectors.
std::vector<map::UnitVectors> rings_of_band(const Bands& bands, std::span<const Point> points,
                                            std::size_t band) {
  const auto& [bands_ends, polygons] = bands.bands;
  const std::vector<std::uint64_t>& ends = polygons.rows.offsets;
  std::vector<map::UnitVectors> rings;
  for (auto ring = polygons.offsets[bands_ends[band]];
       ring < polygons.offsets[bands_ends[band + 1]]; ++ring) {
    rings.push_back(points.subspan(ends[ring], ends[ring + 1] - ends[ring]));
  }
  return rings;
}

// If the lines of a band do not tell on which side of them it is, its area does, computed from its
// points before they were merged.
map::BorderKnowledge border_by_area(std::span<const map::UnitVectors> rings) {
  const double area = map::areas_on_left(rings);
  return area < 0 || area > 2 * std::numbers::pi ? map::BorderKnowledge::seems_inside
                                                 : map::BorderKnowledge::seems_outside;
}

// Returns the polygons of each band; a band is drawn as one region, since its polygons may touch in
// points.
std::vector<map::PolygonsOfRegion> draw_bands(const BandsToWrite& job) {
  const Bands& bands = job.bands;
  const std::vector<Point> points = map::merged_points(bands.rings().values);
  std::vector<map::DrawnRegion> drawn(bands.num_bands());
  system::parallel_for(
      job.execution.threads, drawn.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t band = begin; band < end; ++band) {
          if (bands.bands.offsets[band] == bands.bands.offsets[band + 1]) continue;
          drawn[band] = map::draw_region(rings_of_band(bands, points, band), job.tolerance);
          if (is_unsure(drawn[band]))
            drawn[band].border = border_by_area(rings_of_band(bands, bands.rings().values, band));
        }
      });
  const bool may_overlap = std::ranges::any_of(drawn, is_unsure);
  if (may_overlap) find_border(bands, drawn);
  std::vector<map::LoopsOfRegion> loops;
  loops.reserve(drawn.size());
  for (map::DrawnRegion& region : drawn) loops.push_back(std::move(region.loops));
  return map::valid_regions(std::move(loops), job.execution.threads, may_overlap);
}

// Writes a feature for each band; band k lies between the levels k - 1 and k.
void write_bands_geojson(io::AtomicFile& file, const BandsToWrite& job) {
  const Bands& bands = job.bands;
  const std::vector<map::PolygonsOfRegion> drawn = draw_bands(job);
  file.write(io::features_begin);
  for (std::size_t k = 0; k < bands.num_bands(); ++k) {
    std::string text;
    // Appends a level, or null for the open end of a band.
    const auto append_end = [&](bool is_open, std::size_t level) {
      if (is_open) {
        text += "null";
      } else {
        io::append_number(text, bands.levels[level]);
      }
    };
    io::begin_feature(text, k == 0);
    text += R"("low":)";
    append_end(k == 0, k - 1);
    text += R"(,"high":)";
    append_end(k == bands.levels.size(), k);
    text += io::geometry_begin;
    io::append_multi_polygon(text, drawn[k]);
    file.write(text + '}');
  }
  file.write(io::features_end);
}

using IsolineWriter = io::Writer<IsolinesToWrite>;
using BandWriter = io::Writer<BandsToWrite>;
constexpr std::array<IsolineWriter, 1> isoline_writers = {{{".geojson", &write_isolines_geojson}}};
constexpr std::array<BandWriter, 1> band_writers = {{{".geojson", &write_bands_geojson}}};

}  // namespace
}  // namespace rondel::formats

namespace rondel {

void write_isolines(const FileName& file, const Isolines& isolines, double tolerance_deg,
                    const Execution& execution) {
  const system::Call call(execution);
  const std::size_t num_lines = isolines.is_closed.size();
  const auto& [ends, lines] = isolines.lines;
  io::require_fit(system::are_offsets(ends, isolines.levels.size(), num_lines) &&
                      system::are_offsets(lines.offsets, num_lines, lines.values.size()) &&
                      io::are_unit_vectors(lines.values),
                  "isolines");
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  io::write_whole<formats::IsolinesToWrite>(
      formats::isoline_writers, file, "isolines are written as", {isolines, tolerance, execution});
}

void write_bands(const FileName& file, const Bands& bands, double tolerance_deg,
                 const Execution& execution) {
  const system::Call call(execution);
  const auto& [ends, polygons] = bands.bands;
  const CompressedRows<Point>& rings = bands.rings();
  io::require_fit(system::are_offsets(rings.offsets, rings.values.size()) &&
                      system::are_offsets(polygons.offsets, rings.size()) &&
                      system::are_offsets(ends, bands.num_bands(), polygons.size()) &&
                      io::are_unit_vectors(rings.values),
                  "bands");
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  io::write_whole<formats::BandsToWrite>(formats::band_writers, file, "bands are written as",
                                         {bands, tolerance, execution});
}

}  // namespace rondel
