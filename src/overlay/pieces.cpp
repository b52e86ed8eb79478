// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/pieces.h"

#include <algorithm>
#include <span>

#include "overlay/arcs.h"
#include "overlay/crossings.h"
#include "overlay/gathered_rows.h"
#include "overlay/measure.h"

namespace rondel::overlay {
namespace {

struct MeasuredPiece {
  Index beyond;
  Point origin;
  double area = 0;
  double length = 0;  // of its boundary, roughly
  bool is_large = false;
  Point moment{};
};

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
    drop_rounding(pieces_);
    std::ranges::sort(pieces_, {}, [&](const MeasuredPiece& piece) { return column(piece); });
    return pieces_;
  }
  [[nodiscard]] Index column(const MeasuredPiece& piece) const {
    return cover_.names[piece.beyond];
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

}  // namespace

PieceRows pieces(const Subdivision& cells, const Subdivision& cover, bool has_moments,
                 const Execution& execution) {
  const Crossings crossings(cells, cover, execution);
  return gathered_rows(cells, has_moments, execution,
                       [&] { return PieceMaker(cells, cover, crossings, has_moments); });
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
