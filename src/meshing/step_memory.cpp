// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/step_memory.h"

#include <algorithm>

#include "system/parallel.h"

namespace rondel::mesh {
namespace {

double product_in_order(unsigned threads, std::span<const TangentVector> a,
                        std::span<const TangentVector> b) {
  return sum_in_order(threads, a.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += dot(a[i], b[i]);
    return sum;
  });
}

void add_multiple(unsigned threads, double factor, std::span<const TangentVector> a,
                  std::span<TangentVector> to) {
  system::parallel_for(threads, a.size(), terms_at_a_time, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      to[i].u += factor * a[i].u;
      to[i].v += factor * a[i].v;
    }
  });
}

}  // namespace

void StepMemory::remember(double length, std::span<const TangentVector> direction,
                          std::span<const SiteSums> before, std::span<const SiteSums> after) {
  const std::size_t n = direction.size();
  const auto step = [&](std::size_t i) {
    return TangentVector{length * direction[i].u, length * direction[i].v};
  };
  const auto change = [&](std::size_t i) {
    return TangentVector{after[i].gradient.u - before[i].gradient.u,
                         after[i].gradient.v - before[i].gradient.v};
  };
  // The curvature is computed before anything is overwritten.
  const double curvature = sum_in_order(threads_, n, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += dot(step(i), change(i));
    return sum;
  });
  if (!(curvature > 0)) return;
  newest_ = (newest_ + 1) % max_pairs;
  num_pairs_ = std::min(num_pairs_ + 1, max_pairs);
  Pair& pair = pairs_[newest_];
  pair.curvature = curvature;
  pair.step.resize(n);
  pair.change.resize(n);
  system::parallel_for(threads_, n, terms_at_a_time, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      pair.step[i] = step(i);
      pair.change[i] = change(i);
    }
  });
}

void StepMemory::begin_product(std::span<TangentVector> vector) {
  for (std::size_t age = 0; age < num_pairs_; ++age) {
    const Pair& p = pair(age);
    alpha_[age] = product_in_order(threads_, p.step, vector) / p.curvature;
    add_multiple(threads_, -alpha_[age], p.change, vector);
  }
}

void StepMemory::end_product(std::span<TangentVector> vector) const {
  for (std::size_t age = num_pairs_; age-- > 0;) {
    const Pair& p = pair(age);
    const double beta = product_in_order(threads_, p.change, vector) / p.curvature;
    add_multiple(threads_, alpha_[age] - beta, p.step, vector);
  }
}

}  // namespace rondel::mesh
