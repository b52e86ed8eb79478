// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where a model, which a user names at run time, becomes a type.
#pragma once

#include "models/projected_points.h"
#include "models/weighted_points.h"
#include "rondel/types.h"

namespace rondel::models {

// Returns work<T>(), where T is the class of the sites of this model.
template <class Work>
auto with_model(Model model, Work&& work) {
  return model == Model::projected ? work.template operator()<ProjectedPoints>()
                                   : work.template operator()<WeightedPoints>();
}

}  // namespace rondel::models
