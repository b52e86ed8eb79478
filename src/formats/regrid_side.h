// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A side of a regridding of files.
//
// in    the name of a grid, or a file
// out   places, cells, and what a file of fields needs to know of them
// index cells, in the order of the grid or the file
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/grid_of_file.h"
#include "rondel/cell_set.h"
#include "rondel/extrapolate.h"
#include "rondel/fields.h"
#include "rondel/named_grids.h"
#include "rondel/read_cells.h"
#include "rondel/tiled_remap.h"
#include "rondel/weight_files.h"

namespace rondel::formats {

class RegridSide {
 public:
  // Reads a side, which messages call `what`, "source" or "target": the grid of the first of `names`, if
  // there are any and the file has several. With `has_cells` false its places are enough, which may be
  // nodes or edges then.
  RegridSide(const FileName& file, const char* what, const CellFileOptions& options, bool has_cells,
             const Execution& execution, const std::vector<std::string>& names = {});

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t num_places() const;
  [[nodiscard]] const std::vector<std::uint64_t>& shape() const { return shape_; }
  [[nodiscard]] const std::vector<std::int32_t>& mask() const { return mask_; }
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }
  // True if the places are points of a table or of features, or sites of netCDF by its `featureType`.
  [[nodiscard]] bool has_sites() const { return has_sites_; }
  // Returns the bytes of what stands beside the places, such as names of stations.
  [[nodiscard]] std::uint64_t bytes_of_columns() const;
  // True if the corners of the cells were made from the centers.
  [[nodiscard]] bool are_corners_made() const { return are_corners_made_; }
  // Returns the axes of a grid along axes, or null.
  [[nodiscard]] const LonLatAxes* axes() const { return axes_ ? &*axes_ : nullptr; }
  [[nodiscard]] std::vector<LonLat> places() const;
  [[nodiscard]] LonLat place(std::size_t index) const;
  // Returns the cells of a side that was read with cells. They are computed by the first call.
  [[nodiscard]] const CellSet& cells(const Execution& execution);
  // True if a side that was read with cells can be divided into tiles.
  [[nodiscard]] bool has_tiles(const Execution& execution) const;
  // True if its cells cover the sphere or are between parallels: tiles need that of one side.
  [[nodiscard]] bool is_walked() const;
  // True if its cells are between meridians and parallels.
  [[nodiscard]] bool has_parallels() const;
  // Returns the number of cells that are in memory, since no formula has them.
  [[nodiscard]] std::size_t num_stored() const;
  // Returns the share of the sphere that the largest of these cells has, or 0.
  [[nodiscard]] double largest_share() const;
  // Returns the lines of cells between meridians and parallels, or null.
  [[nodiscard]] const LonLatGrid* lines_between() const;
  // Returns the areas of the cells of a side that was read with cells, in steradians.
  [[nodiscard]] std::vector<double> areas(const Execution& execution);
  // Returns the cells for tiles. Precondition: has_tiles().
  [[nodiscard]] TiledCells tiled() const;
  // Returns what a file of fields gets to know. In netCDF, a grid along axes has these and no list of
  // places; and the cells of a file have bounds, if all have one ring of at most 16 corners.
  [[nodiscard]] WeightSide description(bool is_netcdf, const Execution& execution) const;
  // Adds what names the grid in a file, if it has a name: add_grid().
  void add_mapping(FieldSet& fields) const;

 private:
  void read_file(const FileName& file, bool has_cells, const Execution& execution,
                 std::vector<std::string> names);
  // Reads the places of netCDF, or the points of another file.
  void read_places(const FileName& file, const Execution& execution,
                   std::vector<std::string> names);
  // Takes what a file of netCDF says of places that are a list.
  void take_descriptions(bool has_cells);
  // Takes some cells of a grid with a name, which are no grid of their own.
  void take_some(const NamedGrid& grid, const GridOfFile& some, bool has_cells,
                 const Execution& execution);
  void make_cells(const Execution& execution);
  void take_facts_of_cells();

  std::string name_;
  std::string what_;
  FileName file_;
  CellFileOptions options_;
  std::optional<NamedGrid> named_;
  std::optional<LonLatGrid> lines_;  // of a file with a grid along axes
  std::optional<CellSet> cells_;
  LonLatGrid given_lines_;  // of a file with bounds of axes
  std::optional<LonLatAxes> axes_;
  std::vector<LonLat> places_;  // of a file without axes
  std::vector<std::uint64_t> shape_;
  std::vector<std::int32_t> mask_;
  std::vector<Column> columns_;
  std::vector<std::string> remarks_;
  bool are_corners_made_ = false;
  bool has_sites_ = false;
};

// Returns what extrapolates from one side to the other.
Extrapolator extrapolator_between(const RegridSide& source, const RegridSide& target,
                                  const ExtrapolationOptions& options, const Execution& execution);

}  // namespace rondel::formats
