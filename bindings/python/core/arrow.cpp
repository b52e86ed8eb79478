// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/arrow.h"

#include <nanobind/nanobind.h>

#include <cstddef>
#include <utility>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "rondel/cell_set.h"
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

// Returns the cells of polygons that another library has handed over.
CellSet cells_of_capsules(const nb::capsule& schema, const nb::capsule& array, nb::handle edges,
                          nb::handle overlap, nb::handle invalid, unsigned threads) {
  const PolygonOptions options{.edges = named<PolygonEdges>("edges", edges),
                               .invalid = named<InvalidPolygons>("invalid", invalid),
                               .overlap = named<PolygonOverlap>("overlap", overlap)};
  const LonLatMultiPolygons features =
      import_arrow(*static_cast<const ArrowSchema*>(schema.data("arrow_schema")),
                   *static_cast<const ArrowArray*>(array.data("arrow_array")));
  return unlocked([&] {
    const Execution execution{.threads = threads};
    return CellSet::of(cells_of_polygons(features, options, execution), GridSides::parallels,
                       execution);
  });
}

}  // namespace

void add_arrow(nb::module_& module) {
  module.def("capsules_of", capsules_of, nb::arg("drawn"), nb::arg("num_cells"), nb::arg("edges"));
  module.def("cells_of_capsules", cells_of_capsules, nb::arg("schema"), nb::arg("array"),
             nb::arg("edges").none(), nb::arg("overlap").none(), nb::arg("invalid").none(),
             nb::arg("threads"));
}

}  // namespace rondel::python
