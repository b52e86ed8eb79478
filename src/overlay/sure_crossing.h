// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Distinguishes crossings of sides from contacts that rounding has turned into crossings.
#pragma once

#include <span>

#include "overlay/measure.h"

namespace rondel::overlay {

// True if two of the arcs cross by more than rounding of their ends: they cross exactly, and no end
// is within rounding of the other arc.
bool has_sure_crossing(std::span<const BorderArc> arcs);

}  // namespace rondel::overlay
