// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/arrow.h"

#include <nanobind/nanobind.h>

#include <cstddef>
#include <utility>

#include "arrays.h"
#include "module.h"
#include "named.h"
#include "rondel/geometries.h"
#include "rondel/regions.h"

namespace rondel::python {
namespace {

// Releases a struct of Arrow that nobody has taken.
template <class Struct>
void destroy(void* made) noexcept {
  auto* const given = static_cast<Struct*>(made);
  if (given->release != nullptr) given->release(given);
  delete given;
}

// Returns the two capsules of Arrow's PyCapsule interface.
nb::tuple capsules_of(const LonLatRegions& drawn, std::size_t num_cells, nb::handle edges) {
  const LonLatMultiPolygons features = multipolygons(drawn, num_cells);
  nb::capsule schema(new ArrowSchema{}, "arrow_schema", destroy<ArrowSchema>);
  nb::capsule array(new ArrowArray{}, "arrow_array", destroy<ArrowArray>);
  export_arrow(features, named<PolygonEdges>("edges", edges),
               *static_cast<ArrowSchema*>(schema.data()), *static_cast<ArrowArray*>(array.data()));
  return nb::make_tuple(std::move(schema), std::move(array));
}

// Returns polygons that another library has handed over.
LonLatGeometries geometries_of_capsules(const nb::capsule& schema, const nb::capsule& array) {
  LonLatGeometries made;
  made.polygons = import_arrow(*static_cast<const ArrowSchema*>(schema.data("arrow_schema")),
                               *static_cast<const ArrowArray*>(array.data("arrow_array")));
  made.lines.offsets.resize(made.polygons.offsets.size());
  return made;
}

}  // namespace

void add_arrow(nb::module_& module) {
  module.def("capsules_of", capsules_of, nb::arg("drawn"), nb::arg("num_cells"), nb::arg("edges"));
  module.def("geometries_of_capsules", geometries_of_capsules, nb::arg("schema"), nb::arg("array"));
}

}  // namespace rondel::python
