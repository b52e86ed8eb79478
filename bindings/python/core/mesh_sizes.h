// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Spacings as Python passes them: numbers at the nodes of the raster, or none if they are the same
// everywhere.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>

#include "rondel/mesh.h"
#include "rondel/mesh_size.h"

namespace rondel::python {

inline constexpr std::size_t many_sites = 1U << 20U;  // from this number on, work is watched

inline std::optional<mesh::SizeFunction> size_of(std::span<const double> spacings,
                                                 std::size_t steps, double gradient) {
  if (spacings.empty()) return std::nullopt;
  std::size_t next = 0;
  const mesh::SizeFunction size = mesh::SizeFunction::from_function(
      [&](std::span<const Point> places, std::span<double> out) {
        for (double& value : out) value = spacings[next++];
        (void)places;
      },
      steps);
  return gradient > 0 ? size.limited(gradient) : size;
}

// Returns the spacings of a mesh of `count` cells; 0: as they are.
inline mesh::SizeFunction size_along(const std::optional<mesh::SizeFunction>& size,
                                     std::size_t count) {
  const auto cells = static_cast<double>(count);
  if (!size) {
    return mesh::SizeFunction::constant(mesh::spacing_of(4 * std::numbers::pi / cells), 1);
  }
  return count == 0 ? *size : size->scaled(std::sqrt(size->count() / cells));
}

}  // namespace rondel::python
