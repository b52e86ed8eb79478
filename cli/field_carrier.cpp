// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "field_carrier.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rondel::cli {

Triangulation triangulated(Job& job, const InterpolationOptions& options, const SiteTable& table,
                           InterpolateCounts& counts) {
  Triangulation triangulation = job.triangulate(table);
  const auto duplicates = triangulation.duplicates();
  if (options.shared_place == SharedPlace::error && !duplicates.empty()) {
    throw FileError(table.where(duplicates.front().site) + " is in the same place as " +
                    table.where(duplicates.front().representative));
  }
  counts.duplicates = std::max(counts.duplicates, duplicates.size());
  return triangulation;
}

std::vector<double> FieldCarrier::carry(const std::vector<double>& values) {
  std::vector<double> carried(targets_.table.sites.size());
  if (weights_) {
    job_.time(Stage::query, [&] { apply(*weights_, values, carried, 1, {}, job_.execution()); });
  } else {
    carried = interpolated(values);
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
  std::optional<Interpolator>& interpolator = is_whole ? whole_ : partial_;
  if (!is_whole && is_known != is_known_) interpolator.reset();
  if (is_whole && !interpolator)
    interpolator.emplace(triangulated(job_, options_, table_, counts_));
  if (!is_whole) {
    counts_.left_out += std::erase_if(values, [](double value) { return std::isnan(value); });
    if (!interpolator) {
      kept_ = table_.selection(is_known);
      interpolator.emplace(triangulated(job_, options_, kept_, counts_));
      is_known_ = std::move(is_known);
    }
  }
  std::vector<double> carried;
  job_.time(Stage::query, [&] {
    carried = with_places(targets_.table, [&] {
      return interpolator->values(values, targets_.table.sites, options_, job_.execution());
    });
  });
  return carried;
}

}  // namespace rondel::cli
