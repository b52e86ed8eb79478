// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Ends a run of a filter where src/exact/exact_sign.h would find the sign exactly.
#pragma once

#define sign_of_cubic sign_of_cubic_in_balls
#define sign_of_sextic sign_of_sextic_in_balls
#include_next "exact/exact_sign.h"
#undef sign_of_cubic
#undef sign_of_sextic

namespace rondel::exact {

template <class Formula>
Sign sign_of_cubic(const Formula& /*formula*/) {
  throw proofs::NextRung();
}
template <class Formula>
Sign sign_of_sextic(const Formula& /*formula*/) {
  throw proofs::NextRung();
}

}  // namespace rondel::exact
