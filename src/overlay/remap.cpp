// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/remap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "exact/eft.h"
#include "exact/vector.h"
#include "overlay/cell_set_data.h"
#include "overlay/cover_triangulation.h"
#include "overlay/grid_pieces.h"
#include "overlay/linear_weights.h"
#include "overlay/measure.h"
#include "overlay/pieces.h"
#include "overlay/shared_places.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using overlay::CellSetData;
using overlay::PieceRows;

// Returns the pieces with those of the cells `whole`, which are the whole sphere and have no pieces
// yet: all of `cells`, which are the other side.
PieceRows with_whole_cells(const PieceRows& pieces, const std::vector<Index>& whole,
                           const CellSetData& cells, bool has_moments) {
  PieceRows result;
  auto next = whole.begin();
  for (std::size_t row = 0; row + 1 < pieces.offsets.size(); ++row) {
    if (next != whole.end() && *next == row) {
      ++next;
      for (std::size_t i = 0; i < cells.areas().size(); ++i) {
        if (!(cells.areas()[i] > 0)) continue;
        result.columns.push_back(static_cast<Index>(i));
        result.areas.push_back(cells.areas()[i]);
        if (has_moments) result.moments.push_back(cells.moments()[i]);
      }
    }
    for (std::uint64_t k = pieces.offsets[row]; k < pieces.offsets[row + 1]; ++k) {
      result.columns.push_back(pieces.columns[k]);
      result.areas.push_back(pieces.areas[k]);
      if (has_moments) result.moments.push_back(pieces.moments[k]);
    }
    result.end_row();
  }
  return result;
}

// Returns rows without pieces.
PieceRows empty_rows(std::size_t num_rows) {
  PieceRows rows;
  rows.offsets.assign(num_rows + 1, 0);
  return rows;
}

// Computes the pieces of two sets of cells of which neither covers the sphere. Rows are targets.
PieceRows overlay_of_parts(const CellSetData& source, const CellSetData& target, bool has_moments,
                           const Execution& execution) {
  const overlay::Subdivision& sources = source.subdivision();
  const overlay::Subdivision& targets = target.subdivision();
  const auto with = [&](bool is_source_filled, const Execution& told) {
    if (is_source_filled) {
      return pieces_of_parts(targets, target.sizes(), sources, has_moments, told);
    }
    return transposed(pieces_of_parts(sources, source.sizes(), targets, has_moments, told),
                      target.areas().size());
  };
  return overlay::with_one_filled(sources, targets, {"source", "target"}, execution, with);
}

// Computes the pieces of cells of which none is the whole sphere; targets that are have none.
PieceRows overlay_of_bordered(const CellSetData& source, const CellSetData& target,
                              bool has_moments, const Execution& execution) {
  const std::size_t num_targets = target.areas().size();
  if (target.grid() != nullptr && source.grid() != nullptr) {
    return overlay::GridOverlay(*target.grid(), *source.grid())
        .pieces(0, target.grid()->num_cells(), has_moments);
  }
  if (source.grid() != nullptr) return pieces(target, *source.grid(), has_moments, execution);
  if (target.grid() != nullptr) {
    return transposed(pieces(source, *target.grid(), has_moments, execution), num_targets);
  }
  if (source.covers_sphere()) {
    return pieces(target.subdivision(), target.sizes(), source.subdivision(), has_moments,
                  execution);
  }
  if (target.covers_sphere() && target.all_whole().empty()) {
    return transposed(
        pieces(source.subdivision(), source.sizes(), target.subdivision(), has_moments, execution),
        num_targets);
  }
  return overlay_of_parts(source, target, has_moments, execution);
}

// Computes the pieces of two sets of cells. Rows are targets, columns are sources.
PieceRows overlay_of(const CellSetData& source, const CellSetData& target, bool has_moments,
                     const Execution& execution) {
  const std::size_t num_sources = source.areas().size();
  const std::size_t num_targets = target.areas().size();
  if (source.whole() != no_index) {
    return transposed(
        with_whole_cells(empty_rows(num_sources), source.all_whole(), target, has_moments),
        num_targets);
  }
  if (target.whole() == no_index) {
    return overlay_of_bordered(source, target, has_moments, execution);
  }
  // Targets that overlap may be there beside the whole sphere, each for itself.
  const bool are_all_empty =
      std::ranges::all_of(target.subdivision().shapes,
                          [](overlay::Shape shape) { return shape == overlay::Shape::empty; });
  return with_whole_cells(are_all_empty
                              ? empty_rows(num_targets)
                              : overlay_of_bordered(source, target, has_moments, execution),
                          target.all_whole(), source, has_moments);
}

// Removes the pieces of masked cells, and the sums of rows and columns, which are not valid any
// more.
void drop_masked(const CellSet& source, const CellSet& target, PieceRows& pieces) {
  const std::vector<std::int32_t>& source_mask = source.facts().mask;
  const std::vector<std::int32_t>& target_mask = target.facts().mask;
  if (source_mask.empty() && target_mask.empty()) return;
  const auto is_out = [](const std::vector<std::int32_t>& mask, std::size_t cell) {
    return !mask.empty() && mask[cell] == 0;
  };
  std::uint64_t kept = 0;
  std::uint64_t begin = 0;
  for (std::size_t j = 0; j + 1 < pieces.offsets.size(); ++j) {
    const std::uint64_t end = pieces.offsets[j + 1];
    for (std::uint64_t k = begin; k < end; ++k) {
      if (is_out(target_mask, j) || is_out(source_mask, pieces.columns[k])) continue;
      pieces.columns[kept] = pieces.columns[k];
      pieces.areas[kept] = pieces.areas[k];
      if (!pieces.moments.empty()) pieces.moments[kept] = pieces.moments[k];
      ++kept;
    }
    begin = end;
    pieces.offsets[j + 1] = kept;
  }
  pieces.columns.resize(kept);
  pieces.areas.resize(kept);
  if (!pieces.moments.empty()) pieces.moments.resize(kept);
  pieces.row_sums.clear();
}

// Returns the cells with another mask, unless this is empty. Throws InvalidInput if it does not
// have one value for each cell.
CellSet masked(const CellSet& cells, const std::vector<std::int32_t>& mask, const char* name) {
  if (mask.empty()) return cells;
  if (mask.size() != cells.num_cells()) {
    throw InvalidInput(std::string("the mask of the ") + name + " has " +
                       std::to_string(mask.size()) + " values for " +
                       std::to_string(cells.num_cells()) + " cells");
  }
  CellFacts facts = cells.facts();
  facts.mask = mask;
  return cells.with_facts(std::move(facts));
}

// Prefetches the value that a loop over pieces will need soon. Columns are anywhere in memory.
template <class T>
void prefetch_column(std::span<const Index> columns, std::size_t k, const std::vector<T>& values) {
  if (k + system::prefetch_distance < columns.size()) {
    system::prefetch(&values[columns[k + system::prefetch_distance]]);
  }
}

// Returns the sum of the moments of each column.
std::vector<Point> column_moments(const PieceRows& pieces, std::size_t num_columns) {
  std::vector<Point> sums(num_columns);
  for (std::size_t k = 0; k < pieces.moments.size(); ++k) {
    prefetch_column(pieces.columns, k, sums);
    Point& sum = sums[pieces.columns[k]];
    sum = sum + pieces.moments[k];
  }
  return sums;
}

// Returns the areas of cells that count.
std::vector<double> areas_of(const std::vector<double>& covered,
                             const overlay::CountedSizes& sizes) {
  std::vector<double> areas = sizes.areas();
  for (std::size_t i = 0; i < areas.size(); ++i) {
    areas[i] = overlay::counted_area(covered[i], areas[i], sizes.lengths()[i]);
  }
  return areas;
}

// Returns the covered share of each cell.
std::vector<double> fractions(const std::vector<double>& covered,
                              const std::vector<double>& areas) {
  std::vector<double> result(areas.size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    result[i] = areas[i] > 0 ? covered[i] / areas[i] : 0;
  }
  return result;
}

}  // namespace

namespace overlay {

std::vector<Point> means_of(std::span<const double> areas, std::span<const Point> moments) {
  std::vector<Point> means(areas.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (areas[i] > 0) means[i] = moments[i] / areas[i];
  }
  return means;
}

// The moments of a source sum up to zero except for rounding, which gradients would multiply by the
// inverse of a cell's width; the largest piece of the source is corrected by the sum. A piece that
// is narrower than rounding has a moment that is rounding alone, if that would be farther away from
// the mean than two points of the sphere are.
std::vector<Point> moments_around(const std::vector<Point>& means, const Remap& remap,
                                  std::vector<Point> moments) {
  std::vector<Point> sums(means.size());
  std::vector<std::uint64_t> largest(means.size(), moments.size());
  for (std::size_t k = 0; k < moments.size(); ++k) {
    prefetch_column(remap.pieces.values, k, means);
    prefetch_column(remap.pieces.values, k, sums);
    prefetch_column(remap.pieces.values, k, largest);
    const Index i = remap.pieces.values[k];
    moments[k] = moments[k] - remap.areas[k] * means[i];
    if (norm(moments[k]) > 2 * remap.areas[k]) moments[k] = {};
    sums[i] = sums[i] + moments[k];
    if (largest[i] == moments.size() || remap.areas[k] > remap.areas[largest[i]]) largest[i] = k;
  }
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (largest[i] < moments.size()) moments[largest[i]] = moments[largest[i]] - sums[i];
  }
  return moments;
}

}  // namespace overlay

namespace {

// Returns the cells in spatial order, as indices in the input, or nothing if they are those of a
// grid, which is in order itself.
std::span<const Index> spatial_order_of(const CellSetData& cells) {
  if (cells.grid() != nullptr || cells.whole() != no_index) return {};
  return cells.subdivision().names;
}

// Returns the weights of order 1. The columns of a row are different and ascending.
Weights mean_weights(const Remap& remap, const std::vector<double>& target_areas,
                     unsigned threads) {
  Weights weights;
  weights.offsets = remap.pieces.offsets;
  weights.columns.resize(remap.pieces.values.size());
  weights.values.resize(remap.areas.size());
  system::parallel_for(threads, target_areas.size(), overlay::cells_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t j = begin; j < end; ++j) {
                           for (std::uint64_t k = remap.pieces.offsets[j];
                                k < remap.pieces.offsets[j + 1]; ++k) {
                             weights.columns[k] = remap.pieces.values[k];
                             weights.values[k] = remap.areas[k] / target_areas[j];
                           }
                         }
                       });
  return weights;
}

// Completes a result whose sides, order and norm are set: computes the pieces, the areas, the
// fractions and the weights.
void complete(Remap& result, CellOverlap overlap, const Execution& execution) {
  const CellSetData& sources = CellSetData::of(result.source);
  const CellSetData& targets = CellSetData::of(result.target);
  const std::vector<std::int32_t>& source_mask = result.source.facts().mask;
  const bool is_second = result.order == 2;
  const CellOverlap of_source = overlap == CellOverlap::each ? CellOverlap::error : overlap;
  const overlay::OverlaySide of_sources =
      overlay::taking_part(sources, result.source.facts(), of_source, "source", execution);
  const overlay::OverlaySide of_targets =
      overlay::taking_part(targets, result.target.facts(), overlap, "target", execution);
  const std::size_t num_sources = result.source.num_cells();
  PieceRows pieces =
      overlay::joined_parts(overlay_of(*of_sources.data, *of_targets.data, is_second, execution),
                            of_targets, result.target.num_cells(), of_sources);
  const overlay::Borders borders = CellSetData::borders_between(sources, targets);
  const overlay::CountedSizes source_sizes(sources, of_sources, borders);
  drop_masked(result.source, result.target, pieces);
  // With order 2 sums are those of the rows as they are, which weights_with_values() and tiles of
  // weights compute again.
  if (pieces.row_sums.empty() || is_second) find_sums(pieces, num_sources);
  if (!is_second) pieces.moments.clear();
  const std::vector<Point> moments_of_sources = column_moments(pieces, num_sources);
  result.pieces = {std::move(pieces.offsets), std::move(pieces.columns)};
  result.areas = std::move(pieces.areas);
  result.source_areas = areas_of(pieces.column_sums, source_sizes);
  result.target_areas =
      areas_of(pieces.row_sums, overlay::CountedSizes(targets, of_targets, borders));
  result.source_fractions = fractions(pieces.column_sums, result.source_areas);
  result.target_fractions = fractions(pieces.row_sums, result.target_areas);

  overlay::CellGradients gradients;
  if (is_second) {
    const std::vector<Point> means = overlay::means_of(pieces.column_sums, moments_of_sources);
    std::vector<Point> centers = overlay::means_of(source_sizes.areas(), source_sizes.moments());
    result.moments = overlay::moments_around(means, result, std::move(pieces.moments));
    gradients = cell_gradients(sources, centers, source_mask, execution.threads);
    result.source_centers = std::move(centers);
  }
  const std::vector<double>& areas =
      result.norm == RemapNorm::fracarea ? pieces.row_sums : result.target_areas;
  result.weights = is_second ? linear_weights(result, gradients, areas, spatial_order_of(targets),
                                              execution.threads)
                             : mean_weights(result, areas, execution.threads);
  result.weights.num_columns = num_sources;
}

// Returns the name of the file that a message is about, or those of both sides; empty if one of
// them has no name.
std::string file_of(std::string_view message, const std::string& source,
                    const std::string& target) {
  if (message.starts_with("source")) return source;
  if (message.starts_with("target")) return target;
  return source.empty() || target.empty() ? std::string() : source + " to " + target;
}

}  // namespace

std::string_view name_of(RemapNorm norm) noexcept {
  return system::name_in({"destarea", "fracarea"}, norm);
}

std::string_view name_of(RemapLimiter limiter) noexcept {
  return system::name_in({"none", "bounds", "slopes"}, limiter);
}

std::string_view name_of(CellOverlap overlap) noexcept {
  return system::name_in({"error", "first", "share", "each"}, overlap);
}

Remap remap(const CellSet& source, const CellSet& target, const RemapOptions& options,
            const Execution& execution) {
  const system::Call call(execution);
  if (options.order != 1 && options.order != 2) {
    throw InvalidInput("the order is " + std::to_string(options.order) + ", not 1 or 2");
  }
  Remap result;
  result.source = masked(source, options.source_mask, "source");
  result.target = masked(target, options.target_mask, "target");
  result.order = options.order;
  result.norm = options.norm;
  try {
    complete(result, options.overlap, execution);
  } catch (const InvalidInput& error) {
    const std::string file = file_of(error.what(), source.facts().name, target.facts().name);
    if (file.empty()) throw;
    throw InvalidInput(file + ": " + error.what(), error.index());
  }
  return result;
}

Weights weights_with_values(const Remap& remap, std::span<const std::int32_t> has_value,
                            const Execution& execution) {
  const system::Call call(execution);
  const std::size_t num_sources = remap.source_areas.size();
  if (remap.moments.size() != remap.areas.size() || remap.source_centers.size() != num_sources) {
    throw InvalidInput("the remapping is not of order 2");
  }
  if (has_value.size() != num_sources) {
    throw InvalidInput(std::to_string(has_value.size()) + " numbers for " +
                       std::to_string(num_sources) + " sources");
  }
  if (std::ranges::count(has_value, 0) == 0) return remap.weights;
  std::vector<std::int32_t> mask(has_value.begin(), has_value.end());
  const std::vector<std::int32_t>& source_mask = remap.source.facts().mask;
  for (std::size_t i = 0; i < source_mask.size(); ++i) {
    if (source_mask[i] == 0) mask[i] = 0;
  }
  overlay::CellGradients gradients =
      cell_gradients(CellSetData::of(remap.source), remap.source_centers, mask, execution.threads);
  for (std::size_t i = 0; i < num_sources; ++i) {
    if (mask[i] != 0) continue;
    for (std::uint64_t k = gradients.offsets[i]; k < gradients.offsets[i + 1]; ++k) {
      gradients.slopes[k] = {0, 0, 0};
    }
  }
  std::vector<double> areas = remap.target_areas;
  for (std::size_t j = 0; j < areas.size() && remap.norm == RemapNorm::fracarea; ++j) {
    exact::DoubleDouble sum{};
    for (std::uint64_t k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k) {
      add_term(remap.areas[k], sum);
    }
    areas[j] = sum.hi + sum.lo;
  }
  // A tile has no cells of its targets, whose order changes nothing but the time.
  const bool has_targets = remap.target.num_cells() == areas.size();
  Weights weights = linear_weights(
      remap, gradients, areas,
      has_targets ? spatial_order_of(CellSetData::of(remap.target)) : std::span<const Index>(),
      execution.threads);
  weights.num_columns = num_sources;
  return weights;
}

void apply_gradients(const Remap& remap, std::span<const double> means,
                     std::span<const Point> gradients, std::span<double> out) {
  const std::size_t num_sources = remap.source_areas.size();
  if (remap.moments.size() != remap.areas.size()) {
    throw InvalidInput("the remapping is not of order 2");
  }
  if (means.size() != num_sources || gradients.size() != num_sources ||
      out.size() != remap.target_areas.size()) {
    throw InvalidInput("the sizes of means, gradients and targets do not fit the remapping");
  }
  for (std::size_t j = 0; j < out.size(); ++j) {
    double sum = 0;
    double area = 0;
    for (std::uint64_t k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k) {
      const Index i = remap.pieces.values[k];
      sum += remap.areas[k] * means[i] + dot(remap.moments[k], gradients[i]);
      area += remap.areas[k];
    }
    out[j] = area > 0 ? sum / area : std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace rondel
