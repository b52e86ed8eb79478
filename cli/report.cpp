// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "process.h"

namespace rondel::cli {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Tally& tally) {
  return {{"filter", tally.filter},
          {"extended", tally.extended},
          {"double_double", tally.double_double},
          {"close", tally.close},
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

namespace {

Json contract(const Triangulation& triangulation, const Seconds& seconds) {
  const BuildReport& build = triangulation.report();
  const std::size_t ghosts = triangulation.num_ghost_faces();
  return {{"sites", triangulation.num_sites()},
          {"vertices", triangulation.num_vertices()},
          {"faces", triangulation.num_faces()},
          {"solid_faces", triangulation.num_faces() - ghosts},
          {"ghost_faces", ghosts},
          {"duplicates", triangulation.duplicates().size()},
          {"hidden", triangulation.hidden().size()},
          {"dimension", triangulation.dimension()},
          {"model", name_of(triangulation.model())},
          {"builder", name_of(build.builder)},
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
}

std::string sites_line(const Triangulation& triangulation) {
  std::string text = count(triangulation.num_sites(), "site", "sites") + ": " +
                     count(triangulation.num_vertices(), "vertex", "vertices") + ", " +
                     count(triangulation.duplicates().size(), "duplicate", "duplicates");
  if (triangulation.model() == Model::weighted) {
    text += ", " + count(triangulation.hidden().size(), "hidden site", "hidden sites");
  }
  return text;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string hull_line(const Triangulation& hull, const HullSize& size) {
  if (hull.dimension() == 2) {
    return std::to_string(hull.num_faces()) + " faces, volume " + number(size.volume) +
           ", surface area " + number(size.area);
  }
  if (hull.ring().size() > 2) {
    return "flat: all sites lie in one plane; the area of both sides is " + number(size.area);
  }
  return hull.ring().size() == 2 ? "flat: all sites lie on one line"
                                 : "flat: fewer than two vertices";
}

}  // namespace

std::string json_report(const Triangulation& triangulation, const Seconds& seconds,
                        std::uint64_t unlocated) {
  Json json = contract(triangulation, seconds);
  json["unlocated"] = unlocated;
  return json.dump(2) + '\n';
}

std::string hull_json_report(const Triangulation& hull, const HullSize& size,
                             const Seconds& seconds) {
  Json json = contract(hull, seconds);
  json["flat"] = hull.dimension() < 2;
  json["volume"] = size.volume;
  json["area"] = size.area;
  return json.dump(2) + '\n';
}

std::string summary(const Triangulation& triangulation, const Seconds& seconds,
                    const std::string& what, const std::string& output) {
  return sites_line(triangulation) + '\n' + faces_line(triangulation) + '\n' + "wrote " + what +
         " to " + output + " in " + text_of(seconds.total) + '\n';
}

std::string hull_summary(const Triangulation& hull, const HullSize& size, const Seconds& seconds,
                         const std::string& output) {
  return sites_line(hull) + '\n' + hull_line(hull, size) + '\n' + "wrote the hull to " + output +
         " in " + text_of(seconds.total) + '\n';
}

}  // namespace rondel::cli
