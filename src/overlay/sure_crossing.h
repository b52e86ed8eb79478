// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>

#include "overlay/measure.h"

namespace rondel::overlay {

// Whether sides cross each other by more than rounding of their ends: exactly, and no end is on the other side to rounding.
bool has_sure_crossing(std::span<const BorderArc> arcs);

}  // namespace rondel::overlay
