// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Repairs the cells of a set that cross or overlap themselves: CellSet::repaired().
//
// Each of these cells is arranged by itself, so that it gets corners where its sides cross, and is
// read by the even-odd rule. The other cells keep their corners.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "overlay/cell_set_data.h"
#include "overlay/overlaps.h"
#include "overlay/single_cells.h"
#include "rondel/cell_set.h"
#include "rondel/error.h"
#include "rondel/set_operations.h"
#include "system/job.h"

namespace rondel {
namespace {

// Returns the cells with those of `crossing` repaired; `crossing` is sorted.
CellRings with_repaired(CellRings cells, const std::vector<CrossingCells>& crossing,
                        const Execution& execution) {
  CellRings faulty;
  for (const CrossingCells& one : crossing) {
    overlay::append(overlay::one_cell(cells, one.first), faulty);
  }
  CellRings sound;
  try {
    sound = repaired(faulty, execution);
  } catch (const InvalidInput& error) {
    const std::size_t cell = crossing[error.index()].first;
    throw InvalidInput("cell " + std::to_string(cell) + " cannot be repaired: " + error.what(),
                       cell);
  }
  // Both kinds of cells are counted in the same points.
  const auto first = static_cast<Index>(cells.points.size());
  for (Index& corner : sound.corners) corner += first;
  CellRings result;
  result.points = std::move(cells.points);
  result.points.insert(result.points.end(), sound.points.begin(), sound.points.end());
  std::size_t next = 0;
  for (std::size_t c = 0; c < cells.num_cells(); ++c) {
    const bool is_faulty = next < crossing.size() && crossing[next].first == c;
    if (is_faulty) {
      result.append_cell(sound, next++);
    } else {
      result.append_cell(cells, c);
    }
  }
  overlay::merge_equal_points(result);
  return result;
}

// Adds what was wrong with the repaired cells, and a sentence about them.
void tell_of_repaired(const std::vector<CrossingCells>& crossing, std::size_t num_cells,
                      CellFacts& facts) {
  facts.faults.resize(num_cells);
  for (const CrossingCells& one : crossing) {
    std::string& fault = facts.faults[one.first];
    fault += (fault.empty() ? "" : "; ") + overlay::fault_of(one);
  }
  std::string text = "cell " + std::to_string(crossing.front().first) + " was repaired (it " +
                     overlay::fault_of(crossing.front()) + ")";
  if (crossing.size() > 1) text += ", and " + std::to_string(crossing.size() - 1) + " more";
  facts.remarks.push_back(std::move(text));
}

}  // namespace

CellSet CellSet::repaired(const Execution& execution) const {
  const system::Call call(execution);
  const std::vector<CrossingCells> crossing = data_->cells_crossing_themselves();
  if (crossing.empty()) return *this;
  const Execution told{.threads = execution.threads, .stop = execution.stop};
  CellFacts facts = *facts_;
  tell_of_repaired(crossing, num_cells(), facts);
  return polygons(with_repaired(given_rings(), crossing, told), told).with_facts(std::move(facts));
}

}  // namespace rondel
