// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The same questions to S2 and to Rondel, for the page that shows this file and what it prints.

#include <s2/s2closest_point_query.h>
#include <s2/s2point_index.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "rondel/rondel.h"

using Places = std::vector<rondel::LonLat>;
using Answers = std::vector<std::vector<unsigned>>;

// With S2
Answers by_s2(const Places& sites, const Places& queries) {
  S2PointIndex<unsigned> index;
  for (unsigned i = 0; i < sites.size(); ++i) {
    index.Add(S2LatLng::FromDegrees(sites[i].lat_deg, sites[i].lon_deg).ToPoint(), i);
  }
  S2ClosestPointQuery<unsigned> query(&index);
  query.mutable_options()->set_max_results(3);
  Answers answers;
  for (const auto& [lon, lat] : queries) {
    S2ClosestPointQuery<unsigned>::PointTarget target(S2LatLng::FromDegrees(lat, lon).ToPoint());
    answers.emplace_back();
    for (const auto& result : query.FindClosestPoints(&target)) {
      answers.back().push_back(result.data());
    }
  }
  return answers;
}

// With Rondel
Answers by_rondel(const Places& sites, const Places& queries) {
  const rondel::Locator locator(rondel::delaunay(rondel::unit_vectors(sites)));
  Answers answers;
  for (const auto& query : queries) {
    answers.push_back(locator.k_nearest(rondel::unit_vector(query), 3));
  }
  return answers;
}
// The end

int main() {
  std::mt19937_64 random(1);
  const auto next = [&] { return static_cast<double>(random() >> 11) / 0x1p52 - 1; };
  const auto places = [&](int n) {
    Places found;
    for (int i = 0; i < n; ++i) found.push_back({180 * next(), std::asin(next()) * 180 / M_PI});
    return found;
  };
  const Places sites = places(10000);
  const Places queries = places(10000);
  const bool same = by_s2(sites, queries) == by_rondel(sites, queries);
  std::printf("the three nearest of 10,000 sites, 10,000 times: %s\n",
              same ? "the same" : "different");
  return same ? 0 : 1;
}
