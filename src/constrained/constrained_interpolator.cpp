// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// ConstrainedInterpolator: the vertices are prepared as for an Interpolator, and so are the rows of
// the linear kernel; what differs is who locates a target (face_finder.h).

#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>

#include "constrained/face_finder.h"
#include "interpolation/collected_rows.h"
#include "interpolation/linear.h"
#include "interpolation/prepared_triangulation.h"
#include "interpolation/rows.h"
#include "interpolation/sinks.h"
#include "interpolation/target_checks.h"
#include "interpolation/vertex_fields.h"
#include "rondel/constrained_interpolate.h"
#include "rondel/delaunay.h"
#include "system/job.h"

namespace rondel {
namespace {

using namespace interpolation;  // NOLINT(google-build-using-namespace): this file is its face

}  // namespace

class ConstrainedInterpolator::Impl {
 public:
  explicit Impl(const ConstrainedTriangulation& result)
      : sides_(result.sides),
        prepared_(result.triangulation),
        faces_(prepared_.graph(), sides_, result.triangulation.sphere()) {}

  [[nodiscard]] const PreparedTriangulation& prepared() const { return prepared_; }

  template <class MakeSink>
  void for_each_row(std::span<const Point> targets, const InterpolationOptions& options,
                    const Execution& execution, const MakeSink& make_sink) const;

 private:
  // Answers what KernelRows asks. The nearest vertex is that of Delaunay faces: along the edges of
  // others a search may end at a vertex that is not the nearest one. Both triangulations have the
  // same vertices, and so the same ranks.
  struct Finder {
    const constrained::ConstrainedFaceFinder& faces;
    const PreparedTriangulation* delaunay;

    [[nodiscard]] Location locate(const Point& p, query::Cursor& cursor) const {
      return faces.locate(p, cursor);
    }
    [[nodiscard]] Index nearest(const Point& p, query::Cursor& cursor) const {
      return delaunay->engine().nearest(p, cursor);
    }
  };

  // Returns the Delaunay triangulation of the sites, which the first call computes.
  [[nodiscard]] const PreparedTriangulation& delaunay_of_sites(const Execution& execution) const {
    std::call_once(delaunay_once_, [&] {
      const Triangulation& t = prepared_.triangulation();
      delaunay_.emplace(rondel::delaunay(t.sites(), {Model::projected, t.sphere()},
                                         {.threads = execution.threads, .stop = execution.stop}));
    });
    return *delaunay_;
  }

  std::vector<std::uint8_t> sides_;
  PreparedTriangulation prepared_;
  constrained::ConstrainedFaceFinder faces_;
  mutable std::once_flag delaunay_once_;
  mutable std::optional<PreparedTriangulation> delaunay_;
};

template <class MakeSink>
void ConstrainedInterpolator::Impl::for_each_row(std::span<const Point> targets,
                                                 const InterpolationOptions& options,
                                                 const Execution& execution,
                                                 const MakeSink& make_sink) const {
  FirstOutside outside;
  if (prepared_.num_vertices() == 0) {
    if (options.outside == Outside::error && !targets.empty()) outside.add(0);
  } else {
    const bool has_nearest = options.outside == Outside::nearest;
    const Finder finder{faces_, has_nearest ? &delaunay_of_sites(execution) : nullptr};
    interpolation::for_each_row(
        prepared_, targets, execution,
        [&] { return KernelRows(prepared_, finder, options, outside, LinearKernel(prepared_)); },
        make_sink);
  }
  refuse_outside(outside.get());
}

namespace {

// Returns the options of the rows.
InterpolationOptions options_of_rows(const LinearOptions& options) {
  return {.method = Method::linear,
          .outside = options.outside,
          .shared_place = options.shared_place,
          .normalization = options.normalization,
          .hashes = options.hashes};
}

}  // namespace

ConstrainedInterpolator::ConstrainedInterpolator(const ConstrainedTriangulation& result) {
  const system::ArithmeticScope arithmetic;
  constrained::require_sides(result.sides.size(), result.triangulation.num_faces());
  impl_ = std::make_unique<const Impl>(result);
}

ConstrainedInterpolator::~ConstrainedInterpolator() = default;
ConstrainedInterpolator::ConstrainedInterpolator(ConstrainedInterpolator&&) noexcept = default;
ConstrainedInterpolator& ConstrainedInterpolator::operator=(ConstrainedInterpolator&&) noexcept =
    default;

Weights ConstrainedInterpolator::weights(std::span<const Point> targets,
                                         const LinearOptions& options,
                                         const Execution& execution) const {
  const system::Call call(execution);
  const InterpolationOptions all = options_of_rows(options);
  const PreparedTriangulation& prepared = impl_->prepared();
  require_targets(prepared, targets, all);
  CollectedRows rows(prepared, all.shared_place);
  impl_->for_each_row(targets, all, execution,
                      [&] { return WeightsSink(rows, nullptr, all.normalization); });
  Weights weights = rows.joined(targets.size(), execution.threads);
  if (all.hashes) {
    weights.sites_hash = point_set_hash(prepared.triangulation().sites().points());
    weights.targets_hash = point_set_hash(targets);
  }
  return weights;
}

std::vector<double> ConstrainedInterpolator::values(std::span<const double> field,
                                                    std::span<const Point> targets,
                                                    const LinearOptions& options,
                                                    const Execution& execution) const {
  const system::Call call(execution);
  const InterpolationOptions all = options_of_rows(options);
  const PreparedTriangulation& prepared = impl_->prepared();
  require_targets(prepared, targets, all);
  std::vector<double> values(num_fields_of(prepared, "field", field.size()) * targets.size(),
                             std::numeric_limits<double>::quiet_NaN());
  const VertexFields fields(prepared, scalar_fields(field, prepared.num_sites()), all.shared_place,
                            targets.size(), execution.threads);
  impl_->for_each_row(targets, all, execution, [&] {
    return ValuesSink({fields, nullptr}, values);
  });
  return values;
}

}  // namespace rondel
