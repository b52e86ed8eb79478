// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/side_areas.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "overlay/prepared_grid.h"
#include "rondel/conventions.h"

namespace rondel::formats {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;
constexpr std::string_view cell_methods_name = "cell_methods";

// Returns the text of the attribute, or null.
std::string* cell_methods_in(FieldArray& array) {
  const auto found =
      std::ranges::find(array.attributes, cell_methods_name, [](const auto& a) { return a.first; });
  return found == array.attributes.end() ? nullptr : &found->second;
}

}  // namespace

bool has_sums_over_cells(const FieldArray& array) {
  return std::ranges::any_of(array.attributes, [](const auto& attribute) {
    return attribute.first == cell_methods_name && are_sums_over_cells(attribute.second);
  });
}

void add_cell_method(std::string_view method, FieldArray& array) {
  if (std::string* const known = cell_methods_in(array)) {
    *known = with_cell_method(*known, method);
  } else {
    array.attributes.emplace_back(cell_methods_name, with_cell_method({}, method));
  }
}

// A grid may have lines in any direction.
SideAreas::SideAreas(RegridSide& side, const Execution& execution) {
  const LonLatGrid* const lines = side.lines_between();
  if (lines == nullptr) {
    rows_ = side.areas(execution);
    return;
  }
  for (std::size_t i = 0; i + 1 < lines->lat_deg.size(); ++i) {
    rows_.push_back(std::abs(overlay::rise_between(lines->lat_deg[i], lines->lat_deg[i + 1])));
  }
  for (std::size_t i = 0; i + 1 < lines->lon_deg.size(); ++i) {
    columns_.push_back(std::abs(lines->lon_deg[i + 1] - lines->lon_deg[i]) * radians_per_degree);
  }
}

double SideAreas::at(std::size_t cell) const {
  if (columns_.empty()) return rows_[cell];
  return rows_[cell / columns_.size()] * columns_[cell % columns_.size()];
}

void SideAreas::divide(std::size_t first, std::span<double> sums) const {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double area = at(first + i);
    sums[i] = area > 0 ? sums[i] / area : std::numeric_limits<double>::quiet_NaN();
  }
}

std::vector<double> areas_of_sums(std::span<const double> target_areas,
                                  std::span<const double> fractions, RemapNorm norm) {
  std::vector<double> areas(target_areas.begin(), target_areas.end());
  if (norm == RemapNorm::destarea) return areas;
  for (std::size_t i = 0; i < areas.size(); ++i) areas[i] *= fractions[i];
  return areas;
}

}  // namespace rondel::formats
