// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// From what blocks leave to the seam to all of its faces: squares that are larger and larger, and at
// last the sphere, triangulate what the parts of theirs leave (docs/theory/blocks.md, "A tree of
// seams").
//
// in    the squares, and what the blocks in them leave to the seam
// out   the faces of the seam
// index seam sites, in the order of their ranks
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bulk/seam_faces.h"
#include "bulk/squares.h"

namespace rondel::bulk {

// Which squares triangulate a seam. The result does not depend on it.
struct SeamRule {
  // With fewer seam sites none does: their mesh over the whole sphere fits into the second cache.
  std::size_t min_sites = std::size_t{1} << 16;
  // Or those alone that are likely to leave little of what comes in.
  bool is_every_square = false;
};

// What a square leaves open.
struct OpenSeam {
  std::vector<Index> seam_sites;  // with an open face, or undecided; increasing
  std::vector<SeamEdge> edges;    // between positions in `seam_sites`
  std::vector<Index> hidden;  // seam sites that are hidden if the center is inside the hull of all
                              // sites, and not among `seam_sites`; increasing
  std::vector<Index> undecided;  // the same among them, positions in `seam_sites`, increasing
};

// Adds all faces of the seam to `seam`, and what was counted to `tally`. Returns false if that does
// not work, because all seam sites lie on one great circle.
bool fill_seam(const Input& input, std::span<const TreeSquare> squares,
               std::span<const BlockResult> results, const SeamRule& rule, SeamFaces& seam,
               Tally& tally);
// Does the same without squares, on the whole sphere at once.
bool fill_seam_at_once(const Input& input, std::span<const BlockResult> results, SeamFaces& seam,
                       Tally& tally);

// Does the same for one square, the last one, for the faces that are final.
OpenSeam fill_square_seam(const Input& input, std::span<const TreeSquare> squares,
                          std::span<const BlockResult> results, const SeamRule& rule,
                          SeamFaces& seam, Tally& tally);
// Leaves open what is hidden: all of it becomes undecided.
void add_hidden(OpenSeam& open);

}  // namespace rondel::bulk
