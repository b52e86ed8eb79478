// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// From the final faces of the blocks and the triangulation of the seam sites to the result.
//
//      .-----.         The final faces leave a region open. All corners of the faces there are
//     /final /|        seam sites; these faces have no site above them, so they are faces of the
//    '------' |seam    triangulation of the seam sites as well. A search from the edges of the
//     \final \|        region finds them among its faces, and so which ones to leave out.
//      '-----'
//
// in    the faces that blocks wrote, and those of the seam
// out   the arrays of the result, in place of the faces of the blocks
// index preliminary and final names of faces; ranks, seam sites, names of sites
#pragma once

#include <span>
#include <vector>

#include "bulk/seam_tree.h"
#include "topology/triangulation_arrays.h"

namespace rondel::bulk {

// `results` are those of the blocks in their order, and `arrays.faces` and `arrays.neighbors` the
// store that they wrote to; the result replaces it in place. `seam` has all faces of the seam;
// `names` has the name to report for each rank. Returns false if the parts do not fit, which cannot be as long as every final face is one.
bool stitch(std::span<const BlockResult> results, const SeamFaces& seam,
            std::span<const Index> names, unsigned threads, TriangulationArrays& arrays);

// Does the same for one square, whose faces are not all known. No neighbor is known where `open`
// says so, and the faces of the sites there are in no particular order. Returns these sites, and
// renames the faces in `open`.
std::vector<SeamSite> stitch_open(std::span<const BlockResult> results, const SeamFaces& seam,
                                  std::span<const Index> names, unsigned threads, OpenSeam& open,
                                  TriangulationArrays& arrays);

}  // namespace rondel::bulk
