// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/regrid_files.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "rondel/names.h"

namespace rondel::python {
namespace {

void add_report(nb::module_& module) {
  nb::class_<RegridFileReport>(module, "RegridFileReport")
      .def_ro("sources", &RegridFileReport::sources)
      .def_ro("targets", &RegridFileReport::targets)
      .def_ro("fields", &RegridFileReport::fields)
      .def_ro("missing", &RegridFileReport::missing)
      .def_ro("tiles", &RegridFileReport::tiles)
      .def_ro("remarks", &RegridFileReport::remarks)
      .def_ro("resumed", &RegridFileReport::resumed)
      .def_ro("extrapolated", &RegridFileReport::extrapolated);
}

// Raises ValueError for a word that is no extrapolation.
Extrapolation extrapolation_of(const std::string& word) {
  const std::optional<Extrapolation> known = extrapolation_named(word);
  if (!known) throw nb::value_error(("there is no extrapolation " + word).c_str());
  return *known;
}

void add_call(nb::module_& module) {
  module.def(
      "regrid_file",
      [](const std::string& in, const std::string& target, const std::string& out,
         const RegridFileOptions& options, unsigned threads, const nb::object& progress) {
        constexpr std::size_t many = std::size_t{1} << 20U;  // a file is worth watching
        return watched(many, threads, progress, [&](const Execution& execution) {
          return regrid_file({in, {}}, {target, {}}, {out, {}}, options, execution);
        });
      },
      nb::arg("path"), nb::arg("target"), nb::arg("out"), nb::arg("options"), nb::arg("threads"),
      nb::arg("progress").none());
}

}  // namespace

void add_regrid_files(nb::module_& module) {
  add_report(module);
  const nb::class_<RegridFileOptions> type_of_options(module, "RegridFileOptions");
  module.def(
      "regrid_options",
      [](const std::vector<std::string>& names, const std::optional<std::string>& source,
         const nb::object& method, nb::handle norm, double max_missing, nb::handle sides,
         nb::handle edges, nb::handle invalid, nb::handle overlap, std::uint64_t memory,
         std::size_t cells_per_tile, int deflate, const std::string& history,
         const std::string& statistics, nb::handle weigh_by, nb::handle corners,
         const std::optional<std::string>& extrapolate, std::optional<double> max_distance_km,
         unsigned num_sources, unsigned exponent, unsigned levels,
         const std::vector<std::pair<std::string, std::string>>& vectors, bool resume,
         nb::handle limiter) {
        RegridFileOptions options;
        options.names = names;
        if (source) options.source = FileName{*source, {}};
        if (!method.is_none()) options.method = named<FieldMethod>("method", method);
        options.norm = named<RemapNorm>("norm", norm);
        options.max_missing = max_missing;
        options.cells = {.sides = named<GridSides>("sides", sides),
                         .edges = named<PolygonEdges>("edges", edges),
                         .invalid = named<InvalidPolygons>("invalid", invalid),
                         .corners = named<MissingCorners>("corners", corners)};
        if (extrapolate) {
          options.extrapolation = ExtrapolationOptions{.method = extrapolation_of(*extrapolate),
                                                       .max_distance_km = max_distance_km,
                                                       .neighbors = num_sources,
                                                       .exponent = exponent,
                                                       .levels = levels};
        }
        options.vectors = vectors;
        options.overlap = named<CellOverlap>("overlap", overlap);
        options.memory = memory;
        options.cells_per_tile = cells_per_tile;
        options.netcdf.deflate = deflate;
        options.history = history;
        options.resume = resume;
        options.limiter = named<RemapLimiter>("limiter", limiter);
        if (!statistics.empty()) options.statistics = zonal_statistics_of(statistics);
        options.statistic_weights = named<ZonalWeights>("weigh_by", weigh_by);
        return options;
      },
      nb::arg("names"), nb::arg("source").none(), nb::arg("method").none(), nb::arg("norm").none(),
      nb::arg("max_missing"), nb::arg("sides").none(), nb::arg("edges").none(),
      nb::arg("invalid").none(), nb::arg("overlap").none(), nb::arg("memory"), nb::arg("tile"),
      nb::arg("deflate"), nb::arg("history"), nb::arg("statistics"), nb::arg("weigh_by").none(),
      nb::arg("corners").none(), nb::arg("extrapolate").none(), nb::arg("max_distance_km").none(),
      nb::arg("num_sources"), nb::arg("exponent"), nb::arg("levels"), nb::arg("vectors"),
      nb::arg("resume"), nb::arg("limiter").none());
  add_call(module);
}

}  // namespace rondel::python
