// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dynamic/snapshot.h"

#include <algorithm>

#include "hidden/hidden_faces.h"
#include "kernel/canonical.h"
#include "order/spatial_order.h"
#include "topology/mesh.h"

namespace rondel::dynamic {

std::vector<Index> live_sites(const Places& places) {
  std::vector<Index> ids;
  ids.reserve(places.num_sites());
  for (Index site = 0; site < places.site_limit(); ++site) {
    if (places.is_alive(site)) ids.push_back(site);
  }
  return ids;
}

TriangulationArrays make_arrays(const Places& places, std::span<const Index> ids,
                                std::span<const Point> sites, const topology::Mesh& mesh,
                                const kernel::FaceKinds& kinds, const HiddenSites& hidden,
                                Model model, const Point& center) {
  auto [names, duplicates, renamed] = order::spatial_order(sites, model, center, 1);
  const auto num_ranks = static_cast<Index>(names.size());
  std::vector<Index> rank_of_place(places.place_limit(), no_index);
  TriangulationArrays arrays;
  for (Index rank = 0; rank < num_ranks; ++rank) {
    const Index place = places.place_of(ids[names[rank]]);
    rank_of_place[place] = rank;
    if (hidden.contains(place)) arrays.hidden.push_back({rank, no_index});
  }
  order::rename(names, renamed);
  for (Hidden& h : arrays.hidden) h.site = names[h.site];
  std::ranges::sort(arrays.hidden, {}, &Hidden::site);

  topology::Mesh copy = mesh;
  copy.for_each_face([&](Index f) {
    for (Index& v : copy[f].vertex) v = rank_of_place[v];
  });
  kernel::write_canonical(copy, names, std::move(rank_of_place), arrays);
  arrays.num_sites = sites.size();
  arrays.dimension = 2;
  arrays.duplicates = std::move(duplicates);
  kernel::report_ghosts(copy, kinds, arrays.ghost_faces);
  hidden::assign_hidden_faces(sites, center, arrays, 1);
  return arrays;
}

Build make_build(const Triangulation& triangulation, unsigned threads) {
  Build build;
  const auto sites = triangulation.sites().points();
  auto order =
      order::spatial_order(sites, triangulation.model(), triangulation.sphere().center, threads);
  build.place_of_site.assign(sites.size(), no_index);
  build.representatives = std::move(order.order);
  for (Index place = 0; place < build.representatives.size(); ++place) {
    build.place_of_site[build.representatives[place]] = place;
  }
  for (const auto& [place, lowest] : order.renamed) build.place_of_site[lowest] = place;
  for (const auto& [site, lowest] : order.duplicates) {
    build.place_of_site[site] = build.place_of_site[lowest];
  }
  build.mesh =
      topology::link_faces(triangulation.faces(), triangulation.neighbors(), build.place_of_site);
  for (const auto& [site, face] : triangulation.hidden()) {
    if (face == no_index) continue;
    build.hidden.push_back(
        {build.place_of_site[site], build.place_of_site[triangulation.faces()[face][0]]});
  }
  return build;
}

}  // namespace rondel::dynamic
