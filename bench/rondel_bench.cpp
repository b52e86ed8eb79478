// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel_bench KIND N [projected|weighted|hull] [--threads T] [--dual] [--seed S]: measures order,
// triangulation and canonical result of inputs in memory, the first of which has the seed S; with
// --dual also the cells and areas of the last.

#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/rondel.h"

namespace {

using rondel::Point;

struct Task {
  std::string what = "projected";
  unsigned threads = 1;
  bool with_dual = false;
};

Task parse(int argc, char** argv) {
  Task task;
  for (int i = 3; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--dual") {
      task.with_dual = true;
    } else if (word == "--threads" && i + 1 < argc) {
      task.threads = static_cast<unsigned>(std::atoi(argv[++i]));
    } else {
      task.what = word;
    }
  }
  return task;
}

rondel::Triangulation build(const std::vector<Point>& points, const Task& task) {
  const auto sites = rondel::Sites::view(points);
  const rondel::Execution execution{.threads = task.threads};
  if (task.what == "hull") return rondel::convex_hull(sites, execution);
  rondel::Options options;
  if (task.what == "weighted") options.model = rondel::Model::weighted;
  return rondel::delaunay(sites, options, execution);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr,
                 "usage: rondel_bench KIND N [projected|weighted|hull] [--threads T] [--dual] "
                 "[--seed S]\n");
    return 2;
  }
  const Task task = parse(argc, argv);
  rondel::bench::Source source(argv[1], argv[2], seed);
  const auto measured = rondel::bench::measure(
      [&] { return source.next(); },
      [&](const std::vector<Point>& sites) { return build(sites, task); },
      [](const std::vector<Point>& sites, const rondel::Triangulation& triangulation) {
        return rondel::bench::Counts{sites.size(), triangulation.num_vertices(),
                                     triangulation.num_faces()};
      });
  const rondel::Triangulation& triangulation = *measured.result;

  double dual = 0;
  double total_area = 0;
  if (task.with_dual) {
    const rondel::bench::Stopwatch watch;
    const auto diagram = rondel::diagram(triangulation);
    dual = watch.seconds();
    total_area = std::accumulate(diagram.areas.begin(), diagram.areas.end(), 0.0);
  }
  const auto number = [](auto value) { return static_cast<double>(value); };
  const auto& report = triangulation.report();
  rondel::bench::print_json(
      {{"sites", number(measured.counts.sites)},
       {"vertices", number(measured.counts.vertices)},
       {"faces", number(measured.counts.faces)},
       {"seconds", measured.seconds},
       {"first_seconds", measured.first_seconds},
       {"order", report.order_seconds},
       {"triangulate", report.triangulate_seconds},
       {"dual", dual},
       {"total_area", total_area},
       {"bytes_per_site", measured.memory_bytes / number(measured.counts.sites)},
       {"filter", number(report.rungs.filter)},
       {"double_double", number(report.rungs.double_double)},
       {"exact", number(report.rungs.exact)},
       {"perturbed", number(report.rungs.perturbed)}});
}
