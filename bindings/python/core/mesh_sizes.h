// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Spacings as Python passes them: numbers at the nodes of the raster, or none if they are the same
// everywhere.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "rondel/mesh_size.h"
#include "rondel/mesh_triangles.h"

namespace rondel::python {

inline constexpr std::size_t many_sites = 1U << 20U;  // from this number on, work is watched

// Returns the raster of the region of an area, or else of the sphere.
inline mesh::SizeRaster raster_of(const mesh::MeshDomain& domain, std::size_t steps) {
  const auto region = mesh::region_of(domain);
  return region ? mesh::SizeRaster(*region, steps) : mesh::SizeRaster(steps);
}

inline std::optional<mesh::SizeFunction> size_of(std::span<const double> spacings,
                                                 const mesh::SizeRaster& raster, double gradient) {
  if (spacings.empty()) return std::nullopt;
  const auto size = mesh::SizeFunction::from_nodes({spacings.begin(), spacings.end()}, raster);
  return gradient > 0 ? size.limited(gradient) : size;
}

// Returns the spacings of a mesh of `count` cells; 0: as they are.
inline mesh::SizeFunction size_along(const std::optional<mesh::SizeFunction>& size,
                                     std::size_t count) {
  if (!size) return mesh::SizeFunction::of_count(count);
  return count == 0 ? *size : size->for_count(count);
}

}  // namespace rondel::python
