// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Grids that a short name describes completely: those of models and of archives (target
/// rondel::geo).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel {

namespace grids {
class GridFormula;
}  // namespace grids

/// The attribute by which a file that Rondel wrote names the grid of its points, where neither a grid
/// mapping nor axes say it: "O320".
inline constexpr const char* grid_attribute = "rondel_grid";

/// The attributes by which files say on which grid points are: of a grid mapping for HEALPix (CF 1.13,
/// appendix F), `grid_attribute` for others, and none for `grid:`, whose axes say it.
struct GridMapping {
  std::vector<std::pair<std::string, std::string>> texts = {};
  std::vector<std::pair<std::string, double>> numbers = {};
};

/// Returns the name of the grid on which points are by the attributes of a variable or of a file: the
/// pixels of HEALPix by its grid mapping, as CF has it or as tools had it before, in any case of
/// letters, or what `grid_attribute` says; an empty text if they say neither, or two levels or orders
/// of pixels that contradict each other.
RONDEL_API std::string grid_named_by(const GridMapping& attributes);

/// Returns what lacks in attributes that say that points are pixels of HEALPix, so that
/// grid_named_by() does not know which ones: "refinement_level or healpix_nside ..."; an empty text
/// for other attributes.
RONDEL_API std::string lack_of_mapping(const GridMapping& attributes);

/// A grid that is given by its name; all cover the sphere but `tripolar:`, which has no cells in the
/// Antarctic:
///
/// | name | cells |
/// | --- | --- |
/// | `grid:DEG` | between meridians and parallels at equal steps; 180 must be a multiple of DEG |
/// | `grid:NLONxNLAT` | the same with NLON by NLAT cells; from longitude -180 eastward and from the south pole northward |
/// | `healpix:K`, `healpix:K:nested` | HEALPix with 12 * 4^K pixels, K from 0 to 13, numbered within base pixels |
/// | `healpix:K:ring` | the same, numbered ring by ring from the north pole |
/// | `F320` | ECMWF's regular Gaussian grid: 640 latitudes from north to south with 1280 longitudes each, from 0 eastward |
/// | `N320` | ECMWF's original reduced Gaussian grid, where its table is known: 32, 48, 64, 80, 96, 128, 160, 200, 256, 320, 400, 512, 640, 1024, 1280, 2000 |
/// | `O320` | ECMWF's octahedral reduced Gaussian grid: 20, 24, 28 ... cells in a row |
/// | `C384` | the equiangular cubed sphere with 6 * 384^2 cells, face by face |
/// | `R2B6` | triangles of an icosahedron whose sides are divided by 2 and then 6 times by halves: ICON's grid before it is optimized |
/// | `hexagons:R2B6` | the dual of these triangles: 12 pentagons and hexagons around their corners, between the circumcenters of the triangles |
/// | `tripolar:DEG` | an ocean grid of 360 / DEG columns, a multiple of 4: Mercator's rows from 78 degrees south, and from about 65 degrees north on a cap with two poles on land |
///
/// 1. Sides of cells are arcs of great circles, except for the parallels of `grid:` and `F`
///    (GridSides::parallels). In `N` and `O`, what is between two corners of a parallel is an arc,
///    for the rows on both sides of it.
/// 2. Borders of HEALPix's pixels are curves. They are chains of two arcs (more in coarse grids)
///    that leave the same area on either side as the curve: each pixel has 4 pi / (12 * 4^K), up to
///    rounding of corners. With GridSides::great_circles each side is one arc, which changes areas.
/// 3. Gaussian latitudes are the roots of a Legendre polynomial; rows end half way between them.
/// 4. Coordinates are the same bits on every machine.
/// 5. Tripolar grids are those of Murray (J. Comput. Phys. 126, 1996). Rows count from the south and
///    columns eastward from longitude 80, where one pole of the cap is; the other one is at -100. The
///    cap begins at the row whose border is nearest to 65 degrees north. Its last row is folded: cell
///    i of n shares its northern side with cell n - 1 - i. No row or column is there twice.
class RONDEL_API NamedGrid {
 public:
  /// True if a text has the form of a name of a grid, such as "N7", which is none.
  [[nodiscard]] static bool is_name(std::string_view text);

  /// Returns the forms of names, "grid:DEG, healpix:7 ...", for messages.
  [[nodiscard]] static std::string_view forms();

  /// \param sides  those of `grid:`, `F` and `healpix:`
  /// \throws InvalidInput for a text that names no grid, or one of too many cells
  explicit NamedGrid(std::string_view name, GridSides sides = GridSides::parallels);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t num_cells() const { return num_cells_; }
  /// Returns the lengths of the dimensions of the cells, the last one varying fastest: nlat, nlon
  /// for `grid:` and `F`; rows, columns for `tripolar:`; 6, n, n for `C`; otherwise the number of cells.
  [[nodiscard]] const std::vector<std::uint64_t>& shape() const { return shape_; }
  /// True unless the cells leave a part of the sphere out.
  [[nodiscard]] bool covers_sphere() const;
  /// Returns the attributes by which files say that points are those of this grid.
  [[nodiscard]] GridMapping mapping() const;
  /// Returns the axes of the centers of `grid:` and `F`, else null.
  [[nodiscard]] const LonLatAxes* axes() const { return axes_ ? &*axes_ : nullptr; }
  /// Returns the lines between the cells of `grid:` and `F`, else null.
  [[nodiscard]] const LonLatGrid* lines() const { return lines_ ? &*lines_ : nullptr; }
  /// Returns the center of a cell, in degrees.
  [[nodiscard]] LonLat center(std::size_t cell) const;
  /// Returns the center of each cell.
  [[nodiscard]] std::vector<LonLat> centers() const;
  /// Returns the cells, whose facts() have the name, the shape and the centers.
  [[nodiscard]] CellSet cells(const Execution& execution = {}) const;
  /// Returns some of the cells, with their centers.
  /// \param numbers  those of the cells, in any order
  /// \throws InvalidInput for `grid:` and `F`, whose cells are between lines; and with the index of a
  ///         number that no cell has, or that is there twice
  [[nodiscard]] CellSet cells(std::span<const Index> numbers,
                              const Execution& execution = {}) const;
  /// Returns the numbers of the cells whose centers are at most `max_apart_deg` degrees from places;
  /// nothing if one of the places is no center or two of them are the same, and for `grid:` and `F`.
  [[nodiscard]] std::vector<Index> numbers_at(std::span<const LonLat> places, double max_apart_deg,
                                              const Execution& execution = {}) const;

 private:
  friend class TiledCells;
  std::string name_;
  std::size_t num_cells_ = 0;
  std::vector<std::uint64_t> shape_;
  GridSides sides_;
  std::optional<LonLatGrid> lines_ = std::nullopt;  // of grid: and F
  std::optional<LonLatAxes> axes_ = std::nullopt;
  std::shared_ptr<const grids::GridFormula> formula_ = nullptr;  // of the others
};

}  // namespace rondel
