// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The conflict test as the kernel asks it: of sites that one thread has for itself, because the
// sites may remember what a rung needed.
#pragma once

#include <array>

#include "models/sphere_traits.h"

namespace rondel::kernel {

template <models::SphereTraits T>
class ConflictTest {
 public:
  explicit ConflictTest(T& sites) : sites_(sites) {}

  [[nodiscard]] const T& sites() const { return sites_; }

  // Whether p is in conflict with a face of the hull, ties being broken.
  [[nodiscard, gnu::always_inline]] bool is_in_conflict(const std::array<Index, 3>& face, Index p) {
    return answer(predicates::conflict(sites_, face[0], face[1], face[2], p));
  }
  // Whether p is in conflict with each of two faces.
  [[nodiscard, gnu::always_inline]] std::array<bool, 2> are_in_conflict(
      const std::array<Index, 3>& f, const std::array<Index, 3>& g, Index p) {
    const auto [of_f, of_g] = predicates::conflicts(sites_, f, g, p);
    return {answer(of_f), answer(of_g)};
  }

  // Which rungs have decided.
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  [[gnu::always_inline]] bool answer(const predicates::Decision& decision) {
    count(tally_, decision.rung);
    return decision.sign == Sign::positive;
  }

  T& sites_;
  Tally tally_;
};

}  // namespace rondel::kernel
