// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the dimensions of a variable that are those of the points.
//
// 1. Where longitudes and latitudes are known, the dimensions are theirs, in the order latitude, longitude of axes, and else in that of
//    the coordinates: a field stored as (time, lon, lat) is that of (time, lat, lon).
// 2. Else it is the dimension with as many entries as there are points, wherever it stands, or dimensions that follow each other and
//    multiply to that. Not so where the file has longitudes and latitudes of as many points: then the variable is no field at them.
// 3. Where the lengths of the points' grid are known and those of the dimensions are the same in reverse, the order is reversed; where
//    they are others, the variable is no field at the points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/netcdf_reader.h"
#include "rondel/conventions.h"
#include "rondel/types.h"

namespace rondel::interpolation {

struct FieldDimensions {
  std::vector<std::size_t>
      leading;  // numbers of the dimensions of the variable that are not those of the points, in their order
  std::vector<std::size_t> points;  // those of the points, the fastest one last
  std::vector<LonLat>
      places;  // degrees; empty if the file does not say where they are, or says it more than once
  std::vector<std::size_t>
      kept;  // which of all have a place, if others are left out; `places` are theirs
  bool is_reversed = false;  // by their lengths alone: nothing says which dimension is which

  // All dimensions, in the order of the values of a FieldArray.
  [[nodiscard]] std::vector<std::size_t> order() const;
};

class FieldDimensionFinder {
 public:
  // `num_points`: 0 for those of the first variable whose places the file says. `shape`: the lengths of the points' grid; empty: not known.
  FieldDimensionFinder(const io::NetcdfReader& file, std::uint64_t num_points,
                       std::span<const std::uint64_t> shape);

  // Nothing if the variable is no field at the points.
  [[nodiscard]] std::optional<FieldDimensions> layout(const io::NetcdfReader::Variable& variable);
  // Whether the variable is a coordinate, bounds, or the numbers of neighbors: no field, unless it is named.
  [[nodiscard]] bool is_auxiliary(const io::NetcdfReader::Variable& variable) const;

 private:
  struct KnownPlaces {
    std::size_t lon;
    std::size_t lat;
    std::vector<std::size_t> dimensions;
    std::vector<std::uint64_t> shape;
    std::vector<LonLat> places;
    std::size_t num_known;  // of those that are not missing
  };
  const KnownPlaces& places_of_pair(const CoordinatePair& pair);
  void leave_out_missing(const KnownPlaces& known, FieldDimensions& layout) const;
  [[nodiscard]] std::optional<FieldDimensions> by_coordinates(
      const io::NetcdfReader::Variable& variable);
  [[nodiscard]] std::optional<FieldDimensions> by_lengths(
      const io::NetcdfReader::Variable& variable);
  using DimensionSet = std::set<std::size_t>;
  // The dimensions of the longitudes and latitudes in the file of as many points, a set for each pair.
  const std::vector<DimensionSet>& sets_of_places();
  [[nodiscard]] bool may_be_of_places(const io::NetcdfReader::Variable& variable,
                                      std::span<const std::size_t> points);
  [[nodiscard]] std::vector<std::size_t> run_of_points(
      const io::NetcdfReader::Variable& variable) const;

  const io::NetcdfReader& file_;
  std::uint64_t num_points_;
  std::vector<std::uint64_t> shape_;
  std::vector<VariableHeader> headers_;
  std::vector<KnownPlaces> known_;
  std::optional<std::vector<DimensionSet>> sets_of_places_;
};

}  // namespace rondel::interpolation
