// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/regrid.h"

#include <optional>

#include "remap.h"
#include "rondel/interpolate.h"

namespace rondel::cli {
namespace {

Weights bilinear_from(const NetcdfSites& grid, const Targets& targets) {
  const std::string& name = grid.table.name;
  const std::optional<LonLatAxes> axes = axes_of_grid(grid.table.positions, grid.shape);
  if (!axes) {
    throw FileError(name +
                    ": --method bilinear needs netCDF with a grid along axes of longitude and "
                    "latitude; --method linear takes any sites");
  }
  try {
    Weights weights = bilinear_weights(*axes, targets.side.points, rounding_of(*axes));
    return grid.mask.empty() ? weights : without_columns(weights, grid.mask);
  } catch (const InvalidInput& error) {  // of the axes: all positions are known to be valid
    throw FileError(name + ": " + error.what());
  }
}

Weights given_to_nearest(Job& job, const NetcdfSites& grid, const Targets& targets) {
  const Triangulation triangulation = job.triangulate(targets.table);
  std::vector<Index> every_target(targets.table.sites.size());
  for (std::size_t t = 0; t < every_target.size(); ++t) every_target[t] = static_cast<Index>(t);
  std::vector<Index> taken;
  const std::vector<bool> takes_part = grid.unmasked();
  for (std::size_t i = 0; i < takes_part.size(); ++i) {
    if (takes_part[i]) taken.push_back(static_cast<Index>(i));
  }
  const SiteTable sources = grid.table.selection(takes_part);
  const Weights weights = with_places(sources, [&] {
    return nearest_d2s_weights(Interpolator(triangulation), sources.sites, job.execution());
  });
  return renumbered(weights, every_target, every_target.size(), taken, takes_part.size());
}

}  // namespace

Weights regrid_weights(Job& job, RegridMethod method, const NetcdfSites& grid,
                       const Targets& targets) {
  Weights weights;
  job.time(Stage::query, [&] {
    weights = method == RegridMethod::bilinear ? bilinear_from(grid, targets)
                                               : given_to_nearest(job, grid, targets);
  });
  weights.sites_hash = point_set_hash(grid.table.sites);
  weights.targets_hash = point_set_hash(targets.table.sites);
  return weights;
}

}  // namespace rondel::cli
