// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulates the whole sphere, cells and gaps, so that the sides of given cells are edges (a
// constrained triangulation). So cells that are only parts of the sphere become parts of a cover.
//
// in    a subdivision that need not cover the sphere
// out   a cover by triangles, each with the cell that it belongs to
// index cells in the spatial orders of the subdivision and of the cover
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "overlay/measure.h"
#include "overlay/subdivision.h"
#include "rondel/error.h"
#include "rondel/types.h"

namespace rondel::overlay {

// A cover by triangles.
struct CoverTriangulation {
  Subdivision cover;
  // For each triangle (a cell of `cover`), the cell of the given subdivision that it is a part of;
  // num_cells() of that subdivision for a triangle in no cell.
  std::vector<Index> owners;
};

// A place where sides of cells contradict each other: they cross, or the place is inside of two
// cells, or twice inside of one.
struct SideConflict {
  Index first;  // index in the input, not above `second`
  Index second;
  Point place;
  bool is_crossing;
};
// Is thrown if the sides of cells contradict each other.
class ConflictingSides : public InvalidInput {
 public:
  explicit ConflictingSides(const SideConflict& conflict);
  [[nodiscard]] const SideConflict& conflict() const { return conflict_; }

 private:
  SideConflict conflict_;
};

// Returns a conflict between sides of the cells, or nothing; exact. Sides that one cell has
// in both directions bound nothing and are ignored.
std::optional<SideConflict> side_conflict(const Subdivision& cells, const Execution& execution);
// True if there is no conflict, and no cell has a side in both directions.
bool has_plain_sides(const Subdivision& cells, const Execution& execution);
// True if a single cell with these sides has no conflict in the sense of side_conflict().
bool is_region(std::span<const BorderArc> sides, const Execution& execution);

// Returns the Delaunay triangulation of the corners and of the ends of the coordinate axes, with
// the sides of the cells inserted; all decisions are exact. Where cells would overlap otherwise,
// corners that are on a side up to rounding become corners of the side. Throws InvalidInput
// (ConflictingSides) if cells overlap by more.
CoverTriangulation triangulate_cover(const Subdivision& cells, const Execution& execution);

// Calls work(is_first_filled, execution) with the subdivision of fewer sides as the one to be
// triangulated. If its cells overlap, calls it again for the other one, without a progress callback
// since fractions must not decrease. `what` names the two for the message of the InvalidInput that
// is thrown if both have overlapping cells.
template <class Work>
auto with_one_filled(const Subdivision& first, const Subdivision& second,
                     const std::array<const char*, 2>& what, const Execution& execution,
                     const Work& work) {
  const bool is_first = first.num_halfedges() <= second.num_halfedges();
  std::array<std::string, 2> errors;
  try {
    return work(is_first, execution);
  } catch (const InvalidInput& error) {
    errors[is_first ? 0 : 1] = error.what();
  }
  try {
    return work(!is_first, Execution{.threads = execution.threads, .stop = execution.stop});
  } catch (const InvalidInput& error) {
    errors[is_first ? 1 : 0] = error.what();
    throw InvalidInput(std::string("of the ") + what[0] + ' ' + errors[0] + ", of the " + what[1] +
                           ' ' + errors[1] + ": the cells of one side must not overlap",
                       error.index());
  }
}

}  // namespace rondel::overlay
