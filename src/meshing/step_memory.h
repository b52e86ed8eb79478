// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The last steps of a minimizer and how they changed the gradient: L-BFGS's approximation of the
// inverse Hessian, in the two loops of Nocedal and Wright, algorithm 7.4.
//
// in    steps with the gradients before and after them; a vector
// out   the product of the approximation with the vector
// index sites, each with a tangent vector; pairs by age, the latest first
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "meshing/scvt_energy.h"
#include "meshing/tangent.h"

namespace rondel::mesh {

class StepMemory {
 public:
  static constexpr std::size_t max_pairs = 7;

  explicit StepMemory(unsigned threads) : threads_(threads) {}

  [[nodiscard]] std::size_t size() const { return num_pairs_; }
  void forget() { num_pairs_ = 0; }

  // Keeps the step length * direction if the slope along it has grown, in place of the oldest step
  // if there are max_pairs; otherwise changes nothing.
  void remember(double length, std::span<const TangentVector> direction,
                std::span<const SiteSums> before, std::span<const SiteSums> after);

  // Multiply `vector` by the approximation: between the two calls the caller multiplies it by the
  // first approximation of the inverse Hessian.
  void begin_product(std::span<TangentVector> vector);
  void end_product(std::span<TangentVector> vector) const;

 private:
  struct Pair {
    std::vector<TangentVector> step;
    std::vector<TangentVector> change;  // change of the gradient
    double curvature = 0;               // step . change
  };
  // Returns the pair of an age; the latest one has the age 0.
  [[nodiscard]] const Pair& pair(std::size_t age) const {
    return pairs_[(newest_ + max_pairs - age) % max_pairs];
  }

  unsigned threads_;
  std::array<Pair, max_pairs> pairs_;
  std::array<double, max_pairs> alpha_{};
  std::size_t num_pairs_ = 0;
  std::size_t newest_ = 0;
};

}  // namespace rondel::mesh
