// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_plan.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "rondel/error.h"
#include "rondel/types.h"

namespace rondel::formats {
namespace {

// The largest tile. What is at its border is computed for both tiles there, and takes most of the time
// of tiles with a few rows of targets; larger ones than this are not faster.
constexpr std::uint64_t largest_tile = std::uint64_t{1} << 23U;

constexpr std::uint64_t bytes_of_value = sizeof(double);

// Returns what is in memory beside tiles and fields.
std::uint64_t beside_tiles(const RegridTask& task) {
  return task.cost.of_source_beside * task.sources + task.cost.of_target_beside * task.targets;
}

// Returns the number of cells of the smallest sensible tile. The border of a band has about four
// times the root of the number of cells; neither a row of targets nor a large target is divided.
std::uint64_t cells_of_smallest_tile(const RegridTask& task) {
  if (!task.are_cells) return std::min(task.cost.smallest_tile, task.targets);
  const std::uint64_t cells = task.sources + task.targets;
  const auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(cells)));
  const std::uint64_t row = task.is_in_order ? cells / std::max<std::uint64_t>(task.rows, 1) : 0;
  // Cells of a grid are denser away from the equator.
  constexpr double density = 1.6;
  const auto inside =
      static_cast<std::uint64_t>(density * task.largest_target * static_cast<double>(task.sources));
  return std::min(cells, std::max({task.cost.smallest_tile, 4 * root, row, inside}));
}

std::uint64_t needed_to_open(const RegridTask& task) {
  return task.cost.of_source_opened * task.sources;
}

[[noreturn]] void refuse_memory(const RegridTask& task, std::uint64_t needed_to_carry) {
  const bool is_whole = !task.has_tiles;
  const std::uint64_t needed = std::max(needed_to_carry, needed_to_open(task));
  throw InvalidInput("memory of " + std::to_string(task.memory) +
                     " bytes is too small: " + mebibytes_of(needed) + " are enough for " +
                     std::to_string(task.sources) + " sources and " + std::to_string(task.targets) +
                     " targets" + (is_whole ? ", whose weights have no tiles" : ""));
}

// `needed_by_whole` is what whole weights need.
RegridPlan plan_of_tiles(const RegridTask& task, std::uint64_t needed_by_whole) {
  const std::uint64_t beside = beside_tiles(task);
  const std::uint64_t of_sources =
      task.has_windows ? 0 : bytes_of_value * task.per_source * task.sources;
  const std::uint64_t of_targets = bytes_of_value * task.per_target * task.targets;
  const std::uint64_t least_cells = task.tile > 0 ? task.tile : cells_of_smallest_tile(task);
  const std::uint64_t of_least = task.cost.of_cell_in_tile * least_cells;
  const std::uint64_t room = task.memory - std::min(task.memory, beside);
  RegridPlan plan;
  plan.has_tiles = true;
  const std::uint64_t of_both = of_sources + of_targets;
  plan.is_streamed = task.is_in_order && !task.has_whole_fields &&
                     (of_both > room / 2 || of_both + of_least > room);
  const std::uint64_t of_field = of_sources + (plan.is_streamed ? 0 : of_targets);
  if (of_field + of_least > room) {
    refuse_memory(task, std::min(beside + of_field + of_least, needed_by_whole));
  }
  if (!plan.is_streamed && of_field > 0) {
    plan.fields_at_once = std::clamp<std::uint64_t>(std::min(room / 2, room - of_least) / of_field,
                                                    1, std::max<std::uint64_t>(task.fields, 1));
  }
  const std::uint64_t left = room - plan.fields_at_once * of_field;
  plan.tiles_at_once = std::clamp<std::uint64_t>(left / std::max<std::uint64_t>(of_least, 1), 1,
                                                 2 * std::uint64_t{task.threads});
  std::uint64_t fitting = left / (plan.tiles_at_once * task.cost.of_cell_in_tile);
  if (task.num_processes > 1) {
    // Each process gets several tiles.
    fitting = std::min(fitting, (task.sources + task.targets) / (4 * task.num_processes));
  }
  plan.cells_per_tile =
      task.tile > 0 ? task.tile : std::max(least_cells, std::min(fitting, largest_tile));
  return plan;
}

// Returns the plan for what follows when the fields are open.
RegridPlan plan_to_carry(const RegridTask& task) {
  const std::uint64_t of_field =
      bytes_of_value * (task.per_source * task.sources + task.per_target * task.targets);
  const std::uint64_t weights =
      task.cost.of_source * task.sources + task.cost.of_target * task.targets;
  const bool is_tile_wanted = task.has_tiles && (task.tile > 0 || task.num_processes > 1);
  if (weights + of_field <= task.memory && !is_tile_wanted) {
    const std::uint64_t largest = std::max({task.sources, task.targets, std::uint64_t{1}});
    const std::uint64_t of_slice =
        std::max<std::uint64_t>(values_per_slice / (largest * task.per_source), 1);
    RegridPlan plan;
    const std::uint64_t of_field_and_next =
        of_field + bytes_of_value * task.per_source * task.sources;
    plan.reads_ahead = task.fields > 1 && weights + of_field_and_next <= task.memory;
    const std::uint64_t fitting =
        (task.memory - weights) /
        std::max<std::uint64_t>(plan.reads_ahead ? of_field_and_next : of_field, 1);
    plan.fields_at_once = std::clamp<std::uint64_t>(fitting, 1, of_slice);
    const std::uint64_t of_fields =
        plan.fields_at_once * (plan.reads_ahead ? of_field_and_next : of_field);
    plan.spare = task.memory - weights - of_fields;
    return plan;
  }
  if (!task.has_tiles) refuse_memory(task, weights + of_field);
  return plan_of_tiles(task, weights + of_field);
}

}  // namespace

RegridCost cost_of_cells(const RegridCells& source, const RegridCells& target, bool is_second) {
  const bool are_boxes = source.have_parallels && target.have_parallels;
  const auto of_side = [&](const RegridCells& side) -> std::uint64_t {
    if (are_boxes) return is_second ? 500 : 140;
    if (!side.have_parallels) return is_second ? 1200 : 550;
    return is_second ? 500 : 230;
  };
  const auto beside = [](const RegridCells& side) -> std::uint64_t {
    if (side.have_parallels) return 0;
    return side.are_stored ? 300 : 12;  // a set of cells, and an index by latitude
  };
  // Places of fields are compared when their file is opened.
  const std::uint64_t of_compared = source.have_axes ? 40 : 110;
  const bool are_compared = source.cells <= max_compared;
  const std::uint64_t of_place = target.have_axes ? 0 : sizeof(LonLat);
  // The bytes of a cell in a tile are the mean of both sides. Sources between parallels have nothing
  // but their pieces in other cells.
  // With order 2 there are pieces, moments and gradients, also of cells beyond the tile.
  const std::uint64_t of_cell = is_second ? 4800 : 400;
  const std::uint64_t of_pieces = is_second ? 1900 : 70;
  const std::uint64_t cells = std::max<std::uint64_t>(source.cells + target.cells, 1);
  const std::uint64_t in_tile =
      !source.have_parallels || target.have_parallels
          ? of_cell
          : (of_pieces * source.cells + of_cell * target.cells) / cells + 1;
  return {.of_source = of_side(source),
          .of_target = of_side(target),
          .of_source_beside = beside(source),
          .of_target_beside = beside(target) + of_place,
          .of_cell_in_tile = in_tile,
          .of_source_opened = are_compared ? of_compared : 0};
}

std::string mebibytes_of(std::uint64_t bytes) {
  constexpr std::uint64_t mebi = std::uint64_t{1} << 20U;
  return std::to_string((bytes + mebi - 1) / mebi) + "M";
}

RegridPlan plan_of(const RegridTask& task) {
  const RegridPlan plan = plan_to_carry(task);
  if (needed_to_open(task) > task.memory) refuse_memory(task, needed_to_open(task));
  return plan;
}

}  // namespace rondel::formats
