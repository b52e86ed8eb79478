// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Vectors on the sphere, such as winds, carried by their components in space: a field for x, y and z each, which
// means and interpolation do not turn, also near poles. At the target the part along the sphere is taken.
//
// in    arrays of eastward and northward components, in the file of the fields
// out   fields of components in space at the sources, and such arrays at the targets
// index arrays and fields as FieldFile has them; places of both sides
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "exact/angles.h"
#include "formats/regrid_side.h"
#include "rondel/fields.h"
#include "rondel/types.h"

namespace rondel::formats {

// The directions along the sphere at a place.
struct EastAndNorth {
  Point east;
  Point north;
};

// The directions to the east and to the north at places.
class SideDirections {
 public:
  explicit SideDirections(const RegridSide& side);

  [[nodiscard]] EastAndNorth at(std::size_t place) const;

 private:
  std::size_t row_ = 0;  // places of a row of a grid along axes; 0: one angle for each place
  std::vector<exact::SineCosine> lons_;
  std::vector<exact::SineCosine> lats_;
};

class RegridVectors {
 public:
  // Pairs of names: the eastward and the northward components. Throws FileError, with the name of the file, for
  // a name that is no array of the file, arrays that have other dimensions than each other, and those of
  // which the file says that they are no such components.
  RegridVectors(const FieldFile& file, const std::string& file_name,
                std::span<const std::pair<std::string, std::string>> names,
                const RegridSide& source, const RegridSide& target);

  // Returns how many fields stand for one of an array: 3, or 1 for an array that is no component.
  [[nodiscard]] std::size_t components(std::size_t array) const;
  // Reads fields of an array, as many as `out` has room for; those of vectors as x, y and z in turn.
  void read(std::size_t array, std::size_t first, std::span<double> out,
            const Execution& execution) const;
  // Does the same for some points of one field.
  void read_points(std::size_t array, std::size_t field, std::size_t first_point,
                   std::span<double> out) const;
  // Returns the fields of an array at targets from those that stand for them there. Without `targets` they are
  // at all of them.
  [[nodiscard]] std::vector<double> at_targets(std::size_t array, std::vector<double> fields,
                                               std::span<const Index> targets = {}) const;

 private:
  struct VectorArrays {
    std::size_t east;
    std::size_t north;
  };
  [[nodiscard]] const VectorArrays* pair_of(std::size_t array) const;
  // Turns two components, in the first two thirds of `out`, into three in space.
  void to_space(std::size_t first_point, std::span<double> out) const;

  const FieldFile& file_;
  std::size_t sources_;
  std::size_t targets_;
  std::vector<VectorArrays> pairs_;
  std::vector<SideDirections> frames_;  // of the sources and the targets, if there are pairs
};

}  // namespace rondel::formats
