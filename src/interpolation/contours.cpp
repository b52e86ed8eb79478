// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Isolines and bands as arrays, from lines that are traced region by region in parallel. The
// regions are appended in their order, so that the result does not depend on the threads.
#include "rondel/contours.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <unordered_map>
#include <utility>

#include "exact/point_order.h"
#include "interpolation/contour_surface.h"
#include "interpolation/contour_tracing.h"
#include "interpolation/flat_faces.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/parallel.h"

namespace rondel {
namespace {

using interpolation::ContourTracer;
using interpolation::RegionKind;
using interpolation::TracedLines;

// Throws InvalidInput unless there is one value for each site.
void require_values(const Triangulation& triangulation, std::span<const double> values) {
  if (values.size() == triangulation.num_sites()) return;
  throw InvalidInput("there are " + std::to_string(values.size()) + " values for " +
                     std::to_string(triangulation.num_sites()) + " sites");
}

// Returns for each site that shares its place with others the site that represents them: the one
// with the smallest coordinates, so that the order of the sites does not matter.
std::unordered_map<Index, Index> find_representatives(const Triangulation& triangulation) {
  const Sites& sites = triangulation.sites();
  std::unordered_map<Index, Index> representatives;
  for (const auto& [site, representative] : triangulation.duplicates()) {
    Index& first_site = representatives.try_emplace(representative, representative).first->second;
    if (exact::is_less(sites[site], sites[first_site])) first_site = site;
  }
  return representatives;
}

// Throws InvalidInput for infinite values, and levels that do not increase.
void require_values_and_levels(std::span<const double> values, std::span<const double> levels) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isinf(values[i])) throw InvalidInput("value " + std::to_string(i) + " is infinite", i);
  }
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const std::string level =
        "level " + std::to_string(k) + ", " + system::shortest_text(levels[k]) + ",";
    if (!std::isfinite(levels[k])) throw InvalidInput(level + " is not finite", k);
    if (k > 0 && !(levels[k - 1] < levels[k])) {
      throw InvalidInput(
          level + " is not above the one before it, " + system::shortest_text(levels[k - 1]), k);
    }
  }
}

// Returns trace(k) for each region k; regions are traced in parallel.
template <class Trace>
std::vector<TracedLines> traced_regions(std::size_t num_regions, const Execution& execution,
                                        const Trace& trace) {
  std::vector<TracedLines> traced(num_regions);
  system::parallel_for(execution.threads, num_regions, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) traced[k] = trace(k);
  });
  return traced;
}

// Appends the rings as polygons: rings of one connected part of the band come one after the other.
void append_polygons(const TracedLines& rings, Bands& out) {
  std::unordered_map<std::uint64_t, std::size_t> polygon_of;
  std::vector<std::vector<std::size_t>> polygons;
  for (std::size_t ring = 0; ring < rings.lines.size(); ++ring) {
    const auto [place, is_new] = polygon_of.try_emplace(rings.component[ring], polygons.size());
    if (is_new) polygons.emplace_back();
    polygons[place->second].push_back(ring);
  }
  for (const std::vector<std::size_t>& polygon : polygons) {
    for (const std::size_t ring : polygon) out.bands.rows.rows.append(rings.lines[ring]);
    out.bands.rows.end_group();
  }
}

// Returns the first value of each place. Throws InvalidInput before values are moved from their
// sites, which a message names.
std::vector<double> sound_values(const Triangulation& triangulation, std::span<const double> values,
                                 std::span<const double> levels) {
  require_values(triangulation, values);
  require_values_and_levels(values, levels);
  return first_values(triangulation, values);
}

}  // namespace

std::vector<double> first_values(const Triangulation& triangulation,
                                 std::span<const double> values) {
  require_values(triangulation, values);
  std::vector<double> first(values.begin(), values.end());
  for (const auto& [site, representative] : triangulation.duplicates()) {
    if (std::isnan(first[representative])) first[representative] = values[site];
  }
  return first;
}

Isolines isolines(const Triangulation& triangulation, std::span<const double> values,
                  std::span<const double> levels, const Execution& execution) {
  const system::Call call(execution);
  const interpolation::ContourSurface surface = interpolation::surface_of(triangulation);
  return interpolation::isolines_on(surface, sound_values(triangulation, values, levels), levels,
                                    execution);
}

Bands bands(const Triangulation& triangulation, std::span<const double> values,
            std::span<const double> levels, const Execution& execution) {
  const system::Call call(execution);
  const interpolation::ContourSurface surface = interpolation::surface_of(triangulation);
  return interpolation::bands_on(surface, sound_values(triangulation, values, levels), levels,
                                 execution);
}

namespace interpolation {

ContourSurface surface_of(const Triangulation& triangulation) {
  if (triangulation.model() == Model::weighted) {
    throw InvalidInput("weighted sites have no isolines");
  }
  const auto ghosts = triangulation.ghost_faces();
  const std::vector<Index> flat = flat_faces_of(triangulation);
  std::vector<Index> left_out;
  left_out.reserve(ghosts.size() + flat.size());
  std::ranges::merge(ghosts, flat, std::back_inserter(left_out));
  return {.faces = triangulation.faces(),
          .neighbors = triangulation.neighbors(),
          .left_out = std::move(left_out),
          .sites = triangulation.sites().points(),
          .center = triangulation.sphere().center,
          .representatives = find_representatives(triangulation)};
}

Isolines isolines_on(const ContourSurface& surface, std::span<const double> values,
                     std::span<const double> levels, const Execution& execution) {
  require_values_and_levels(values, levels);
  ContourTracer tracer(surface, values, levels, RegionKind::from_level_on, execution);
  const std::vector<TracedLines> traced = traced_regions(
      levels.size(), execution, [&](std::size_t level) { return tracer.lines(level + 1); });
  Isolines out;
  out.levels.assign(levels.begin(), levels.end());
  for (const TracedLines& lines : traced) {
    out.lines.rows.append_rows(lines.lines);
    out.lines.end_group();
    out.is_closed.insert(out.is_closed.end(), lines.is_closed.begin(), lines.is_closed.end());
  }
  return out;
}

Bands bands_on(const ContourSurface& surface, std::span<const double> values,
               std::span<const double> levels, const Execution& execution) {
  require_values_and_levels(values, levels);
  ContourTracer tracer(surface, values, levels, RegionKind::band, execution);
  const std::vector<TracedLines> traced = traced_regions(
      tracer.num_regions(), execution, [&](std::size_t region) { return tracer.rings(region); });
  const bool is_without_rings =
      std::ranges::all_of(traced, [](const TracedLines& rings) { return rings.lines.size() == 0; });
  const std::size_t whole = is_without_rings ? tracer.region_without_border() : traced.size();
  Bands out;
  out.levels.assign(levels.begin(), levels.end());
  for (std::size_t k = 0; k < traced.size(); ++k) {
    append_polygons(traced[k], out);
    if (k == whole) out.bands.rows.end_group();
    out.bands.end_group();
  }
  return out;
}

}  // namespace interpolation

}  // namespace rondel
