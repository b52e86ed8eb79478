// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How a regridding divides its work so that it stays within its memory.
//
// in    the numbers of cells of both sides, and what can be done in parts
// out   whether weights are whole or in tiles, and how much is in memory at a time
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace rondel::formats {

// A slice of fields has 64 MiB: eight global ones of 0.25 degrees, which apply() multiplies at once.
inline constexpr std::uint64_t values_per_slice = std::uint64_t{1} << 23U;

// The bytes that a kind of weights takes, for each cell or place of a side.
struct RegridCost {
  std::uint64_t of_source = 0;  // if weights are whole
  std::uint64_t of_target = 0;
  // If weights are in tiles, beside these.
  std::uint64_t of_source_beside = 0;
  std::uint64_t of_target_beside = 0;
  std::uint64_t of_cell_in_tile = 0;  // cells of both sides, or targets of a method between places
  std::uint64_t smallest_tile = std::uint64_t{1} << 14U;  // cells
  std::uint64_t of_source_opened = 0;  // while the file of the fields is opened, before all else
};

// Places that are compared with those of the fields' file; more are known by their number alone.
inline constexpr std::size_t max_compared = std::size_t{1} << 24U;

// What the cost of the cells of a side depends on.
struct RegridCells {
  std::uint64_t cells = 0;
  bool have_parallels = false;  // they are between meridians and parallels, and never made
  bool have_axes = false;
  bool are_stored = false;  // no formula has them
};

// Returns the bytes of conservative weights, which were measured and rounded up.
RegridCost cost_of_cells(const RegridCells& source, const RegridCells& target, bool is_second);

struct RegridTask {
  RegridCost cost;
  std::uint64_t sources = 0;
  std::uint64_t targets = 0;
  std::uint64_t fields = 0;      // of one array
  std::uint64_t per_source = 1;  // values in memory at a place of the source for one of a field
  std::uint64_t per_target = 1;
  bool has_tiles = false;         // whether weights can be computed in tiles
  bool are_cells = false;         // whether tiles have cells of both sides
  bool is_in_order = false;       // whether the targets of a tile are consecutive
  bool has_whole_fields = false;  // whether they are extrapolated when all tiles are there
  bool has_windows = false;   // whether a tile needs consecutive sources, as far as a row of them
  double largest_target = 0;  // its share of the sphere, if targets may be large
  std::uint64_t rows = 1;     // parallels between targets, if these are in rows
  std::uint64_t memory = 0;   // what may be in use
  std::size_t tile = 0;       // cells of a tile; 0: as the plan says
  unsigned threads = 1;
  std::size_t num_processes = 1;  // which share the tiles
};

struct RegridPlan {
  bool has_tiles = false;
  std::size_t cells_per_tile = 0;
  std::size_t tiles_at_once = 1;
  std::size_t fields_at_once = 1;
  bool reads_ahead = false;  // whether the next fields are read meanwhile
  // Whether each tile is written when it is computed, since one field is too large to be kept.
  bool is_streamed = false;
  std::uint64_t spare = 0;  // bytes of the memory that are not in use, where weights are whole
};

// Returns the plan with the least work. Throws InvalidInput if no plan keeps within the memory,
// with the number of bytes that one needs.
RegridPlan plan_of(const RegridTask& task);

// Returns bytes in words, as options have them: "4127M", rounded up.
std::string mebibytes_of(std::uint64_t bytes);

}  // namespace rondel::formats
