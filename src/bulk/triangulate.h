// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// From sites in spatial order to the arrays of the result, by whichever builder is the fastest. The
// triangulation is unique, so the choice changes nothing else. The first one that suits builds:
//
//     builder       sites                              and
//     sphere        128 to 65,536, in all octants      weights are close, or seams are short
//     blocks        8,192 or more                      seams are short
//     incremental   any
//
// Weights are close where few sites can be hidden, as far as their distances from the center tell.
// Seams are short if blocks leave little to them (blocks.h); fewer than 8,192 sites have none. Where
// the whole sphere or blocks do not work, as they say, the next one builds. Of a seam, sites up to an
// eighth of all, if those are more, may be triangulated over the whole sphere.
//
// in    the sites and their order, of which copies may be at hand
// out   the arrays of the result
// index ranks; the result speaks of names
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/triangulate.h"
#include "system/large_arrays.h"

namespace rondel::bulk {

// From so many sites on it pays to copy them in their order: to read them one by one from
// everywhere in memory takes longer.
inline constexpr std::size_t min_copied_sites = std::size_t{3} << 18;

// With more the mesh of a whole sphere would not fit into the second cache, more or less.
inline constexpr std::size_t default_max_sphere_sites = std::size_t{1} << 16;

// Computes what kernel::triangulate does. `copies` is empty, or has the memory in which
// system::SiteCopies of the sites by rank lie, which becomes that of the faces.
kernel::Triangulated triangulate(std::span<const Point> sites, std::vector<Index> order,
                                 std::span<const order::Renamed> renamed,
                                 const system::Job& options, LargeVector<Triple> copies = {},
                                 std::size_t max_sphere_sites = default_max_sphere_sites);

}  // namespace rondel::bulk
