// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "api/triangulation_impl.h"
#include "interpolation/collected_rows.h"
#include "interpolation/cubic.h"
#include "interpolation/gradient.h"
#include "interpolation/hermite.h"
#include "interpolation/linear.h"
#include "interpolation/natural.h"
#include "interpolation/prepared_triangulation.h"
#include "interpolation/rows.h"
#include "interpolation/sinks.h"
#include "interpolation/target_checks.h"
#include "interpolation/vertex_fields.h"
#include "interpolation/vertex_gradients.h"
#include "rondel/error.h"
#include "rondel/interpolate.h"
#include "system/job.h"
#include "system/mutex.h"

namespace rondel {
namespace {

using namespace interpolation;  // NOLINT(google-build-using-namespace): this file is its face

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Given fields, in the form in which rows need them.
struct Fields {
  VertexFields values;
  std::optional<VertexGradients> gradients{};
  std::vector<std::uint8_t> has_gradient{};  // by vertex; empty if all have one

  [[nodiscard]] FieldSums sums() const { return {values, gradients ? &*gradients : nullptr}; }
};

}  // namespace

class Interpolator::Impl {
 public:
  explicit Impl(const Triangulation& triangulation) : prepared_(triangulation) {}

  [[nodiscard]] const PreparedTriangulation& prepared() const { return prepared_; }
  [[nodiscard]] bool needs_gradients(Method method) const {
    return (method == Method::hermite || method == Method::cubic) &&
           prepared_.triangulation().dimension() == 2;
  }

  static void require_normalization(const InterpolationOptions& options);

  [[nodiscard]] std::shared_ptr<const GradientRows> gradient_rows(const GradientOptions& options,
                                                                  unsigned threads) const;
  // Returns null if they have not been computed.
  [[nodiscard]] std::shared_ptr<const GradientRows> known_rows(
      const GradientOptions& options) const;
  // Returns the fields with estimated gradients, if the method needs gradients.
  [[nodiscard]] Fields fields(FieldLayout layout, std::size_t num_targets,
                              const InterpolationOptions& options,
                              const Execution& execution) const;

  // `has_gradient` says which vertices have one; it is empty if all have.
  template <class MakeSink>
  void for_each_row(std::span<const Point> targets, const InterpolationOptions& options,
                    const Execution& execution, std::span<const std::uint8_t> has_gradient,
                    const MakeSink& make_sink) const;

  [[nodiscard]] std::uint64_t sites_hash() const {
    std::call_once(hash_once_, [this] {
      sites_hash_ = point_set_hash(prepared_.triangulation().sites().points());
    });
    return sites_hash_;
  }

 private:
  PreparedTriangulation prepared_;
  mutable std::once_flag hash_once_;
  mutable std::uint64_t sites_hash_ = 0;
  // The last gradient rows that were computed, and their options.
  mutable system::Mutex gradients_mutex_;
  mutable GradientOptions gradients_options_;
  mutable std::shared_ptr<const GradientRows> gradients_;
};

void Interpolator::Impl::require_normalization(const InterpolationOptions& options) {
  const bool has_gradients = options.method == Method::hermite || options.method == Method::cubic;
  if (!has_gradients || options.normalization == Normalization::unity) return;
  throw InvalidInput(std::string(options.method == Method::cubic ? "cubic" : "hermite") +
                         " has no homogeneous normalization: linear, laplace and sibson have",
                     0);
}

std::shared_ptr<const GradientRows> Interpolator::Impl::gradient_rows(
    const GradientOptions& options, unsigned threads) const {
  if (auto known = known_rows(options)) return known;
  auto rows = std::make_shared<const GradientRows>(
      interpolation::gradient_rows(prepared_, options, threads));
  const std::lock_guard lock(gradients_mutex_);
  gradients_ = rows;
  gradients_options_ = options;
  return rows;
}

std::shared_ptr<const GradientRows> Interpolator::Impl::known_rows(
    const GradientOptions& options) const {
  const std::lock_guard lock(gradients_mutex_);
  return gradients_options_ == options ? gradients_ : nullptr;
}

Fields Interpolator::Impl::fields(FieldLayout layout, std::size_t num_targets,
                                  const InterpolationOptions& options,
                                  const Execution& execution) const {
  const bool has_gradients = needs_gradients(options.method);
  Fields fields{{prepared_, std::move(layout), options.shared_place,
                 has_gradients ? prepared_.num_vertices() : num_targets, execution.threads}};
  if (!has_gradients) return fields;
  if (const auto rows = known_rows(options.gradient)) {
    fields.gradients.emplace(*rows, fields.values, execution.threads);
    fields.has_gradient = vertices_with(*rows);
  } else {
    fields.gradients.emplace(prepared_, options.gradient, fields.values, execution.threads,
                             fields.has_gradient);
  }
  return fields;
}

template <class MakeSink>
void Interpolator::Impl::for_each_row(std::span<const Point> targets,
                                      const InterpolationOptions& options,
                                      const Execution& execution,
                                      std::span<const std::uint8_t> has_gradient,
                                      const MakeSink& make_sink) const {
  FirstOutside outside;
  const auto visit = [&](const auto& make_kernel) {
    interpolation::for_each_row(
        prepared_, targets, execution,
        [&] { return KernelRows(prepared_, prepared_.engine(), options, outside, make_kernel()); },
        make_sink);
  };
  if (prepared_.num_vertices() == 0) {
    if (options.outside == Outside::error && !targets.empty()) outside.add(0);
  } else if (options.method == Method::nearest) {
    interpolation::for_each_row(
        prepared_, targets, execution, [&] { return NearestRows(prepared_); }, make_sink);
  } else if (options.method == Method::linear || prepared_.triangulation().dimension() < 2) {
    visit([&] { return LinearKernel(prepared_); });
  } else if (options.method == Method::laplace) {
    visit([&] { return LaplaceKernel(prepared_); });
  } else if (options.method == Method::sibson) {
    visit([&] { return SibsonKernel(prepared_); });
  } else if (options.method == Method::hermite) {
    visit([&] { return HermiteKernel(prepared_, has_gradient, options.normalization); });
  } else {
    visit([&] { return CubicKernel(prepared_, has_gradient, options.normalization); });
  }
  refuse_outside(outside.get());
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
  require_targets(impl_->prepared(), targets, options);
  Impl::require_normalization(options);
  CollectedRows rows(impl_->prepared(), options.shared_place);
  std::shared_ptr<const GradientRows> gradients;
  std::vector<std::uint8_t> has_gradient;
  if (impl_->needs_gradients(options.method)) {
    gradients = impl_->gradient_rows(options.gradient, execution.threads);
    has_gradient = vertices_with(*gradients);
  }
  impl_->for_each_row(targets, options, execution, has_gradient,
                      [&] { return WeightsSink(rows, gradients.get(), options.normalization); });
  Weights weights = rows.joined(targets.size(), execution.threads);
  if (options.hashes) {
    weights.sites_hash = impl_->sites_hash();
    weights.targets_hash = point_set_hash(targets);
  }
  return weights;
}

namespace {

// A gradient of values of this size may be beyond the largest number.
constexpr double huge_value = 0x1p960;

// Gradients, and their sums, may exceed the largest number where values do not. What is missing for
// that is computed of smaller values.
void complete_overflown(const Interpolator& interpolator, std::span<const double> field,
                        std::span<const Point> targets, const InterpolationOptions& options,
                        const Execution& execution, std::vector<double>& values) {
  constexpr double scale = 0x1p-200;
  std::vector<double> small(field.begin(), field.end());
  for (double& value : small) value *= scale;
  const std::vector<double> found = interpolator.values(small, targets, options, execution);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) || std::isnan(found[i])) continue;
    values[i] = found[i] / scale;
    if (std::isfinite(values[i])) continue;
    throw InvalidInput("the value is beyond the largest number", i % targets.size());
  }
}

}  // namespace

std::vector<double> Interpolator::values(std::span<const double> field,
                                         std::span<const Point> targets,
                                         const InterpolationOptions& options,
                                         const Execution& execution) const {
  const system::Call call(execution);
  require_targets(impl_->prepared(), targets, options);
  Impl::require_normalization(options);
  std::vector<double> values(
      num_fields_of(impl_->prepared(), "field", field.size()) * targets.size(), nan);
  const Fields fields = impl_->fields(scalar_fields(field, impl_->prepared().num_sites()),
                                      targets.size(), options, execution);
  impl_->for_each_row(targets, options, execution, fields.has_gradient,
                      [&] { return ValuesSink(fields.sums(), values); });
  const auto is_huge = [](double value) { return std::abs(value) > huge_value; };
  if (impl_->needs_gradients(options.method) && std::ranges::any_of(field, is_huge)) {
    complete_overflown(*this, field, targets, options, execution, values);
  }
  return values;
}

std::vector<double> Interpolator::values(std::span<const double> field,
                                         std::span<const Point> gradients,
                                         std::span<const Point> targets,
                                         const InterpolationOptions& options,
                                         const Execution& execution) const {
  const system::Call call(execution);
  require_targets(impl_->prepared(), targets, options);
  Impl::require_normalization(options);
  if (options.method != Method::hermite && options.method != Method::cubic) {
    throw InvalidInput("only hermite and cubic take gradients");
  }
  const PreparedTriangulation& prepared = impl_->prepared();
  const std::size_t num_fields = num_fields_of(impl_->prepared(), "field", field.size());
  if (gradients.size() != field.size()) {
    throw InvalidInput("there are " + std::to_string(gradients.size()) + " gradients for " +
                           std::to_string(field.size()) + " values",
                       gradients.size());
  }
  std::vector<double> values(num_fields * targets.size(), nan);
  Fields fields{{prepared, scalar_fields(field, prepared.num_sites()), options.shared_place,
                 targets.size(), execution.threads}};
  if (impl_->needs_gradients(options.method)) {
    fields.gradients.emplace(prepared, gradients, options.shared_place, execution.threads);
  }
  impl_->for_each_row(targets, options, execution, {},
                      [&] { return ValuesSink(fields.sums(), values); });
  return values;
}

Weights Interpolator::gradient(const GradientOptions& options, const Execution& execution) const {
  const system::Call call(execution);
  const PreparedTriangulation& prepared = impl_->prepared();
  if (prepared.model() == Model::weighted) throw InvalidInput("weighted sites have no gradients");
  Weights weights;
  if (prepared.triangulation().dimension() == 2) {
    weights = gradient_weights(prepared, *impl_->gradient_rows(options, execution.threads),
                               execution.threads);
  } else {
    weights.offsets.assign(3 * prepared.num_sites() + 1, 0);
    weights.num_columns = prepared.num_sites();
  }
  weights.sites_hash = impl_->sites_hash();
  return weights;
}

std::vector<Point> Interpolator::vectors(std::span<const Point> field,
                                         std::span<const Point> targets,
                                         const InterpolationOptions& options,
                                         const Execution& execution) const {
  const system::Call call(execution);
  require_targets(impl_->prepared(), targets, options);
  std::vector<Point> vectors(
      num_fields_of(impl_->prepared(), "field", field.size()) * targets.size(),
      Point{nan, nan, nan});
  const Fields fields = impl_->fields(vector_fields(field, impl_->prepared().num_sites()),
                                      targets.size(), options, execution);
  InterpolationOptions homogeneous = options;
  homogeneous.normalization = Normalization::homogeneous;
  impl_->for_each_row(targets, homogeneous, execution, fields.has_gradient,
                      [&] { return VectorsSink(fields.sums(), vectors); });
  return vectors;
}

}  // namespace rondel
