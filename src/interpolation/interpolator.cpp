// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include "api/triangulation_impl.h"
#include "api/validation.h"
#include "interpolation/collected_rows.h"
#include "interpolation/ground.h"
#include "interpolation/linear.h"
#include "interpolation/place_values.h"
#include "interpolation/rows.h"
#include "rondel/error.h"
#include "rondel/interpolate.h"
#include "system/job.h"
#include "system/prefetch.h"

namespace rondel {
namespace {

using namespace interpolation;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Writes the sums of rows into values of the shape (num_fields, num_targets).
class ValuesTaker {
 public:
  ValuesTaker(const PlaceValues& fields, std::span<double> values)
      : fields_(fields),
        values_(values.data()),
        num_targets_(values.size() / fields.num_fields()) {}

  void expect(Index target) const { system::prefetch_to_write(&values_[target]); }
  void take(Index target, const exact::SplitPoint& /*u*/, const Row& row) const {
    if (row.empty()) return;
    for (std::size_t f = 0; f < fields_.num_fields(); ++f) {
      double sum = 0;
      for (const auto& [vertex, weight] : row) sum += weight * fields_(f, vertex);
      values_[f * num_targets_ + target] = sum;
    }
  }
  void finish() const {}

 private:
  const PlaceValues& fields_;
  double* values_;
  std::size_t num_targets_;
};

// Writes tangent vectors of the shape (num_fields, num_targets); the fields are their coordinates.
class VectorsTaker {
 public:
  VectorsTaker(const PlaceValues& fields, std::span<Point> vectors)
      : fields_(fields),
        vectors_(vectors.data()),
        num_targets_(3 * vectors.size() / fields.num_fields()) {}

  void expect(Index target) const { system::prefetch_to_write(&vectors_[target]); }
  void take(Index target, const exact::SplitPoint& u, const Row& row) const {
    if (row.empty()) return;
    for (std::size_t f = 0; f < fields_.num_fields(); f += 3) {
      Vec sum{0, 0, 0};
      for (const auto& [vertex, weight] : row) {
        sum =
            sum + weight * Vec{fields_(f, vertex), fields_(f + 1, vertex), fields_(f + 2, vertex)};
      }
      const Vec up = exact::to_vector(u.hi);
      vectors_[f / 3 * num_targets_ + target] = exact::to_point(sum - dot(sum, up) * up);
    }
  }
  void finish() const {}

 private:
  const PlaceValues& fields_;
  Point* vectors_;
  std::size_t num_targets_;
};

class WeightsTaker {
 public:
  explicit WeightsTaker(CollectedRows& rows) : rows_(rows) {}

  void expect(Index /*target*/) const {}
  void take(Index target, const exact::SplitPoint& /*u*/, const Row& row) {
    rows_.append(row, list_);
    list_.targets.push_back(target);
    list_.ends.push_back(list_.columns.size());
  }
  void finish() { rows_.add(std::move(list_)); }

 private:
  CollectedRows& rows_;
  RowList list_;
};

}  // namespace

class Interpolator::Impl {
 public:
  explicit Impl(const Triangulation& triangulation) : ground_(triangulation) {}

  [[nodiscard]] const Ground& ground() const { return ground_; }

  void validate(std::span<const Point> targets, const InterpolationOptions& options) const;
  // The number of fields of so many values.
  [[nodiscard]] std::size_t num_fields(std::string_view name, std::size_t size) const;

  template <class MakeTaker>
  void for_each_row(std::span<const Point> targets, const InterpolationOptions& options,
                    const Execution& execution, const MakeTaker& make_taker) const;

  [[nodiscard]] std::uint64_t sites_hash() const {
    std::call_once(hash_once_, [this] {
      sites_hash_ = point_set_hash(ground_.triangulation().sites().points());
    });
    return sites_hash_;
  }

 private:
  Ground ground_;
  mutable std::once_flag hash_once_;
  mutable std::uint64_t sites_hash_ = 0;
};

void Interpolator::Impl::validate(std::span<const Point> targets,
                                  const InterpolationOptions& options) const {
  const Triangulation& triangulation = ground_.triangulation();
  if (targets.size() >= no_index) {
    throw InvalidInput(std::to_string(targets.size()) + " targets are too many for one call",
                       no_index);
  }
  api::validate_queries(targets, ground_.center(), true, "target");
  if (options.method > Method::cubic) throw InvalidInput("there is no such method", 0);
  if (ground_.model() == Model::weighted && options.method != Method::nearest) {
    throw InvalidInput("weighted sites have no method but nearest", 0);
  }
  if (options.shared_place == SharedPlace::error && !triangulation.duplicates().empty()) {
    const auto& [site, representative] = triangulation.duplicates().front();
    throw InvalidInput("site " + std::to_string(site) + " is in the place of site " +
                           std::to_string(representative),
                       site);
  }
}

std::size_t Interpolator::Impl::num_fields(std::string_view name, std::size_t size) const {
  const std::size_t num_sites = ground_.num_sites();
  if (num_sites == 0 && size == 0) return 1;
  if (num_sites == 0 || size == 0 || size % num_sites != 0) {
    throw InvalidInput(std::string(name) + " has " + std::to_string(size) +
                           " values, which are no fields of " + std::to_string(num_sites) +
                           " sites",
                       size);
  }
  return size / num_sites;
}

template <class MakeTaker>
void Interpolator::Impl::for_each_row(std::span<const Point> targets,
                                      const InterpolationOptions& options,
                                      const Execution& execution,
                                      const MakeTaker& make_taker) const {
  FirstOutside outside;
  const auto visit = [&](const auto& make_kernel) {
    interpolation::for_each_row(
        ground_, targets, execution,
        [&] { return KernelRows(ground_, options, outside, make_kernel()); }, make_taker);
  };
  if (ground_.num_vertices() == 0) {
    if (options.outside == Outside::error && !targets.empty()) outside.add(0);
  } else if (options.method == Method::nearest) {
    interpolation::for_each_row(
        ground_, targets, execution, [&] { return NearestRows(ground_); }, make_taker);
  } else if (options.method == Method::linear || ground_.triangulation().dimension() < 2) {
    visit([&] { return LinearKernel(ground_); });
  } else {
    throw InvalidInput("not there yet", 0);
  }
  if (outside.get() != no_index) {
    throw InvalidInput(
        "target " + std::to_string(outside.get()) + " is outside of the sites' faces",
        outside.get());
  }
}

Interpolator::Interpolator(const Triangulation& triangulation)
    : impl_([&] {
        const system::ArithmeticScope arithmetic;
        api::require_delaunay(triangulation, {});
        return std::make_unique<const Impl>(triangulation);
      }()) {}
Interpolator::~Interpolator() = default;
Interpolator::Interpolator(Interpolator&& other) noexcept = default;
Interpolator& Interpolator::operator=(Interpolator&& other) noexcept = default;

Weights Interpolator::weights(std::span<const Point> targets, const InterpolationOptions& options,
                              const Execution& execution) const {
  const system::Call call(execution);
  impl_->validate(targets, options);
  CollectedRows rows(impl_->ground(), options.shared_place);
  impl_->for_each_row(targets, options, execution, [&] { return WeightsTaker(rows); });
  Weights weights = rows.joined(targets.size(), execution.threads);
  if (options.hashes) {
    weights.sites_hash = impl_->sites_hash();
    weights.targets_hash = point_set_hash(targets);
  }
  return weights;
}

std::vector<double> Interpolator::values(std::span<const double> field,
                                         std::span<const Point> targets,
                                         const InterpolationOptions& options,
                                         const Execution& execution) const {
  const system::Call call(execution);
  impl_->validate(targets, options);
  std::vector<double> values(impl_->num_fields("field", field.size()) * targets.size(), nan);
  const PlaceValues fields(impl_->ground(), scalar_fields(field, impl_->ground().num_sites()),
                           options.shared_place, targets.size(), execution.threads);
  impl_->for_each_row(targets, options, execution, [&] { return ValuesTaker(fields, values); });
  return values;
}

std::vector<Point> Interpolator::vectors(std::span<const Point> field,
                                         std::span<const Point> targets,
                                         const InterpolationOptions& options,
                                         const Execution& execution) const {
  const system::Call call(execution);
  impl_->validate(targets, options);
  std::vector<Point> vectors(impl_->num_fields("field", field.size()) * targets.size(),
                             Point{nan, nan, nan});
  const PlaceValues fields(impl_->ground(), vector_fields(field, impl_->ground().num_sites()),
                           options.shared_place, targets.size(), execution.threads);
  InterpolationOptions homogeneous = options;
  homogeneous.normalization = Normalization::homogeneous;
  impl_->for_each_row(targets, homogeneous, execution,
                      [&] { return VectorsTaker(fields, vectors); });
  return vectors;
}

}  // namespace rondel
