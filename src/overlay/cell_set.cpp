// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/cell_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "exact/vector.h"
#include "overlay/cell_set_data.h"
#include "overlay/measure.h"
#include "overlay/overlaps.h"
#include "overlay/tidy_rings.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel {
namespace overlay {

namespace {

// True if a cell with this border may be larger than a hemisphere: a corner is more than 90 degrees
// from the center.
bool is_wide(std::span<const BorderArc> border, const Point& center) {
  return std::ranges::any_of(border,
                             [&](const BorderArc& arc) { return dot(center, arc.from) < 0; });
}

// Returns the area of a cell with this border. For a cell of Shape::other the area of the
// subdivision decides which of the two sides of the rings is the inside.
double area_of(const Subdivision& cells, Index cell, std::span<const BorderArc> border,
               const Measures& measures) {
  const bool is_other = cells.shapes[cell] == Shape::other;
  if (!measures.is_sure || is_wide(border, cells.centers[cell])) {
    return is_other ? cells.area_of_other(cell) : cells.area_of_rings(cell);
  }
  const bool is_wrong = is_other && std::abs(measures.area - cells.area_of_other(cell)) > 1;
  return is_wrong ? cells.area_of_other(cell) : measures.area;
}

}  // namespace

CellSetData::CellSetData(Subdivision subdivision, std::vector<Index> whole, unsigned threads,
                         bool are_apart)
    : subdivision_(std::move(subdivision)),
      all_whole_(std::move(whole)),
      areas_(subdivision_.num_cells()),
      moments_(subdivision_.num_cells()),
      lengths_(subdivision_.num_cells()) {
  const auto measure = [&](std::size_t begin, std::size_t end) {
    std::vector<BorderArc> border;
    for (std::size_t c = begin; c < end; ++c) {
      border.clear();
      for (Index ring = subdivision_.cells[c]; ring < subdivision_.cells[c + 1]; ++ring) {
        const Index first = subdivision_.rings[ring];
        const Index last = subdivision_.rings[ring + 1] - 1;
        for (Halfedge h = first; h <= last; ++h) {
          border.push_back(
              {subdivision_.origin(h), subdivision_.origin(h == last ? first : h + 1)});
        }
      }
      const Measures measures = measures_of(border, subdivision_.centers[c]);
      areas_[subdivision_.names[c]] =
          area_of(subdivision_, static_cast<Index>(c), border, measures);
      moments_[subdivision_.names[c]] = measures.moment;
      lengths_[subdivision_.names[c]] = measures.length;
    }
  };
  system::parallel_for(threads, subdivision_.num_cells(), cells_per_task, measure);
  for (const Index cell : all_whole_) areas_[cell] = 4 * std::numbers::pi;
  // Cells that turn counterclockwise and meet another cell at each edge cover the sphere, once or
  // several times; the area tells how often.
  const double total = std::accumulate(areas_.begin(), areas_.end(), 0.0);
  covers_sphere_ =
      !all_whole_.empty() ||
      (subdivision_.is_closed && std::abs(total - 4 * std::numbers::pi) < std::numbers::pi);
  are_apart_ = are_apart || (covers_sphere_ && all_whole_.empty());
}

CellSetData::CellSetData(PreparedGrid grid)
    : subdivision_({}, false, 1),
      grid_(std::move(grid)),
      covers_sphere_(grid_->covers_sphere()),
      are_apart_(true),
      areas_(grid_->areas()),
      moments_(grid_->moments()),
      lengths_(grid_->lengths()) {}

void CellSetData::keep_straight_sides(CompressedRows<LonLatSide> sides, unsigned threads) {
  if (sides.values.empty()) return;
  CompressedRows<LonLatSide> kept;
  kept.offsets.reserve(sides.offsets.size());
  std::vector<bool> has_arcs(num_cells(), false);
  for (Index c = 0; c < subdivision_.num_cells(); ++c) {
    has_arcs[subdivision_.names[c]] = subdivision_.cells[c] < subdivision_.cells[c + 1];
  }
  if (std::ranges::find(has_arcs, false) == has_arcs.end()) {
    kept = std::move(sides);
  } else {
    for (std::size_t i = 0; i < sides.size(); ++i) {
      kept.append(has_arcs[i] ? sides[i] : std::span<const LonLatSide>());
    }
  }
  straight_sides_.emplace(std::move(kept), areas_, lengths_, threads);
}

std::vector<Point> CellSetData::moments(Borders borders) const {
  std::vector<Point> result = moments_;
  if (borders == Borders::arcs || !straight_sides_) return result;
  for (Index i = 0; i < result.size(); ++i) {
    if (!straight_sides_->rows()[i].empty()) result[i] = straight_sides_->moment(i);
  }
  return result;
}

const std::vector<CrossingCells>& CellSetData::overlaps(const Execution& execution) const {
  std::call_once(are_overlaps_known_, [&] {
    if (!are_apart_) overlaps_ = overlaps_of(subdivision_, all_whole_, execution);
  });
  return overlaps_;
}

std::vector<CrossingCells> CellSetData::some_overlaps(OverlapsWanted wanted,
                                                      std::span<const std::int32_t> mask,
                                                      const Execution& execution) const {
  if (are_apart_) return {};
  if (!all_whole_.empty()) return overlaps(execution);
  return overlay::some_overlaps(subdivision_, wanted, mask, execution);
}

bool CellSetData::has_overlaps(const Execution& execution) const {
  std::call_once(is_any_overlap_known_, [&] {
    if (are_apart_) return;
    has_any_overlap_ = !some_overlaps(OverlapsWanted::any, {}, execution).empty();
    if (!has_any_overlap_) std::call_once(are_overlaps_known_, [] {});
  });
  return has_any_overlap_;
}

const std::vector<CrossingCells>& CellSetData::cells_crossing_themselves() const {
  std::call_once(is_crossing_known_, [&] {
    if (!are_apart_) crossing_ = overlay::cells_crossing_themselves(subdivision_, {.threads = 1});
  });
  return crossing_;
}

void CellSetData::require_simple_cells() const {
  const std::vector<CrossingCells>& crossing = cells_crossing_themselves();
  if (!crossing.empty()) throw InvalidInput(message_of(crossing.front()), crossing.front().first);
}

CellRings rings_of(const CellSetData& data) {
  CellRings result = rings_of(data.subdivision());
  result.whole = data.all_whole();
  return result;
}

CellRings rings_of(const Subdivision& cells) {
  std::vector<Index> places(cells.num_cells());
  for (Index c = 0; c < places.size(); ++c) places[cells.names[c]] = c;
  CellRings result;
  result.points = cells.points;
  for (const Index c : places) {
    for (Index ring = cells.cells[c]; ring < cells.cells[c + 1]; ++ring) {
      result.append_ring(cells.corners_of(ring));
    }
    result.end_cell();
  }
  return result;
}

CellRings given_rings_of(const CellSetData& data) {
  CellRings result = rings_of(data);
  const Subdivision& cells = data.subdivision();
  if (cells.given_starts.empty()) return result;
  for (Index c = 0; c < cells.num_cells(); ++c) {
    std::uint64_t r = result.cells[cells.names[c]];
    for (Index ring = cells.cells[c]; ring < cells.cells[c + 1]; ++ring, ++r) {
      const auto begin = result.corners.begin() + static_cast<std::ptrdiff_t>(result.rings[r]);
      const auto end = result.corners.begin() + static_cast<std::ptrdiff_t>(result.rings[r + 1]);
      std::rotate(begin, end - static_cast<std::ptrdiff_t>(cells.given_starts[ring]), end);
    }
  }
  return result;
}

void require_arcs(const CellSetData& cells) {
  if (cells.grid() == nullptr) return;
  throw InvalidInput("cells between parallels have no sides on great circles");
}

}  // namespace overlay

namespace {

using overlay::CellSetData;
using overlay::Subdivision;

// Returns the cells of a diagram as CellRings.
CellRings rings_of(Cells cells) {
  CellRings rings;
  rings.points = std::move(cells.points);
  for (std::size_t i = 0; i < cells.rings.size(); ++i) {
    if (!cells.rings[i].empty()) rings.rings.push_back(cells.rings.offsets[i + 1]);
    rings.end_cell();
  }
  rings.corners = std::move(cells.rings.values);
  return rings;
}

// Returns the unit vectors of the sites.
std::vector<Point> directions(const Triangulation& triangulation) {
  std::vector<Point> result;
  result.reserve(triangulation.num_sites());
  for (const Point& p : triangulation.sites().points()) {
    result.push_back(normalized(p - triangulation.sphere().center));
  }
  return result;
}

[[noreturn]] void refuse(std::size_t cell, const std::string& what) {
  throw InvalidInput("cell " + std::to_string(cell) + " " + what, cell);
}

// True if the shorter arc between two unit vectors is defined and is no point.
bool is_arc(const Point& p, const Point& q) {
  constexpr double surely = 1e-20;
  const Point normal = cross(p, q - p);
  return dot(normal, normal) > surely ||
         (!is_same_site(p, q) && !is_same_site(p, Point{-q.x, -q.y, -q.z}));
}

// Throws InvalidInput, with the cell, for arrays that are no valid cells.
void validate(const CellRings& cells) {
  if (cells.rings.empty() || !system::are_offsets(cells.cells, cells.rings.size() - 1) ||
      !system::are_offsets(cells.rings, cells.corners.size())) {
    throw InvalidInput("the offsets of cells and rings do not fit");
  }
  if (cells.corners.size() >= no_index) throw InvalidInput("there are too many corners");
  for (std::size_t k = 0; k < cells.whole.size(); ++k) {
    const Index i = cells.whole[k];
    if (i >= cells.num_cells() || (k > 0 && i <= cells.whole[k - 1])) {
      throw InvalidInput("the cells that are the whole sphere are not in order", i);
    }
    if (cells.cells[i] < cells.cells[i + std::size_t{1}]) {
      refuse(i, "is the whole sphere and has rings");
    }
  }
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    for (std::uint64_t r = cells.cells[i]; r < cells.cells[i + 1]; ++r) {
      const std::uint64_t size = cells.rings[r + 1] - cells.rings[r];
      if (size < 3) refuse(i, "has a ring of " + std::to_string(size) + " corners");
      for (std::uint64_t k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
        const Index p = cells.corners[k];
        if (p >= cells.points.size()) refuse(i, "has a corner " + std::to_string(p));
        constexpr double most = 1e-12;
        if (!(std::abs(dot(cells.points[p], cells.points[p]) - 1) <= most)) {
          refuse(i, "has a corner that is no unit vector");
        }
      }
      for (std::uint64_t k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
        const std::uint64_t next = k + 1 < cells.rings[r + 1] ? k + 1 : cells.rings[r];
        if (!is_arc(cells.points[cells.corners[k]], cells.points[cells.corners[next]])) {
          refuse(i, "has a side of 0 or 180 degrees");
        }
      }
    }
  }
}

// Throws InvalidInput for straight sides that do not fit the cells, or are no longitudes and
// latitudes.
void validate(const CompressedRows<LonLatSide>& sides, std::size_t num_cells) {
  if (sides.size() == 0 && sides.values.empty()) return;
  if (sides.size() != num_cells || !system::are_offsets(sides.offsets, sides.values.size())) {
    throw InvalidInput("the offsets of the straight sides do not fit");
  }
  constexpr double max_lon = 1e4;
  const auto is_place = [](const LonLat& p) {
    return std::abs(p.lon_deg) <= max_lon && std::abs(p.lat_deg) <= 90;
  };
  for (std::size_t i = 0; i < num_cells; ++i) {
    for (const LonLatSide& side : sides[i]) {
      if (!is_place(side.from) || !is_place(side.to)) refuse(i, "has a side that is no place");
    }
  }
}

// Prepares cells that are known not to overlap each other or themselves.
std::shared_ptr<CellSetData> data_of_apart(const CellRings& cells, const Execution& execution) {
  validate(cells);
  return std::make_shared<CellSetData>(Subdivision(cells, false, execution.threads),
                                       std::vector<Index>{}, execution.threads, true);
}

// Returns the numbers half way between consecutive ones.
std::vector<double> middles(const std::vector<double>& lines) {
  std::vector<double> result;
  for (std::size_t k = 0; k + 1 < lines.size(); ++k) {
    result.push_back((lines[k + 1] + lines[k]) / 2);
  }
  return result;
}

}  // namespace

std::string_view name_of(MissingCorners corners) noexcept {
  return system::name_in({"error", "made"}, corners);
}

std::string_view name_of(GridSides sides) noexcept {
  return system::name_in({"parallels", "great_circles"}, sides);
}

CellSet::CellSet() : CellSet(polygons({})) {}

CellSet::CellSet(std::shared_ptr<const CellSetData> data, CellFacts facts)
    : data_(std::move(data)), facts_(std::make_shared<const CellFacts>(std::move(facts))) {}

CellSet CellSet::polygons(const CellRings& cells, const Execution& execution) {
  return polygons(cells, {}, execution);
}

CellSet CellSet::polygons(const CellRings& cells, CompressedRows<LonLatSide> sides,
                          const Execution& execution) {
  const system::Call call(execution);
  validate(cells);
  validate(sides, cells.num_cells());
  std::vector<Index> whole = cells.whole;
  Subdivision subdivision = overlay::sound_cells(cells, whole, execution);
  const auto data =
      std::make_shared<CellSetData>(std::move(subdivision), std::move(whole), execution.threads);
  data->keep_straight_sides(std::move(sides), execution.threads);
  return CellSet(data);
}

CellSet CellSet::valid_polygons(const CellRings& cells, const Execution& execution) {
  const system::Call call(execution);
  validate(cells);
  Subdivision subdivision(cells, false, execution.threads);
  // Rings no wider than rounding are dropped here, too.
  if (overlay::may_be_untidy(cells, subdivision, execution.threads)) {
    return polygons(cells, execution);
  }
  return CellSet(std::make_shared<const CellSetData>(
      std::move(subdivision), std::vector<Index>(cells.whole), execution.threads));
}

CellSet CellSet::voronoi(const Triangulation& triangulation, const Execution& execution) {
  const system::Call call(execution);
  std::vector<Index> whole;
  if (triangulation.num_vertices() == 1) {
    std::vector<bool> is_hidden(triangulation.num_sites());
    for (const auto& [site, representative] : triangulation.duplicates()) is_hidden[site] = true;
    for (const auto& [site, face] : triangulation.hidden()) is_hidden[site] = true;
    whole = {static_cast<Index>(std::ranges::find(is_hidden, false) - is_hidden.begin())};
  }
  Subdivision cells(rings_of(rondel::cells(triangulation, execution)), true, execution.threads);
  if (!cells.areas_of_others.empty()) {  // this is rare, and rings_of() copies all cells
    if (const auto tidy = overlay::tidied(overlay::rings_of(cells), cells)) {
      cells = Subdivision(*tidy, true, execution.threads);
    }
  }
  return CellSet(std::make_shared<const CellSetData>(std::move(cells), std::move(whole),
                                                     execution.threads, true),
                 {.has_corners = false});
}

CellSet CellSet::triangles(const Triangulation& triangulation, const Execution& execution) {
  const system::Call call(execution);
  CellRings rings;
  rings.points = directions(triangulation);
  if (triangulation.dimension() == 2) {
    for (Index f = 0; f < triangulation.num_faces(); ++f) {
      if (triangulation.is_ghost(f)) continue;
      rings.append_ring(triangulation.faces()[f]);
      rings.end_cell();
    }
  }
  return CellSet(data_of_apart(rings, execution), {.has_corners = false});
}

CellSet CellSet::lonlat_grid(const LonLatGrid& grid, GridSides sides, const Execution& execution) {
  const system::Call call(execution);
  const auto data = sides == GridSides::great_circles
                        ? data_of_apart(overlay::rings_of(grid), execution)
                        : std::make_shared<CellSetData>(overlay::PreparedGrid(grid));
  data->keep_lines(grid);
  CellFacts facts;
  facts.axes = {middles(grid.lon_deg), middles(grid.lat_deg)};
  facts.shape = {facts.axes.lat_deg.size(), facts.axes.lon_deg.size()};
  return CellSet(data, std::move(facts));
}

CellSet CellSet::lonlat_grid(const GlobalGrid& grid, GridSides sides, const Execution& execution) {
  if (grid.num_lon == 0 || grid.num_lat == 0 || grid.num_lon >= no_index / grid.num_lat) {
    throw InvalidInput("a grid of " + std::to_string(grid.num_lon) + " by " +
                       std::to_string(grid.num_lat) + " cells has none or too many");
  }
  CellSet cells = lonlat_grid(grid.lines(), sides, execution);
  CellFacts facts = cells.facts();
  facts.axes = grid.centers();
  return cells.with_facts(std::move(facts));
}

std::size_t CellSet::num_cells() const { return data_->areas().size(); }
std::span<const double> CellSet::areas() const {
  data_->require_simple_cells();
  return data_->defined_areas().empty() ? data_->areas() : data_->defined_areas();
}
std::vector<Point> CellSet::centers() const {
  data_->require_simple_cells();
  const std::vector<Point>& moments = data_->moments();
  std::vector<Point> centers(num_cells());
  for (std::size_t i = 0; i < centers.size(); ++i) {
    constexpr double rounding = 1e-13;  // of the moment of a cell of the size of the sphere
    const auto& [x, y, z] = moments[i];
    const bool is_balanced =
        std::max({std::abs(x), std::abs(y), std::abs(z)}) <= rounding * data_->areas()[i];
    if (!is_balanced) centers[i] = normalized(moments[i]);
  }
  return centers;
}
CellRings CellSet::rings() const {
  overlay::require_arcs(*data_);
  return overlay::rings_of(*data_);
}
CellRings CellSet::given_rings() const {
  overlay::require_arcs(*data_);
  return overlay::given_rings_of(*data_);
}
CompressedRows<LonLatSide> CellSet::sides() const {
  return data_->straight_sides() != nullptr ? data_->straight_sides()->rows()
                                            : CompressedRows<LonLatSide>();
}
const LonLatGrid* CellSet::lines() const { return data_->lines(); }
bool CellSet::has_parallels() const { return data_->grid() != nullptr; }
bool CellSet::covers_sphere() const { return data_->covers_sphere(); }

}  // namespace rondel
