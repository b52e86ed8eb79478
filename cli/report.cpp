// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "report.h"

#include <sys/resource.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace rondel::cli {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Tally& tally) {
  return {{"filter", tally.filter},
          {"double_double", tally.double_double},
          {"exact", tally.exact},
          {"perturbed", tally.perturbed}};
}

std::string text_of(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", seconds);
  return text;
}

std::string faces_line(const Triangulation& triangulation) {
  if (triangulation.dimension() < 2) {
    return "no faces: " + std::string(triangulation.num_vertices() < 2
                                          ? "fewer than two vertices"
                                          : "all vertices lie on one great circle");
  }
  std::string line = std::to_string(triangulation.num_faces()) + " faces";
  if (triangulation.num_ghost_faces() > 0) {
    line += ", " + std::to_string(triangulation.num_ghost_faces()) +
            " of them not seen from the center";
  }
  return line;
}

}  // namespace

const char* name_of(Model model) { return model == Model::projected ? "projected" : "weighted"; }

std::string count(std::size_t number, const std::string& one, const std::string& many) {
  return std::to_string(number) + ' ' + (number == 1 ? one : many);
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr std::uint64_t unit = 1024;  // Linux counts ru_maxrss in KiB
  return static_cast<std::uint64_t>(usage.ru_maxrss) * unit;
}

std::string json_report(const Triangulation& triangulation, const Seconds& seconds) {
  const BuildReport& build = triangulation.report();
  const std::size_t ghosts = triangulation.num_ghost_faces();
  const Json json = {{"sites", triangulation.num_sites()},
                     {"vertices", triangulation.num_vertices()},
                     {"faces", triangulation.num_faces()},
                     {"solid_faces", triangulation.num_faces() - ghosts},
                     {"ghost_faces", ghosts},
                     {"duplicates", triangulation.duplicates().size()},
                     {"hidden", triangulation.hidden().size()},
                     {"dimension", triangulation.dimension()},
                     {"model", name_of(triangulation.model())},
                     {"threads", build.threads},
                     {"seconds",
                      {{"read", seconds.read},
                       {"order", build.order_seconds},
                       {"triangulate", build.triangulate_seconds},
                       {"dual", seconds.dual},
                       {"write", seconds.write},
                       {"total", seconds.total}}},
                     {"peak_memory_bytes", peak_memory_bytes()},
                     {"rungs", json_of(build.rungs)}};
  return json.dump(2) + '\n';
}

std::string summary(const Triangulation& triangulation, const Seconds& seconds,
                    const std::string& what, const std::string& output) {
  std::string text = count(triangulation.num_sites(), "site", "sites") + ": " +
                     count(triangulation.num_vertices(), "vertex", "vertices") + ", " +
                     count(triangulation.duplicates().size(), "duplicate", "duplicates");
  if (triangulation.model() == Model::weighted) {
    text += ", " + count(triangulation.hidden().size(), "hidden site", "hidden sites");
  }
  text += '\n' + faces_line(triangulation) + '\n';
  return text + "wrote " + what + " to " + output + " in " + text_of(seconds.total) + '\n';
}

}  // namespace rondel::cli
