// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/edge_springs.h"

#include <cmath>
#include <numbers>

#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::mesh {
namespace {

constexpr std::size_t springs_grain = 1024;  // sites
// The degree of the polynomial, and the lower end of its interval. Softer waves are left to the
// L-BFGS pairs.
constexpr int springs_degree = 6;
constexpr double softest_spring = 1.0 / (springs_degree * springs_degree);
constexpr double springs_middle = 0.5 * (1 + softest_spring);
constexpr double springs_half_width = 0.5 * (1 - softest_spring);

}  // namespace

// The wall between two cells is the chord of the two circumcenters; densities are masses over
// squared spacings. Each site stores the springs at it, so that a pass over the sites needs no
// locks.
void EdgeSprings::measure(const KineticDelaunay& surface, std::span<const Point> sites,
                          std::span<const SiteSums> sums) {
  const std::size_t n = sites.size();
  const auto faces = surface.faces();
  const auto centers = surface.centers();
  offsets_.assign(n + 1, 0);
  for (const Triple& face : faces) {
    for (const Index v : face) ++offsets_[v + 1];
  }
  system::sum_counts(offsets_);
  springs_.resize(offsets_.back());
  softness_.resize(n);
  const auto density = [&](std::size_t i) {
    return sums[i].mass / (sums[i].spacing * sums[i].spacing);
  };
  system::parallel_for(threads_, n, springs_grain, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> ring;
    for (std::size_t i = begin; i < end; ++i) {
      surface.faces_around(static_cast<Index>(i), ring);
      const Vector z = exact::to_vector(sites[i]);
      const double of_site = density(i);
      Spring* spring = &springs_[offsets_[i]];
      double stiffness = 0;
      Vector last = exact::to_vector(centers[ring.back()]);
      for (const Index f : ring) {
        const Vector next = exact::to_vector(centers[f]);
        const Index j = faces[f][next_of(surface.corner_of(f, static_cast<Index>(i)))];
        const Vector d = exact::to_vector(sites[j]) - z;
        const double square = dot(d, d);
        const Vector wall = next - last;
        const double product = std::sqrt(dot(wall, wall) * square);
        const double k = (0.5 / std::numbers::sqrt3) * (of_site + density(j)) * product;
        const Vector e = std::sqrt(k / square) * d;
        *spring++ = {j, static_cast<float>(e.x), static_cast<float>(e.y), static_cast<float>(e.z)};
        stiffness += k;
        last = next;
      }
      softness_[i] = 1 / (2 * stiffness);
    }
  });
}

void EdgeSprings::relax(double keep, double gain) {
  system::parallel_for(threads_, forces_.size(), springs_grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           const Vector at = displacements_[i];
                           Vector force = forces_[i];
                           for (auto k = offsets_[i]; k < offsets_[i + 1]; ++k) {
                             const Spring& spring = springs_[k];
                             const Vector e = {spring.x, spring.y, spring.z};
                             force = force - dot(e, at - displacements_[spring.neighbor]) * e;
                           }
                           steps_[i] = keep * steps_[i] + (gain * softness_[i]) * force;
                           next_[i] = at + steps_[i];
                         }
                       });
  displacements_.swap(next_);
}

// The first step is that of Jacobi; each further one follows the Chebyshev recurrence.
void EdgeSprings::yield(std::span<const Point> sites, std::span<const std::uint8_t> axes,
                        std::span<TangentVector> forces) {
  const std::size_t n = sites.size();
  for (auto* const vectors : {&forces_, &steps_, &displacements_, &next_}) vectors->resize(n);
  system::parallel_for(threads_, n, terms_at_a_time, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TangentFrame frame = frame_at(sites[i], axes[i]);
      forces_[i] = forces[i].u * frame.u + forces[i].v * frame.v;
      steps_[i] = displacements_[i] = (softness_[i] / springs_middle) * forces_[i];
    }
  });
  double ratio = springs_half_width / springs_middle;
  for (int k = 1; k < springs_degree; ++k) {
    const double next = 1 / (2 * springs_middle / springs_half_width - ratio);
    relax(next * ratio, 2 * next / springs_half_width);
    ratio = next;
  }
  system::parallel_for(threads_, n, terms_at_a_time, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TangentFrame frame = frame_at(sites[i], axes[i]);
      forces[i] = {dot(displacements_[i], frame.u), dot(displacements_[i], frame.v)};
    }
  });
}

}  // namespace rondel::mesh
