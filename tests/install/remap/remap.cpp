// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A client of rondel::remap: a mean of two values, and an exception that crosses the library's border.

#include <rondel/error.h>
#include <rondel/weights.h>

#include <cstdio>
#include <vector>

int main() {
  rondel::Weights weights;
  weights.offsets = {0, 2};
  weights.columns = {0, 1};
  weights.values = {0.5, 0.5};
  weights.num_columns = 2;
  const std::vector<double> in = {1, 3};
  std::vector<double> out(1);
  rondel::apply(weights, in, out);
  const bool is_mean = out[0] == 2;
  bool has_thrown = false;
  try {
    rondel::apply(weights, in, {});
  } catch (const rondel::InvalidInput&) {
    has_thrown = true;
  }
  std::printf("%s, %s\n", is_mean ? "a value" : "no value", has_thrown ? "an error" : "no error");
}
