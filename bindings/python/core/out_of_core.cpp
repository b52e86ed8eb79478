// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/out_of_core.h"

#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "interrupt.h"
#include "module.h"

namespace rondel::python {
namespace {

nb::dict delaunay_of_file(const std::string& sites, const std::array<std::string, 5>& files,
                          std::uint64_t memory, const std::string& scratch, bool resume,
                          bool radians, bool is_weighted, const std::array<double, 3>& center,
                          double squared_radius, unsigned threads, const nb::object& progress) {
  // The work is always long enough to be watched.
  constexpr std::size_t size = std::numeric_limits<std::size_t>::max();
  const OutOfCoreReport report = watched(size, threads, progress, [&](const Execution& execution) {
    return delaunay_file(sites, {files[0], files[1], files[2], files[3], files[4]},
                         {memory, scratch, resume, radians},
                         make_options(is_weighted, center, squared_radius), execution);
  });
  nb::dict result;
  result["num_sites"] = report.num_sites;
  result["num_vertices"] = report.num_vertices;
  result["num_faces"] = report.num_faces;
  result["num_ghost_faces"] = report.num_ghost_faces;
  result["num_duplicates"] = report.num_duplicates;
  result["num_hidden"] = report.num_hidden;
  result["dimension"] = report.dimension;
  result["num_buckets"] = report.num_buckets;
  result["num_resumed"] = report.num_resumed;
  result["num_open_sites"] = report.num_open_sites;
  return result;
}

}  // namespace

void add_out_of_core(nb::module_& module) {
  module.def("delaunay_file", &delaunay_of_file, nb::arg("sites"), nb::arg("files"),
             nb::arg("memory"), nb::arg("scratch"), nb::arg("resume"), nb::arg("radians"),
             nb::arg("is_weighted"), nb::arg("center"), nb::arg("squared_radius"),
             nb::arg("threads"), nb::arg("progress").none());
}

}  // namespace rondel::python
