// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/native_weights.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "rondel/cell_set.h"
#include "rondel/contours.h"
#include "rondel/delaunay.h"
#include "rondel/extrapolate.h"
#include "rondel/read_cells.h"

namespace rondel::python {
namespace {

// Returns the cells with these corners, one ring each.
CellRings rings_of(const PairsIn& nodes, const OffsetsIn& offsets, const IndicesIn& corners) {
  CellRings cells;
  const auto ends = rows_of<std::uint64_t>(offsets);
  const auto indices = rows_of<Index>(corners);
  cells.rings.assign(ends.begin(), ends.end());
  cells.corners.assign(indices.begin(), indices.end());
  for (std::size_t i = 1; i < cells.rings.size(); ++i) cells.cells.push_back(i);
  cells.points = unit_vectors(rows_of<LonLat>(nodes));
  return cells;
}

// The weights in the cells of a mesh that Python has as the bytes of netCDF, and the reader's remarks.
struct MeshWeights {
  Weights weights;
  std::vector<std::string> remarks;
};

MeshWeights native_weights_in_mesh(const nb::bytes& content, const PairsIn& places,
                                   const PairsIn& targets, unsigned threads) {
  std::string bytes(content.c_str(), content.size());
  return watched_quietly(targets.shape(0), threads, [&](const Execution& execution) {
    const NativeCells native =
        read_native_cells(FileName::in_memory(bytes, "nc", "the source"), rows_of<LonLat>(places));
    return MeshWeights{
        native_weights(native.cells, unit_vectors(rows_of<LonLat>(targets)), execution),
        native.remarks};
  });
}

// Returns the weights between the places of cells, in the cells of the dual mesh.
Weights native_weights_between(const CellSet& cells, const PairsIn& targets, unsigned threads) {
  return watched_quietly(targets.shape(0), threads, [&](const Execution& execution) {
    const CellRings dual = dual_cells(cells.given_rings(), unit_vectors(cells.places()));
    return native_weights(dual, unit_vectors(rows_of<LonLat>(targets)), execution);
  });
}

// Returns the weights between the nodes of cells, or with centers between these.
Weights native_weights_of(const PairsIn& nodes, const OffsetsIn& offsets, const IndicesIn& corners,
                          const std::optional<PairsIn>& centers, const PairsIn& targets,
                          unsigned threads) {
  return watched_quietly(targets.shape(0), threads, [&](const Execution& execution) {
    CellRings cells = rings_of(nodes, offsets, corners);
    if (centers) cells = dual_cells(cells, unit_vectors(rows_of<LonLat>(*centers)));
    return native_weights(cells, unit_vectors(rows_of<LonLat>(targets)), execution);
  });
}

// Traces contours in the cells between nodes, or with centers between these.
template <class Contours>
Contours native_contours(const PairsIn& nodes, const OffsetsIn& offsets, const IndicesIn& corners,
                         const std::optional<PairsIn>& centers, const NumbersIn& values,
                         const NumbersIn& levels, unsigned threads) {
  return watched_quietly(nodes.shape(0), threads, [&](const Execution& execution) {
    CellRings cells = rings_of(nodes, offsets, corners);
    if (centers) cells = dual_cells(cells, unit_vectors(rows_of<LonLat>(*centers)));
    if constexpr (std::is_same_v<Contours, Isolines>) {
      return isolines(cells, rows_of<double>(values), rows_of<double>(levels), execution);
    } else {
      return bands(cells, rows_of<double>(values), rows_of<double>(levels), execution);
    }
  });
}

template <class Contours>
void add_native_contours(nb::module_& module, const char* name) {
  module.def(name, &native_contours<Contours>, nb::arg("nodes").noconvert(),
             nb::arg("offsets").noconvert(), nb::arg("corners").noconvert(),
             nb::arg("centers").noconvert().none(), nb::arg("values").noconvert(),
             nb::arg("levels").noconvert(), nb::arg("threads"));
}

// Returns what extrapolates to targets of a grid of this shape. Throws ValueError for other methods.
Extrapolator extrapolator_between(const PairsIn& sources, const PairsIn& targets,
                                  const std::vector<std::uint64_t>& shape,
                                  const std::string& method, std::optional<double> max_distance_km,
                                  unsigned num_sources, unsigned exponent, unsigned levels,
                                  const IndicesIn& source_mask, const IndicesIn& target_mask,
                                  unsigned threads) {
  const std::optional<Extrapolation> known = extrapolation_named(method);
  if (!known) throw nb::value_error(("there is no extrapolation " + method).c_str());
  return watched_quietly(targets.shape(0), threads, [&](const Execution& execution) {
    std::vector<Point> points = known_unit_vectors(rows_of<LonLat>(targets));
    CompressedRows<Index> neighbors;
    if (known == Extrapolation::creep) neighbors = target_neighbors(points, shape, execution);
    const ExtrapolationOptions options{.method = *known,
                                       .max_distance_km = max_distance_km,
                                       .neighbors = num_sources,
                                       .exponent = exponent,
                                       .levels = levels};
    return Extrapolator(known_unit_vectors(rows_of<LonLat>(sources)), std::move(points),
                        std::move(neighbors), options, vector_of<std::int32_t>(source_mask),
                        vector_of<std::int32_t>(target_mask));
  });
}

// Returns the values of one field at the targets, those that are missing extrapolated.
ArrayOut<double> filled_values(Extrapolator& extrapolator, const NumbersIn& source_values,
                               const NumbersIn& target_values, unsigned threads) {
  std::vector<double> filled = vector_of<double>(target_values);
  watched_quietly(filled.size(), threads, [&](const Execution& execution) {
    return extrapolator.fill(rows_of<double>(source_values), filled, execution);
  });
  return to_array<double>(std::move(filled));
}

ArrayOut<double> nodes_between_centers(const PairsIn& centers, std::size_t rows,
                                       std::size_t columns) {
  return to_array<double>(unlocked([&] {
    return nodes_between(rows_of<LonLat>(centers), {rows, columns});
  }));
}

}  // namespace

void add_native_weights(nb::module_& module) {
  module.def("native_weights", &native_weights_of, nb::arg("nodes").noconvert(),
             nb::arg("offsets").noconvert(), nb::arg("corners").noconvert(),
             nb::arg("centers").noconvert().none(), nb::arg("targets").noconvert(),
             nb::arg("threads"));
  add_native_contours<Isolines>(module, "native_isolines");
  add_native_contours<Bands>(module, "native_bands");
  nb::class_<MeshWeights>(module, "MeshWeights")
      .def("take_weights", [](MeshWeights& self) { return std::move(self.weights); })
      .def_ro("remarks", &MeshWeights::remarks);
  module.def("native_weights_in_mesh", &native_weights_in_mesh, nb::arg("content"),
             nb::arg("places").noconvert(), nb::arg("targets").noconvert(), nb::arg("threads"));
  module.def("native_weights_between", &native_weights_between, nb::arg("cells"),
             nb::arg("targets").noconvert(), nb::arg("threads"));
  nb::class_<Extrapolator>(module, "Extrapolator")
      .def(
          "filled",
          [](Extrapolator& self, const Weights& weights, unsigned threads) {
            return watched_quietly(weights.num_rows(), threads, [&](const Execution& execution) {
              return self.filled(weights, execution);
            });
          },
          nb::arg("weights"), nb::arg("threads"))
      .def("filled_values", &filled_values, nb::arg("source_values").noconvert(),
           nb::arg("target_values").noconvert(), nb::arg("threads"));
  module.def("extrapolator", &extrapolator_between, nb::arg("sources").noconvert(),
             nb::arg("targets").noconvert(), nb::arg("shape"), nb::arg("method"),
             nb::arg("max_distance_km").none(), nb::arg("num_sources"), nb::arg("exponent"),
             nb::arg("levels"), nb::arg("source_mask").noconvert(),
             nb::arg("target_mask").noconvert(), nb::arg("threads"));
  module.def("nodes_between", &nodes_between_centers, nb::arg("centers").noconvert(),
             nb::arg("rows"), nb::arg("columns"));
}

}  // namespace rondel::python
