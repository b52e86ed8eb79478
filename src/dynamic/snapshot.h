// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// From a triangulation that changes to an immutable one, and back.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "dynamic/hidden_sites.h"
#include "dynamic/places.h"
#include "kernel/walk.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "topology/mesh.h"
#include "topology/triangulation_arrays.h"

namespace rondel::dynamic {

// The ids in use, increasing: position i of a snapshot is the site ids[i].
RONDEL_API std::vector<Index> live_sites(const Places& places);

// The arrays in dimension 2 for `ids` and their `sites`, in canonical order.
TriangulationArrays make_arrays(const Places& places, std::span<const Index> ids,
                                std::span<const Point> sites, const topology::Mesh& mesh,
                                const kernel::FaceKinds& kinds, const HiddenSites& hidden,
                                Model model, const Point& center);

// What Editor::assign and Editor::adopt take.
struct Build {
  std::vector<Index> place_of_site;
  std::vector<Index> representatives;
  topology::Mesh mesh;
  std::vector<std::array<Index, 2>> hidden;
};
RONDEL_API Build make_build(const Triangulation& triangulation, unsigned threads);

}  // namespace rondel::dynamic
