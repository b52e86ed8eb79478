// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "inputs/kinds.h"

#include <algorithm>

namespace rondel::inputs {

const Kind* find_kind(std::string_view name) {
  for (const auto& kinds : {plain_kinds(), hostile_kinds()}) {
    const auto at = std::ranges::find(kinds, name, &Kind::name);
    if (at != kinds.end()) return &*at;
  }
  return nullptr;
}

Input make(const Kind& kind, Recipe recipe) {
  if (recipe.angle_deg == 0) recipe.angle_deg = kind.angle_deg;
  return kind.from_recipe(recipe);
}

}  // namespace rondel::inputs
