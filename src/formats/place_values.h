// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Values that files have at places, as functions on the sphere: linear on triangles between the
// places, and beyond them those of the nearest one. The triangles are those of the file where it has
// a mesh, and else the Delaunay triangulation of the places.
//
// in    places with values, and triangles between them
// out   values anywhere
// index places in the order of the file
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rondel/interpolate.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::formats {

class PlaceValues {
 public:
  // Refers to the places and the values. `triangles` are counterclockwise, or none. If they overlap,
  // they do not count, and `remarks` say so. Of places that are repeated the first one counts;
  // `remarks`, unless null, say where another one has another value.
  PlaceValues(std::span<const Point> places, std::span<const double> values,
              std::span<const Triple> triangles, const Execution& execution,
              std::vector<std::string>* remarks);
  ~PlaceValues();
  PlaceValues(const PlaceValues&) = delete;
  PlaceValues& operator=(const PlaceValues&) = delete;

  // Returns the values at targets. `num_outside`, unless null, gets the number of those that are in no
  // triangle.
  [[nodiscard]] std::vector<double> at(std::span<const Point> targets,
                                       std::size_t* num_outside = nullptr) const;
  // Returns the share of the sphere that the triangles cover.
  [[nodiscard]] double share_of_sphere() const;

 private:
  class InMesh;

  [[nodiscard]] std::vector<double> between_places(std::span<const Point> targets,
                                                   Outside outside) const;

  std::span<const Point> places_;
  std::span<const double> values_;
  const Execution& execution_;
  Triangulation delaunay_;
  std::unique_ptr<const InMesh> mesh_;                // null without triangles
  std::unique_ptr<const Interpolator> interpolator_;  // null with triangles
};

}  // namespace rondel::formats
