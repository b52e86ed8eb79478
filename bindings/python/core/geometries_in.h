// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Geometries that Python passes: as arrays of positions, or as bytes of GeoJSON.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/variant.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "file_name.h"
#include "rondel/feature_cells.h"
#include "rondel/geometries.h"
#include "rondel/polygon_files.h"

namespace rondel::python {

using GeometriesIn = std::variant<nb::bytes, const LonLatGeometries*>;

// Calls read(FileName) for bytes of GeoJSON, or read(LonLatGeometries). Returns its result.
template <class Read>
auto read_geometries(const GeometriesIn& given, const Read& read) {
  if (const auto* const arrays = std::get_if<const LonLatGeometries*>(&given))
    return read(**arrays);
  return read_from(std::get<nb::bytes>(given), read);
}

// Returns the polygons as cells.
inline CellTable cells_in(const FileName& file, const PolygonOptions& options,
                          const Execution& execution) {
  return read_polygons(file, options, execution);
}
inline CellTable cells_in(const LonLatGeometries& arrays, const PolygonOptions& options,
                          const Execution& execution) {
  return cells_of_polygons(arrays.polygons, options, execution);
}

// Returns what is wrong with each polygon.
inline std::vector<std::string> faults_in(const FileName& file, const PolygonOptions& options,
                                          const Execution& execution) {
  return polygon_faults(file, options, execution);
}
inline std::vector<std::string> faults_in(const LonLatGeometries& arrays,
                                          const PolygonOptions& options,
                                          const Execution& execution) {
  return polygon_faults(arrays.polygons, options, execution);
}

// Returns the points, lines and polygons.
inline FeatureTable features_in(const FileName& file, const PolygonOptions& options,
                                const Execution& execution) {
  return std::move(read_features_together({&file, 1}, options, execution).front());
}
inline FeatureTable features_in(const LonLatGeometries& arrays, const PolygonOptions& options,
                                const Execution& execution) {
  return std::move(features_of_geometries({&arrays, 1}, options, execution).front());
}

}  // namespace rondel::python
