// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A cover of the sphere by triangles whose sides include those of given cells.
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

struct Filling {
  Subdivision cover;
  // Of each cell of the cover, the given cell that it is a part of; the number of these: none.
  std::vector<Index> owners;
};

// A place where the sides of cells contradict each other: they cross, or the place is inside of two cells, or of one twice.
struct SideConflict {
  Index first;  // by name, not above the second
  Index second;
  Point place;
  bool is_crossing;
};
class ConflictingSides : public InvalidInput {
 public:
  explicit ConflictingSides(const SideConflict& conflict);
  [[nodiscard]] const SideConflict& conflict() const { return conflict_; }

 private:
  SideConflict conflict_;
};

// Whether any do, exactly. Whatever has one owner on both sides is no side.
std::optional<SideConflict> side_conflict(const Subdivision& cells, const Execution& execution);
// Whether none do, and no place is a side of one cell in both directions either.
bool has_plain_sides(const Subdivision& cells, const Execution& execution);
// Whether one cell with all of these sides has no conflict, as side_conflict() finds them.
bool is_region(std::span<const BorderArc> sides, const Execution& execution);

// The Delaunay triangulation of the corners and of the ends of the axes, into which the sides of the cells are put, all
// of it exactly; but corners that are on a side to rounding become corners of it where the cells would overlap else. Throws
// InvalidInput where cells overlap by more.
Filling filling_of(const Subdivision& cells, const Execution& execution);

// work(is_first_filled, execution) for the one with fewer sides, or else, if that one's cells overlap, for the other one,
// of which nothing is told, as fractions must not decrease. `what` they are is for the message where both do.
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
                           ' ' + errors[1] + ": one of the two must have none that do",
                       error.index());
  }
}

}  // namespace rondel::overlay
