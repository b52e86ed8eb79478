// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "rondel/types.h"

namespace rondel::map {

// A side of a loop in the plane, with the region to the left.
struct DirectedLine {
  LonLat from;
  LonLat to;
  friend bool operator==(const DirectedLine&, const DirectedLine&) = default;
};

}  // namespace rondel::map
