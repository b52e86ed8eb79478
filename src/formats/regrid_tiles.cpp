// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_tiles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "rondel/error.h"
#include "rondel/names.h"
#include "rondel/regrid.h"

namespace rondel::formats {

PlaceTiles::PlaceTiles(const RegridSide& source, const RegridSide& target, FieldMethod method,
                       const FileName& mesh, std::size_t targets_per_tile,
                       const Execution& execution)
    : source_(source),
      target_(target),
      method_(method),
      targets_per_tile_(std::max<std::size_t>(targets_per_tile, 1)),
      targets_(target.places()) {
  if (method == FieldMethod::native) {
    native_ = read_native_cells(mesh, source.places());
    remarks_ = native_.remarks;
  } else if (method != FieldMethod::bilinear) {
    triangulate(execution);
  } else {
    require_axes(source);
    coincident_ = repeated_places(*source.axes());
  }
}

void PlaceTiles::require_axes(const RegridSide& source) {
  if (source.axes() != nullptr) return;
  throw FileError(source.name() +
                  ": the method bilinear needs a grid along axes of longitude and latitude; "
                  "linear takes any places");
}

// A source has its place, and a site with six faces that are located; gradients of a source are a
// matrix of its neighbors. A target has its place, twice, and the weights of a row.
RegridCost PlaceTiles::cost_of(FieldMethod method) {
  constexpr std::uint64_t of_place = 2 * sizeof(LonLat);
  constexpr std::uint64_t of_site = 300;
  constexpr std::uint64_t of_gradient = 1100;
  const auto with = [](std::uint64_t of_source, std::uint64_t of_row) {
    return RegridCost{.of_source = of_source,
                      .of_target = of_place + of_row,
                      .of_source_beside = of_source,
                      .of_target_beside = of_place,
                      .of_cell_in_tile = 2 * of_row};
  };
  switch (method) {
    case FieldMethod::bilinear: {
      // The axes are looked at for each tile.
      RegridCost cost = with(95, 100);
      cost.smallest_tile = std::uint64_t{1} << 17U;
      return cost;
    }
    case FieldMethod::nearest:
      return with(of_site, 60);
    case FieldMethod::linear:
      return with(of_site, 120);
    case FieldMethod::hermite:
    case FieldMethod::cubic:
      return with(of_site + of_gradient, 900);
    default:
      return with(of_site, 200);
  }
}

// Sites are the sources that take part.
void PlaceTiles::triangulate(const Execution& execution) {
  std::vector<Point> sites;
  const std::vector<LonLat> places = source_.places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool is_masked = !source_.mask().empty() && source_.mask()[i] == 0;
    if (is_masked || std::isnan(places[i].lon_deg) || std::isnan(places[i].lat_deg)) continue;
    numbers_.push_back(static_cast<Index>(i));
    sites.push_back(unit_vector(places[i]));
  }
  Triangulation triangulation = delaunay(sites, {}, execution);
  std::size_t num_told = 0;
  for (const auto& [site, representative] : triangulation.duplicates()) {
    const Duplicate pair{numbers_[site], numbers_[representative]};
    coincident_.push_back(pair);
    if (!is_usual(places[pair.site], places[pair.representative])) ++num_told;
  }
  interpolator_.emplace(std::move(triangulation));
  if (num_told == 0) return;
  remarks_.push_back(std::to_string(num_told) + " of " + std::to_string(places.size()) +
                     " places are those of others before them; at each place the first value that "
                     "is there counts");
}

// A grid along axes has as many points at a pole as anywhere, and may go around the globe.
bool PlaceTiles::is_usual(const LonLat& a, const LonLat& b) const {
  if (source_.axes() == nullptr) return false;
  return std::abs(a.lat_deg) == 90 || std::abs(a.lon_deg - b.lon_deg) > 180;
}

std::size_t PlaceTiles::num_tiles() const {
  return (targets_.size() + targets_per_tile_ - 1) / targets_per_tile_;
}

std::size_t PlaceTiles::num_targets(std::size_t tile) const {
  return std::min(targets_per_tile_, targets_.size() - tile * targets_per_tile_);
}

// Masked targets have no value.
RemapTile PlaceTiles::tile(std::size_t number, const Execution& execution) const {
  RemapTile result;
  const std::size_t begin = number * targets_per_tile_;
  result.targets.resize(num_targets(number));
  std::iota(result.targets.begin(), result.targets.end(), static_cast<Index>(begin));
  result.weights = weights_at(std::span(targets_).subspan(begin, result.targets.size()), execution);
  if (target_.mask().empty()) return result;
  const auto mask = std::span(target_.mask()).subspan(begin, result.targets.size());
  result.weights = with_rows(result.weights, mask);
  return result;
}

Weights PlaceTiles::weights_at(std::span<const LonLat> places, const Execution& execution) const {
  if (method_ == FieldMethod::bilinear) {
    const LonLatAxes& axes = *source_.axes();
    try {
      const Weights weights = bilinear_weights(axes, places, rounding_of(axes));
      return source_.mask().empty() ? weights : without_columns(weights, source_.mask());
    } catch (const InvalidInput& error) {
      throw FileError(source_.name() + ": " + error.what());
    }
  }
  if (method_ == FieldMethod::native) {
    return native_weights(native_.cells, unit_vectors(places), execution);
  }
  InterpolationOptions options;
  options.method = *from_name<Method>(name_of(method_));
  options.hashes = false;
  Weights weights = interpolator_->weights(unit_vectors(places), options, execution);
  for (Index& column : weights.columns) column = numbers_[column];
  weights.num_columns = source_.num_places();
  return weights;
}

void take_values_that_are_there(std::span<const Duplicate> coincident, std::size_t sources,
                                std::span<double> values) {
  for (; !values.empty(); values = values.subspan(sources)) {
    for (const auto& [site, representative] : coincident) {
      if (std::isnan(values[representative])) values[representative] = values[site];
    }
    for (const auto& [site, representative] : coincident) {
      if (std::isnan(values[site])) values[site] = values[representative];
    }
  }
}

}  // namespace rondel::formats
