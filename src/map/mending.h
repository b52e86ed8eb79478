// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Repairs the troubles of regions, one pass after the other: the steps of valid_regions().
#pragma once

#include <vector>

#include "map/arc.h"
#include "map/line_troubles.h"
#include "map/shared_lines.h"

namespace rondel::map {

inline constexpr double longest_reach = 0x1p-30;  // radians; 6 mm on the earth

// Returns the distance in radians within which a pass merges or aligns corners. It grows with the
// number of the pass if passes do not end, from merge_distance to longest_reach, and from one pass
// to the next by four at most.
double reach_of_pass(int pass);

// Mends the troubles of one pass by dividing lines and merging positions.
class Mending {
 public:
  // A change of the lines: `position` divides the line from a to b, or a and b have become
  // `position`.
  struct Change {
    LonLat a;
    LonLat b;
    LonLat position;
    bool is_merge = false;
  };

  // Keeps a reference to `lines`. In every third late pass lines are bisected before they are
  // aligned, since corners opposite each other on lines at an angle approach the crossing slowly.
  Mending(SharedLines& lines, int pass);

  void mend(const Trouble& trouble);

  [[nodiscard]] const std::vector<Change>& changes() const { return changes_; }

 private:
  bool divide(const LonLat& a, const LonLat& b, const LonLat& at);
  bool merge(const LonLat& a, const LonLat& b);
  bool align(const LonLat& a, const LonLat& b, const LonLat& corner);
  bool join(const LonLat& a, const LonLat& b);
  bool bisect(const LonLat& a, const LonLat& b);
  bool align_all(const LonLat& a, const LonLat& b, const LonLat& c, const LonLat& d);
  bool bisect_both(const LonLat& a, const LonLat& b, const LonLat& c, const LonLat& d);
  void uncross(const Trouble& lines);
  void snap(const Trouble& lines);
  void pair(const Trouble& lines);
  void turn(const Loop& loop);

  SharedLines& lines_;
  double reach_;
  bool bisects_first_;
  std::vector<Change> changes_;
};

}  // namespace rondel::map
