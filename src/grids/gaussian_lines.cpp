// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/gaussian_lines.h"

#include <cmath>

#include "exact/angles.h"
#include "meshing/point_rings.h"

namespace rondel::grids {

std::vector<double> gaussian_latitudes(std::size_t number) {
  std::vector<double> latitudes;
  for (const double z : mesh::gaussian_sines(number)) {
    const double radius = std::sqrt((1 - z) * (1 + z));
    latitudes.push_back(exact::argument(z, radius) * exact::degrees_per_radian);
  }
  return latitudes;
}

std::vector<double> lines_between(const std::vector<double>& latitudes) {
  std::vector<double> lines = {90};
  for (std::size_t k = 0; k + 1 < latitudes.size(); ++k) {
    lines.push_back((latitudes[k] + latitudes[k + 1]) / 2);
  }
  lines.push_back(-90);
  return lines;
}

}  // namespace rondel::grids
