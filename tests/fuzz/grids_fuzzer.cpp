// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Laws of named grids, of weights by tiles, and of files that are regridded.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "fuzz/scratch_folder.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/named_grids.h"
#include "rondel/regrid_files.h"
#include "rondel/remap.h"
#include "rondel/tiled_remap.h"

namespace rondel::fuzz {
namespace {

// The name of a small grid, or at times any text.
std::string next_name(ByteSource& source) {
  const auto number = [&](std::size_t most) { return std::to_string(source.below(most + 1)); };
  switch (source.below(11)) {
    case 0:
      return "grid:" + number(12) + "x" + number(9);
    case 1:
      return "grid:" + std::to_string(10 + source.below(60));
    case 2:
      return "healpix:" + number(3);
    case 3:
      return "healpix:" + number(2) + ":ring";
    case 4:
      return "F" + number(5);
    case 5:
      return "O" + number(4);
    case 6:
      return "C" + number(5);
    case 7:
      return "R" + number(3) + "B" + number(2);
    case 8:
      return "hexagons:R" + number(3) + "B" + number(2);
    case 9:
      return "tripolar:" + std::to_string(7 + source.below(24));
    default:
      break;
  }
  std::string text;
  while (!source.is_empty() && text.size() < 12) text += static_cast<char>(source.byte());
  return text;
}

// Returns the grid of a name, or nothing: a name of a grid is told by its form.
std::optional<NamedGrid> grid_of(const std::string& name, GridSides sides) {
  try {
    NamedGrid grid(name, sides);
    require(NamedGrid::is_name(name), "a grid has a name of their form");
    if (grid.num_cells() > 3000) return std::nullopt;
    return grid;
  } catch (const InvalidInput& error) {
    const bool is_listed =
        std::string_view(error.what()).find(NamedGrid::forms()) != std::string_view::npos;
    require(is_listed != NamedGrid::is_name(name), "what has another form is told all forms");
    return std::nullopt;
  }
}

// The cells of a grid, or nothing where rows of one or two cells have no great circles.
std::optional<CellSet> cells_of(const NamedGrid& grid) {
  try {
    CellSet cells = grid.cells();
    const bool has_wide_cells = grid.axes() != nullptr && grid.axes()->lon_deg.size() <= 2;
    if (has_wide_cells && !cells.covers_sphere()) return std::nullopt;
    return cells;
  } catch (const InvalidInput&) {
    require(grid.axes() != nullptr, "cells of formulas are cells");
    return std::nullopt;
  }
}

void test_grid(const NamedGrid& grid, const CellSet& cells) {
  require(grid.covers_sphere() != grid.name().starts_with("tripolar:"),
          "all but one kind cover it");
  require(cells.covers_sphere() == grid.covers_sphere() && cells.num_cells() == grid.num_cells(),
          "the cells of " + grid.name() + " cover the sphere");
  require(
      cells.facts().given_centers() == grid.centers() && grid.centers().size() == grid.num_cells(),
      "a cell has a center");
  const std::vector<LonLat> centers = grid.centers();
  for (std::size_t i = 0; i < centers.size(); ++i) {
    require(grid.center(i) == centers[i], "a center is the same alone");
  }
  std::uint64_t product = 1;
  for (const std::uint64_t length : grid.shape()) product *= length;
  require(product == grid.num_cells(), "the shape has all cells");
  require(!grid.name().empty(), "a grid has its name");
  const GridMapping mapping = grid.mapping();
  require(mapping.texts.empty() == grid.name().starts_with("grid:"), "axes say where cells are");
  require(
      mapping.texts.empty() || NamedGrid(grid_named_by(mapping)).num_cells() == grid.num_cells(),
      "points say on which grid they are");
  require(lack_of_mapping(mapping).empty(), "nothing lacks in what a grid says");
}

// Some cells are those of the whole grid, and are known by their centers.
void test_some(const NamedGrid& grid, const CellSet& cells) {
  require((grid.lines() == nullptr) == (grid.axes() == nullptr), "axes have lines between them");
  if (grid.axes() != nullptr) return;
  std::vector<Index> numbers;
  std::vector<LonLat> places;
  for (std::size_t i = grid.num_cells() % 7; i < grid.num_cells(); i += 1 + i % 50) {
    numbers.push_back(static_cast<Index>(grid.num_cells() - 1 - i));
    places.push_back(grid.center(numbers.back()));
  }
  const CellSet some = grid.cells(numbers);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    require(std::abs(some.areas()[k] - cells.areas()[numbers[k]]) < 1e-12, "cells keep their area");
  }
  require(grid.numbers_at(places, 1e-4) == numbers, "centers tell the numbers of cells");
}

std::vector<std::int32_t> next_mask(ByteSource& source, std::size_t n) {
  if (source.below(2) == 0) return {};
  std::vector<std::int32_t> mask(n);
  const std::size_t share = 1 + source.below(5);
  for (std::size_t i = 0; i < n; ++i) mask[i] = (i * 7 + source.below(3)) % 6 < share ? 1 : 0;
  return mask;
}

void test_tiles(ByteSource& source, const CellSet& from, const CellSet& to,
                const TiledCells& source_cells, const TiledCells& target_cells, bool has_formula) {
  const auto is_walked = [](const CellSet& side) {
    return side.covers_sphere() || side.has_parallels();
  };
  if (!is_walked(from) && !is_walked(to)) return;
  TiledRemapOptions options;
  options.norm = source.below(2) == 0 ? RemapNorm::destarea : RemapNorm::fracarea;
  options.source_mask = next_mask(source, from.num_cells());
  options.target_mask = next_mask(source, to.num_cells());
  options.cells_per_tile = 1 + source.below(256) * 8;
  require(source_cells.num_cells() == from.num_cells() &&
              source_cells.has_parallels() == from.has_parallels(),
          "sides have their cells");
  // Sources in memory have no tiles of order 2.
  options.order = has_formula && source.below(2) == 1 ? 2 : 1;
  const Remap whole =
      remap(from, to, {options.order, options.norm, options.source_mask, options.target_mask});
  const TiledRemap tiled(source_cells, target_cells, options);
  require(tiled.num_sources() == from.num_cells() && tiled.num_targets() == to.num_cells(),
          "both sides are there");
  std::vector<int> times(to.num_cells(), 0);
  for (std::size_t t = 0; t < tiled.num_tiles(); ++t) {
    const RemapTile tile = tiled.tile(t);
    require(tile.targets.size() == tiled.num_targets(t), "a tile has the targets that it says");
    for (std::size_t r = 0; r < tile.targets.size(); ++r) {
      const Index target = tile.targets[r];
      ++times[target];
      const std::uint64_t begin = whole.weights.offsets[target];
      const std::uint64_t size = whole.weights.offsets[target + std::size_t{1}] - begin;
      require(tile.weights.offsets[r + 1] - tile.weights.offsets[r] == size, "a row has its size");
      for (std::uint64_t k = 0; k < size; ++k) {
        const std::uint64_t own = tile.weights.offsets[r] + k;
        require(tile.weights.columns[own] + tile.first_source == whole.weights.columns[begin + k] &&
                    tile.weights.values[own] == whole.weights.values[begin + k],
                "a row is that of the whole");
      }
      require(tile.areas[r] == whole.target_areas[target] &&
                  tile.fractions[r] == whole.target_fractions[target],
              "areas are those of the whole");
    }
  }
  require(std::ranges::all_of(times, [](int n) { return n == 1; }), "a target is in one tile");
}

// Returns some of the cells.
CellSet part_of(ByteSource& source, const CellSet& cells) {
  const CellRings all = cells.given_rings();
  CellRings part;
  part.points = all.points;
  const std::size_t step = 1 + source.below(7);
  const std::size_t begin = source.below(all.num_cells());
  for (std::size_t i = begin; i < all.num_cells(); i += 1 + (i * 5) % step) {
    part.append_cell(all, i);
  }
  return CellSet::polygons(part);
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Regrids in other tiles and little memory; half of the time a first run ends early and is resumed.
void regrid_in_tiles(ByteSource& source, const std::string& in, const std::string& target,
                     const std::string& out, RegridFileOptions options) {
  options.cells_per_tile = 1 + source.below(256) * 4;
  options.memory = 1 + source.below(256) * 16384;
  options.resume = source.below(2) == 0;
  struct Ended {};
  std::size_t left = options.resume ? source.below(16) : std::numeric_limits<std::size_t>::max();
  const Execution ending{.progress = [&](std::string_view, double) {
    if (left-- == 0) throw Ended();
  }};
  try {
    regrid_file({in, {}}, {target, {}}, {out, {}}, options, ending);
    return;
  } catch (const Ended&) {
    options.cells_per_tile = 1 + source.below(256) * 4;
  } catch (const InvalidInput& error) {
    // The message says how many mebibytes are enough.
    const std::string text = error.what();
    const std::size_t at = text.find("small: ");
    if (at == std::string::npos) throw;
    options.memory = std::stoull(text.substr(at + 7)) << 20U;
    require(options.memory < std::uint64_t{1} << 28U, "small grids need little memory");
  }
  options.memory = std::max(options.memory, std::uint64_t{1} << 26U);
  regrid_file({in, {}}, {target, {}}, {out, {}}, options);
}

// The same two fields as components of vectors: tiles change nothing, and no vector becomes longer
// than the longest one.
void test_vectors(ByteSource& source, const std::string& in, const std::string& target,
                  RegridFileOptions options, const ScratchFolder& folder) {
  const std::string out = folder.file("vectors.nc");
  const std::string tiles = folder.file("vector_tiles.nc");
  options.vectors = {{"one", "any"}};
  const RegridFileReport report = regrid_file({in, {}}, {target, {}}, {out, {}}, options);
  std::filesystem::remove(tiles + ".partial");
  regrid_in_tiles(source, in, target, tiles, options);
  require(bytes_of(out) == bytes_of(tiles), "tiles have the same bytes");
  const FieldSet found = read_fields({out, {}}, {}, report.targets);
  for (std::size_t t = 0; t < report.targets; ++t) {
    const double east = found.arrays[0].values[t];
    const double north = found.arrays[1].values[t];
    require(std::isnan(east) == std::isnan(north), "components are missing together");
    require(std::isnan(east) || east * east + north * north < 9 + 100 + 1e-6,
            "no vector is longer than those it is made of");
  }
}

// A field that is constant stays so, one with gaps stays between its bounds, and tiles change
// nothing.
void test_files(ByteSource& source, const NamedGrid& from, const std::string& target) {
  static const ScratchFolder folder;
  const std::string in = folder.file("in.nc");
  const std::string out = folder.file("out.nc");
  const std::string tiles = folder.file("tiles.nc");
  FieldSet fields;
  fields.num_points = from.num_cells();
  fields.arrays = {{"one", {}, {}, std::vector<double>(from.num_cells(), 3), {}, {}},
                   {"any", {}, {}, {}, {}, {}}};
  const std::size_t gaps = 1 + source.below(9);
  for (std::size_t i = 0; i < from.num_cells(); ++i) {
    fields.arrays[1].values.push_back(i % gaps == 1 ? std::numeric_limits<double>::quiet_NaN()
                                                    : static_cast<double>(i % 11));
  }
  WeightSide side;
  side.points = from.centers();
  write_fields({in, {}}, fields, side);
  RegridFileOptions options;
  options.source = FileName{from.name(), {}};
  options.max_missing = static_cast<double>(source.below(5)) / 4;
  constexpr FieldMethod methods[] = {FieldMethod::conservative, FieldMethod::linear,
                                     FieldMethod::largest_share, FieldMethod::nearest};
  options.method = methods[source.below(4)];
  options.history = regrid_command(in, target, options);
  require(options.history.find(" --source " + from.name()) != std::string::npos,
          "a command names the source");
  const RegridFileReport report = regrid_file({in, {}}, {target, {}}, {out, {}}, options);
  require(report.fields == 2 && report.sources == from.num_cells(), "all fields are carried");
  std::filesystem::remove(tiles + ".partial");
  regrid_in_tiles(source, in, target, tiles, options);
  require(bytes_of(out) == bytes_of(tiles), "tiles have the same bytes");
  const FieldSet found = read_fields({out, {}}, {}, report.targets);
  const FieldFile again({out, {}}, {}, report.targets);
  const std::size_t first = source.below(report.targets);
  std::vector<double> part(std::min<std::size_t>(report.targets - first, 1 + source.below(9)));
  require(again.find(again.fields().arrays[1].name) == 1U, "an array has its name");
  again.read_points(1, 0, first, part);
  for (std::size_t k = 0; k < part.size(); ++k) {
    const double value = found.arrays[1].values[first + k];
    require(part[k] == value || (std::isnan(part[k]) && std::isnan(value)), "a part is a part");
  }
  for (const double value : found.arrays[0].values) {
    const bool may_lack = options.method == FieldMethod::linear || !from.covers_sphere();
    const bool is_outside = may_lack && std::isnan(value);
    require(is_outside || std::abs(value - 3) < 1e-12, "a constant is kept");
  }
  for (const double value : found.arrays[1].values) {
    require(std::isnan(value) || (value > -1e-9 && value < 10 + 1e-9), "means are between bounds");
  }
  if (options.method != FieldMethod::largest_share && source.below(2) == 0) {
    test_vectors(source, in, target, options, folder);
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;  // NOLINT(google-build-using-namespace)
  fuzz::ByteSource source(data, size);
  const auto sides = source.below(4) == 0 ? GridSides::great_circles : GridSides::parallels;
  const std::string first = fuzz::next_name(source);
  const std::string second = fuzz::next_name(source);
  const auto from = fuzz::grid_of(first, sides);
  const auto to = fuzz::grid_of(second, sides);
  if (!from || !to) return 0;
  const auto sources = fuzz::cells_of(*from);
  const auto targets = fuzz::cells_of(*to);
  if (!sources || !targets) return 0;
  fuzz::test_grid(*from, *sources);
  fuzz::test_some(*from, *sources);
  if (source.below(3) == 0) {
    fuzz::test_files(source, *from, second);
  } else {
    const std::size_t kind = source.below(6);
    // Grids of axes with sides on great circles are made as a whole.
    const bool is_computed = sources->has_parallels() || from->axes() == nullptr;
    if (kind == 4 && !sources->has_parallels() && sources->num_cells() > 1) {
      const CellSet part = fuzz::part_of(source, *sources);
      fuzz::test_tiles(source, part, *targets, TiledCells(part), TiledCells(*to), false);
    } else if (kind == 5 && !targets->has_parallels() && targets->num_cells() > 1) {
      const CellSet part = fuzz::part_of(source, *targets);
      fuzz::test_tiles(source, *sources, part, TiledCells(*from), TiledCells(part), is_computed);
    } else {
      fuzz::test_tiles(source, *sources, *targets,
                       kind == 0 ? TiledCells(*sources) : TiledCells(*from), TiledCells(*to),
                       is_computed && kind != 0);
    }
  }
  return 0;
}
