// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "field_carrier.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rondel::cli {

namespace {

// Throws FileError for two sites in one place, if the options say so.
void count_duplicates(const InterpolationOptions& options, const SiteTable& table,
                      const Triangulation& triangulation, InterpolateCounts& counts) {
  const auto duplicates = triangulation.duplicates();
  if (options.shared_place == SharedPlace::error && !duplicates.empty()) {
    throw FileError(table.where(duplicates.front().site) + " is in the same place as " +
                    table.where(duplicates.front().representative));
  }
  counts.duplicates = std::max(counts.duplicates, duplicates.size());
}

}  // namespace

Triangulation triangulated(Job& job, const InterpolationOptions& options, const SiteTable& table,
                           InterpolateCounts& counts) {
  Triangulation triangulation = job.triangulate(table);
  count_duplicates(options, table, triangulation, counts);
  return triangulation;
}

EdgeTable kept_edges(const EdgeTable& edges, const SiteTable& table,
                     const std::vector<bool>& is_kept) {
  std::vector<Index> numbers(is_kept.size(), no_index);
  Index number = 0;
  for (std::size_t i = 0; i < is_kept.size(); ++i) {
    if (is_kept[i]) numbers[i] = number++;
  }
  EdgeTable kept = edges;
  for (std::size_t k = 0; k < kept.constraints.size(); ++k) {
    for (Index& site : kept.constraints[k]) {
      if (!is_kept[site]) {
        throw FileError(edges.places[k] + ": " + table.where(site) +
                        " has no value, but an edge of --constraints ends there");
      }
      site = numbers[site];
    }
  }
  return kept;
}

TableInterpolator::TableInterpolator(Job& job, const InterpolateMethod& method,
                                     const SiteTable& table, InterpolateCounts& counts)
    : options_(method.options),
      linear_{.outside = options_.outside,
              .shared_place = options_.shared_place,
              .normalization = options_.normalization,
              .hashes = options_.hashes},
      either_(made(job, method, table, counts)) {}

TableInterpolator::Either TableInterpolator::made(Job& job, const InterpolateMethod& method,
                                                  const SiteTable& table,
                                                  InterpolateCounts& counts) {
  if (method.edges == nullptr) {
    delaunay_ = triangulated(job, method.options, table, counts);
    return Interpolator(delaunay_);
  }
  const auto result = with_edges(*method.edges, table.name, "", [&] {
    return constrained_delaunay(Sites::view(table.sites), method.edges->constraints,
                                {.sphere = job.sphere()}, job.execution());
  });
  count_duplicates(method.options, table, result.triangulation, counts);
  return ConstrainedInterpolator(result);
}

std::vector<double> TableInterpolator::values(std::span<const double> field,
                                              std::span<const Point> targets,
                                              const Execution& execution) const {
  if (const auto* plain = std::get_if<Interpolator>(&either_)) {
    return plain->values(field, targets, options_, execution);
  }
  return std::get<ConstrainedInterpolator>(either_).values(field, targets, linear_, execution);
}

Weights TableInterpolator::weights(std::span<const Point> targets,
                                   const Execution& execution) const {
  if (const auto* plain = std::get_if<Interpolator>(&either_)) {
    return plain->weights(targets, options_, execution);
  }
  return std::get<ConstrainedInterpolator>(either_).weights(targets, linear_, execution);
}

std::vector<double> FieldCarrier::carry(const std::vector<double>& values) {
  std::vector<double> carried(targets_.table.sites.size());
  if (weights_) {
    job_.time(Stage::query, [&] { apply(*weights_, values, carried, 1, {}, job_.execution()); });
  } else {
    carried = interpolated(values);
    for (std::size_t i = 0; i < targets_.side.mask.size(); ++i) {
      if (targets_.side.mask[i] == 0) carried[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  if (extrapolator_ != nullptr) {
    job_.time(Stage::query, [&] {
      counts_.extrapolated += extrapolator_->fill(values, carried, job_.execution());
    });
  }
  counts_.missing += static_cast<std::size_t>(
      std::ranges::count_if(carried, [](double value) { return std::isnan(value); }));
  return carried;
}

std::vector<double> FieldCarrier::interpolated(std::vector<double> values) {
  std::vector<bool> is_known;
  is_known.reserve(values.size());
  for (const double value : values) is_known.push_back(!std::isnan(value));
  const bool is_whole = std::ranges::find(is_known, false) == is_known.end();
  std::optional<TableInterpolator>& interpolator = is_whole ? whole_ : partial_;
  if (!is_whole && is_known != is_known_) interpolator.reset();
  if (is_whole && !interpolator) interpolator.emplace(job_, method_, table_, counts_);
  if (!is_whole) {
    counts_.left_out += std::erase_if(values, [](double value) { return std::isnan(value); });
    if (!interpolator) {
      kept_ = table_.selection(is_known);
      EdgeTable edges;
      if (method_.edges != nullptr) edges = kept_edges(*method_.edges, table_, is_known);
      const EdgeTable* const between = method_.edges != nullptr ? &edges : nullptr;
      interpolator.emplace(job_, InterpolateMethod{method_.options, between}, kept_, counts_);
      is_known_ = std::move(is_known);
    }
  }
  std::vector<double> carried;
  job_.time(Stage::query, [&] {
    carried = with_places(targets_.table, [&] {
      return interpolator->values(values, targets_.table.sites, job_.execution());
    });
  });
  return carried;
}

}  // namespace rondel::cli
