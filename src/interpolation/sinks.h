// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sinks for rows (rows.h): they compute values, tangent vectors, or collect weights.
//
// in    rows, each with the number of its target; values of fields by vertex
// out   values or vectors by field and target, or lists of weights
// index targets; spatial ranks of vertices in rows
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "exact/vector.h"
#include "interpolation/collected_rows.h"
#include "interpolation/row.h"
#include "interpolation/settled_mean.h"
#include "interpolation/sum_of_present.h"
#include "interpolation/vertex_fields.h"
#include "interpolation/vertex_gradients.h"
#include "system/prefetch.h"

namespace rondel::interpolation {

// Sums up a row times the values of a field, in the order of the row.
class FieldSums {
 public:
  // `gradients` may be null for rows without slopes.
  FieldSums(const VertexFields& values, const VertexGradients* gradients)
      : values_(values), gradients_(gradients) {}

  [[nodiscard]] std::size_t num_fields() const { return values_.num_fields(); }
  [[nodiscard]] double operator()(std::size_t f, const Row& row) const {
    double sum = 0;
    double largest = 0;
    double main = 0;
    for (const auto& [vertex, weight] : row) {
      const double value = values_(f, vertex);
      sum += weight * value;
      main = weight > largest ? value : main;
      largest = std::max(largest, weight);
    }
    const bool is_finite = std::isfinite(sum);
    if (is_finite && !may_be_settled(sum, main)) return sum;
    const auto visit_entries = [&](const auto& visit) {
      for (const auto& [vertex, weight] : row) visit(weight, values_(f, vertex));
    };
    return is_finite ? settled_mean(sum, visit_entries) : sum_of_present(visit_entries, {});
  }
  // The gradient at a vertex with slope 0 is not read, so that it may be anything.
  [[nodiscard]] double operator()(std::size_t f, const GradientRow& row) const {
    double sum = 0;
    bool is_mean = true;
    for (const auto& [vertex, weight, slope] : row) {
      sum += weight * values_(f, vertex);
      if (slope == Point{}) continue;
      const double step = dot(slope, (*gradients_)(f, vertex));
      sum += step;
      is_mean &= step == 0;
    }
    if (!std::isfinite(sum)) sum = small_sum(f, row) / scale_of_large;
    if (!is_mean) return sum;
    return settled_mean(sum, [&](const auto& visit) {
      for (const auto& [vertex, weight, slope] : row) visit(weight, values_(f, vertex));
    });
  }

 private:
  // Returns the sum of values that are multiplied by scale_of_large first.
  [[nodiscard]] double small_sum(std::size_t f, const GradientRow& row) const {
    double sum = 0;
    for (const auto& [vertex, weight, slope] : row) {
      sum += weight * (scale_of_large * values_(f, vertex));
      if (slope != Point{}) sum += dot(slope, scale_of_large * (*gradients_)(f, vertex));
    }
    return sum;
  }

  const VertexFields& values_;
  const VertexGradients* gradients_;
};

// Writes values of the shape (num_fields, num_targets). The values of targets with empty rows are
// not changed.
class ValuesSink {
 public:
  ValuesSink(const FieldSums& sums, std::span<double> values)
      : sums_(sums), values_(values.data()), num_targets_(values.size() / sums.num_fields()) {}

  void expect(Index target) const { system::prefetch_to_write(&values_[target]); }
  template <class AnyRow>
  void take(Index target, const exact::SplitPoint& /*u*/, const AnyRow& row) const {
    if (row.empty()) return;
    for (std::size_t f = 0; f < sums_.num_fields(); ++f) {
      values_[f * num_targets_ + target] = sums_(f, row);
    }
  }
  void finish() const {}

 private:
  FieldSums sums_;
  double* values_;
  std::size_t num_targets_;
};

// Writes tangent vectors of the shape (num_fields / 3, num_targets); every three fields are the
// coordinates x, y, z of one field of vectors.
class VectorsSink {
 public:
  VectorsSink(const FieldSums& sums, std::span<Point> vectors)
      : sums_(sums),
        vectors_(vectors.data()),
        num_targets_(vectors.size() / (sums.num_fields() / 3)) {}

  void expect(Index target) const { system::prefetch_to_write(&vectors_[target]); }
  template <class AnyRow>
  void take(Index target, const exact::SplitPoint& u, const AnyRow& row) const {
    if (row.empty()) return;
    for (std::size_t f = 0; f < sums_.num_fields(); f += 3) {
      const Point sum{sums_(f, row), sums_(f + 1, row), sums_(f + 2, row)};
      vectors_[f / 3 * num_targets_ + target] = sum - dot(sum, u.hi) * u.hi;
    }
  }
  void finish() const {}

 private:
  FieldSums sums_;
  Point* vectors_;
  std::size_t num_targets_;
};

// Collects the rows as weights of values.
class WeightsSink {
 public:
  // `gradients` are needed for rows with slopes.
  WeightsSink(CollectedRows& rows, const GradientRows* gradients, Normalization normalization)
      : rows_(rows), join_(gradients, normalization) {}

  void expect(Index /*target*/) const {}
  void take(Index target, const exact::SplitPoint& /*u*/, const Row& row) {
    rows_.append(target, row, list_);
  }
  void take(Index target, const exact::SplitPoint& u, const GradientRow& row) {
    take(target, u, join_(row));
  }
  void finish() { rows_.add(std::move(list_)); }

 private:
  CollectedRows& rows_;
  GradientJoiner join_;
  RowList list_;
};

}  // namespace rondel::interpolation
