// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Texts and JSON objects of reports. The keys of the objects are a contract with programs.
#include "report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "process.h"

namespace rondel::cli {
namespace {

using Json = nlohmann::ordered_json;

// Returns how many predicates each rung decided (docs/theory/filters.md).
Json json_of(const Tally& tally) {
  return {{"filter", tally.filter},
          {"extended", tally.extended},
          {"double_double", tally.double_double},
          {"close", tally.close},
          {"exact", tally.exact},
          {"perturbed", tally.perturbed}};
}

// The counts that all reports of triangulations contain.
struct Counts {
  std::uint64_t sites;
  std::uint64_t vertices;
  std::uint64_t faces;
  std::uint64_t ghost_faces;
  std::uint64_t duplicates;
  std::uint64_t hidden;
  int dimension;
  Model model;
};

// A triangulation in memory and one out of core are reported by the same counts.
Counts counts_of(const Triangulation& t) {
  return {t.num_sites(),         t.num_vertices(),  t.num_faces(), t.num_ghost_faces(),
          t.duplicates().size(), t.hidden().size(), t.dimension(), t.model()};
}

Counts counts_of(const OutOfCoreReport& report, Model model) {
  return {report.num_sites,      report.num_vertices, report.num_faces, report.num_ghost_faces,
          report.num_duplicates, report.num_hidden,   report.dimension, model};
}

Json json_of(const Counts& counts) {
  return {{"sites", counts.sites},
          {"vertices", counts.vertices},
          {"faces", counts.faces},
          {"solid_faces", counts.faces - counts.ghost_faces},
          {"ghost_faces", counts.ghost_faces},
          {"duplicates", counts.duplicates},
          {"hidden", counts.hidden},
          {"dimension", counts.dimension},
          {"model", name_of(counts.model)}};
}

// Returns the second line of a summary: the faces, or why there are none.
std::string faces_line(const Counts& counts) {
  if (counts.dimension < 2) {
    return "no faces: " + std::string(counts.vertices < 2 ? "fewer than two vertices"
                                                          : "all vertices lie on one great circle");
  }
  std::string line = std::to_string(counts.faces) + " faces";
  if (counts.ghost_faces > 0)
    line += ", " + std::to_string(counts.ghost_faces) + " of them not seen from the center";
  return line;
}

}  // namespace

void tell(const std::string& file, const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) {
    std::fprintf(stderr, "rondel: %s: %s\n", file.c_str(), remark.c_str());
  }
}

void tell(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) std::fprintf(stderr, "rondel: %s\n", remark.c_str());
}

std::string text_of_seconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", seconds);
  return text;
}

std::string count(std::size_t number, const std::string& one, const std::string& many) {
  return std::to_string(number) + ' ' + (number == 1 ? one : many);
}

namespace {

// Returns the object that reports of triangulations and hulls share.
Json contract(const Triangulation& triangulation, const Seconds& seconds) {
  const BuildReport& build = triangulation.report();
  Json json = json_of(counts_of(triangulation));
  json["builder"] = name_of(build.builder);
  json["threads"] = build.threads;
  json["seconds"] = {{"read", seconds.read},
                     {"order", build.order_seconds},
                     {"triangulate", build.triangulate_seconds},
                     {"dual", seconds.dual},
                     {"write", seconds.write},
                     {"total", seconds.total}};
  json["peak_memory_bytes"] = peak_memory_bytes();
  json["rungs"] = json_of(build.rungs);
  return json;
}

// Returns the first line of a summary: what became of the sites.
std::string sites_line(const Counts& counts) {
  std::string text = count(counts.sites, "site", "sites") + ": " +
                     count(counts.vertices, "vertex", "vertices") + ", " +
                     count(counts.duplicates, "duplicate", "duplicates");
  if (counts.model == Model::weighted)
    text += ", " + count(counts.hidden, "hidden site", "hidden sites");
  return text;
}

// Returns a number with ten digits.
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// Returns what a hull is: a solid, or a polygon, segment or point.
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
                        std::uint64_t unlocated, std::optional<std::size_t> without_value) {
  Json json = contract(triangulation, seconds);
  json["unlocated"] = unlocated;
  if (without_value) json["without_value"] = *without_value;
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
  const Counts counts = counts_of(triangulation);
  return sites_line(counts) + '\n' + faces_line(counts) + '\n' + "wrote " + what + " to " + output +
         " in " + text_of_seconds(seconds.total) + '\n';
}

std::string out_of_core_json_report(const OutOfCoreReport& report, Model model,
                                    const Seconds& seconds) {
  Json json = json_of(counts_of(report, model));
  json["buckets"] = report.num_buckets;
  json["resumed_buckets"] = report.num_resumed;
  json["open_sites"] = report.num_open_sites;
  json["seconds"] = {{"total", seconds.total}};
  json["peak_memory_bytes"] = peak_memory_bytes();
  return json.dump(2) + '\n';
}

std::string out_of_core_summary(const OutOfCoreReport& report, Model model, const Seconds& seconds,
                                const std::string& output) {
  const Counts counts = counts_of(report, model);
  std::string buckets = "in " + count(report.num_buckets, "bucket", "buckets");
  if (report.num_resumed > 0)
    buckets += ", " + std::to_string(report.num_resumed) + " of them done before";
  return sites_line(counts) + '\n' + faces_line(counts) + ", " + buckets + '\n' +
         "wrote the triangulation to " + output + " in " + text_of_seconds(seconds.total) + '\n';
}

std::string hull_summary(const Triangulation& hull, const HullSize& size, const Seconds& seconds,
                         const std::string& output) {
  return sites_line(counts_of(hull)) + '\n' + hull_line(hull, size) + '\n' + "wrote the hull to " +
         output + " in " + text_of_seconds(seconds.total) + '\n';
}

}  // namespace rondel::cli
