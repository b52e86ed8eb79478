// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How long work is done: by how many threads, who hears how far it is, and what ends it early. The
// result never depends on any of this.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "rondel/rondel.h"

namespace {

// A spiral from the south pole to the north.
std::vector<rondel::LonLat> spiral(std::size_t n) {
  constexpr double degrees = 57.29577951308232;
  constexpr double golden_angle_deg = 137.50776405003785;
  std::vector<rondel::LonLat> positions(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double z = (2 * static_cast<double>(i) + 1) / static_cast<double>(n) - 1;
    positions[i] = {std::fmod(static_cast<double>(i) * golden_angle_deg, 360),
                    std::asin(z) * degrees};
  }
  return positions;
}

}  // namespace

int main() {
  const rondel::Sites sites(rondel::unit_vectors(spiral(200000)));

  // Another thread, a window or a handler of signals may set the flag; here it is the progress.
  std::atomic<bool> stop = false;
  rondel::Execution execution;
  execution.threads = 2;
  execution.stop = &stop;
  execution.progress = [&stop](std::string_view stage, double fraction) {
    if (stage == "triangulate" && fraction > 0) stop = true;
  };
  try {
    rondel::delaunay(sites, {}, execution);
  } catch (const rondel::Interrupted& error) {
    std::printf("the build: %s\n", error.what());
  }

  stop = false;
  execution.progress = nullptr;
  const rondel::Triangulation triangulation = rondel::delaunay(sites, {}, execution);
  std::printf("%zu faces, built by %s\n", triangulation.num_faces(),
              rondel::name_of(triangulation.report().builder));
}
