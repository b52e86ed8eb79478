// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The memory of L-BFGS against the matrix that it stands for, updated pair by pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "meshing/seeded_random.h"
#include "meshing/step_memory.h"

namespace rondel::mesh {
namespace {

constexpr std::size_t num_sites = 6;
constexpr std::size_t num_coordinates = 2 * num_sites;
using Numbers = std::vector<double>;
using Matrix = std::vector<Numbers>;

double product(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

Numbers times(const Matrix& matrix, const Numbers& x) {
  Numbers y;
  for (const Numbers& row : matrix) y.push_back(product(row, x));
  return y;
}

Matrix unit_matrix() {
  Matrix unit(num_coordinates, Numbers(num_coordinates, 0.0));
  for (std::size_t i = 0; i < num_coordinates; ++i) unit[i][i] = 1;
  return unit;
}

struct StepAndChange {
  Numbers step;
  Numbers change;
};

// H becomes (1 - s y^T / s.y) H (1 - y s^T / s.y) + s s^T / s.y.
void update(Matrix& h, const StepAndChange& pair) {
  const double curvature = product(pair.step, pair.change);
  Matrix left = unit_matrix();
  for (std::size_t i = 0; i < num_coordinates; ++i) {
    for (std::size_t j = 0; j < num_coordinates; ++j) {
      left[i][j] -= pair.step[i] * pair.change[j] / curvature;
    }
  }
  Matrix next(num_coordinates, Numbers(num_coordinates, 0.0));
  for (std::size_t i = 0; i < num_coordinates; ++i) {
    for (std::size_t j = 0; j < num_coordinates; ++j) {
      next[i][j] = product(left[i], times(h, left[j])) + pair.step[i] * pair.step[j] / curvature;
    }
  }
  h = next;
}

std::vector<TangentVector> as_vectors(const Numbers& numbers) {
  std::vector<TangentVector> vectors;
  for (std::size_t i = 0; i < num_sites; ++i)
    vectors.push_back({numbers[2 * i], numbers[2 * i + 1]});
  return vectors;
}
std::vector<SiteSums> as_sums(const Numbers& gradient) {
  std::vector<SiteSums> sums(num_sites);
  for (std::size_t i = 0; i < num_sites; ++i) {
    sums[i].gradient = {gradient[2 * i], gradient[2 * i + 1]};
  }
  return sums;
}

Numbers random_numbers(SeededRandom& random) {
  Numbers numbers;
  for (std::size_t i = 0; i < num_coordinates; ++i) numbers.push_back(random() - 0.5);
  return numbers;
}

// After each pair, also those that are refused because the gradient has fallen along the step.
TEST(scvt_memory, is_the_matrix_of_the_last_pairs_that_have_curvature) {
  SeededRandom random(1);
  StepMemory memory(1);
  std::vector<StepAndChange> kept;
  std::size_t num_refused = 0;
  for (int round = 0; round < 60; ++round) {
    const StepAndChange pair = {random_numbers(random), random_numbers(random)};
    const Numbers before = random_numbers(random);
    Numbers after = before;
    for (std::size_t i = 0; i < num_coordinates; ++i) after[i] += pair.change[i];
    Numbers direction = pair.step;
    for (double& x : direction) x *= 4;
    memory.remember(0.25, as_vectors(direction), as_sums(before), as_sums(after));
    if (product(pair.step, pair.change) > 0.02) {
      kept.push_back(pair);
    } else if (product(pair.step, pair.change) <= 0) {
      ++num_refused;
    } else {  // too little for the tolerance below
      memory.forget();
      kept.clear();
    }
    if (kept.size() > StepMemory::max_pairs) kept.erase(kept.begin());
    ASSERT_EQ(memory.size(), kept.size());
    Matrix h = unit_matrix();
    for (const StepAndChange& one : kept) update(h, one);
    const Numbers x = random_numbers(random);
    const Numbers expected = times(h, x);
    std::vector<TangentVector> found = as_vectors(x);
    memory.begin_product(found);
    memory.end_product(found);
    double largest = 1;
    for (const double y : expected) largest = std::max(largest, std::abs(y));
    for (std::size_t i = 0; i < num_sites; ++i) {
      ASSERT_NEAR(found[i].u, expected[2 * i], 1e-7 * largest) << round;
      ASSERT_NEAR(found[i].v, expected[2 * i + 1], 1e-7 * largest) << round;
    }
  }
  EXPECT_GT(num_refused, 10U);
}

}  // namespace
}  // namespace rondel::mesh
