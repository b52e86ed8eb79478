// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/pieces.h"

#include <algorithm>
#include <span>

#include "overlay/arcs.h"
#include "overlay/crossings.h"
#include "overlay/measure.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t cells_per_block = 1024;

struct MeasuredPiece {
  Index beyond;
  Point origin;
  double area = 0;
  double length = 0;  // of its boundary, roughly
  bool is_large = false;
  Point moment{};
};

bool is_rounding(const MeasuredPiece& piece) {
  return piece.area <= area_of_rounding(piece.length);
}

class PieceMaker {
 public:
  PieceMaker(const Subdivision& cells, const Subdivision& cover, const Crossings& crossings,
             bool has_moments)
      : cover_(cover), arcs_(cells, cover, crossings), has_moments_(has_moments) {}

  // Of a cell that has a ring, in the order of the columns.
  std::span<const MeasuredPiece> operator()(Index cell) {
    pieces_.clear();
    const std::span<const PieceArc> arcs = arcs_(cell);
    add(arcs);
    for (MeasuredPiece& piece : pieces_) {
      if (piece.is_large) measure_large(arcs, piece);
    }
    drop_rounding();
    std::ranges::sort(pieces_, {},
                      [&](const MeasuredPiece& piece) { return cover_.names[piece.beyond]; });
    return pieces_;
  }

 private:
  void add(std::span<const PieceArc> arcs) {
    constexpr std::size_t many = 128;
    if (arcs.size() > many) {
      sorted_.assign(arcs.begin(), arcs.end());
      std::ranges::stable_sort(sorted_, {}, &PieceArc::beyond);
      arcs = sorted_;
    }
    std::size_t last = 0;
    for (const PieceArc& arc : arcs) {
      if (pieces_.empty() || pieces_[last].beyond != arc.beyond)
        last = find(arc, arcs.size() > many);
      add(arc, pieces_[last]);
    }
  }
  std::size_t find(const PieceArc& arc, bool is_sorted) {
    if (!is_sorted) {
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        if (pieces_[k].beyond == arc.beyond) return k;
      }
    }
    pieces_.push_back({arc.beyond, arc.from});
    return pieces_.size() - 1;
  }
  void add(const PieceArc& arc, MeasuredPiece& piece) const {
    piece.is_large |= is_far(piece.origin, arc.from);
    if (arc.from != piece.origin && arc.to != piece.origin) {
      piece.area += triangle_area(piece.origin, arc.from, arc.to);
    }
    piece.length += rough_length(arc.from, arc.to);
    if (has_moments_) piece.moment = piece.moment + moment_of_arc(arc.from, arc.to);
  }

  // But a cell that is no larger keeps its largest piece.
  void drop_rounding() {
    if (std::ranges::all_of(pieces_, is_rounding)) {
      const MeasuredPiece largest = *std::ranges::max_element(pieces_, {}, &MeasuredPiece::area);
      pieces_.clear();
      if (largest.area > 0) pieces_.push_back(largest);
    } else {
      std::erase_if(pieces_, is_rounding);
    }
  }

  void measure_large(std::span<const PieceArc> arcs, MeasuredPiece& piece) {
    border_.clear();
    for (const PieceArc& arc : arcs) {
      if (arc.beyond == piece.beyond) border_.push_back({arc.from, arc.to});
    }
    piece.area = measures_of(border_).area;
  }

  const Subdivision& cover_;
  ArcMaker arcs_;
  bool has_moments_;
  std::vector<PieceArc> sorted_;
  std::vector<BorderArc> border_;
  std::vector<MeasuredPiece> pieces_;
};

struct RowBlock {
  std::vector<Index> counts;  // of each cell
  std::vector<Index> columns;
  std::vector<double> areas;
  std::vector<Point> moments;
};

}  // namespace

PieceRows pieces(const Subdivision& cells, const Subdivision& cover, bool has_moments,
                 const Execution& execution) {
  const Crossings crossings(cells, cover, execution);
  const std::size_t n = cells.num_cells();
  std::vector<RowBlock> blocks(system::num_pieces(n, cells_per_block));
  PieceRows result;
  result.offsets.assign(n + 1, 0);
  system::StageProgress progress(execution.progress, "cut", blocks.size());
  system::parallel_for(execution.threads, n, cells_per_block,
                       [&](std::size_t begin, std::size_t end) {
                         RowBlock& block = blocks[begin / cells_per_block];
                         PieceMaker make(cells, cover, crossings, has_moments);
                         for (std::size_t c = begin; c < end; ++c) {
                           const auto cell = static_cast<Index>(c);
                           std::span<const MeasuredPiece> row;
                           if (cells.shapes[c] != Shape::empty) row = make(cell);
                           for (const MeasuredPiece& piece : row) {
                             block.columns.push_back(cover.names[piece.beyond]);
                             block.areas.push_back(piece.area);
                             if (has_moments) block.moments.push_back(piece.moment);
                           }
                           block.counts.push_back(static_cast<Index>(row.size()));
                           result.offsets[cells.names[c] + std::size_t{1}] = row.size();
                         }
                         progress.step();
                       });
  for (std::size_t i = 0; i < n; ++i) result.offsets[i + 1] += result.offsets[i];
  result.columns.resize(result.offsets[n]);
  result.areas.resize(result.offsets[n]);
  if (has_moments) result.moments.resize(result.offsets[n]);
  system::parallel_for(
      execution.threads, n, cells_per_block, [&](std::size_t begin, std::size_t end) {
        RowBlock block = std::move(blocks[begin / cells_per_block]);
        std::size_t from = 0;
        for (std::size_t c = begin; c < end; ++c) {
          const std::size_t to = result.offsets[cells.names[c]];
          const std::size_t size = block.counts[c - begin];
          std::copy_n(block.columns.begin() + static_cast<std::ptrdiff_t>(from), size,
                      result.columns.begin() + static_cast<std::ptrdiff_t>(to));
          std::copy_n(block.areas.begin() + static_cast<std::ptrdiff_t>(from), size,
                      result.areas.begin() + static_cast<std::ptrdiff_t>(to));
          if (has_moments) {
            std::copy_n(block.moments.begin() + static_cast<std::ptrdiff_t>(from), size,
                        result.moments.begin() + static_cast<std::ptrdiff_t>(to));
          }
          from += size;
        }
      });
  return result;
}

PieceRows transposed(const PieceRows& pieces, std::size_t num_columns) {
  PieceRows result;
  result.offsets.assign(num_columns + 1, 0);
  for (const Index column : pieces.columns) ++result.offsets[column + std::size_t{1}];
  for (std::size_t i = 0; i < num_columns; ++i) result.offsets[i + 1] += result.offsets[i];
  result.columns.resize(pieces.columns.size());
  result.areas.resize(pieces.areas.size());
  result.moments.resize(pieces.moments.size());
  std::vector<std::uint64_t> next(result.offsets.begin(), result.offsets.end() - 1);
  for (std::size_t row = 0; row + 1 < pieces.offsets.size(); ++row) {
    for (std::uint64_t k = pieces.offsets[row]; k < pieces.offsets[row + 1]; ++k) {
      const std::uint64_t to = next[pieces.columns[k]]++;
      result.columns[to] = static_cast<Index>(row);
      result.areas[to] = pieces.areas[k];
      if (!pieces.moments.empty()) result.moments[to] = pieces.moments[k];
    }
  }
  return result;
}

}  // namespace rondel::overlay
