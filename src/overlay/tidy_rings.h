// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rings as they are given, without what has no inside.
#pragma once

#include <optional>

#include "overlay/subdivision.h"
#include "rondel/cell_rings.h"

namespace rondel::overlay {

// The cells, of which those of Shape::other in `known`, which are these cells, have lost sides that run to and fro, as of
// spikes and keyholes, and rings that are no wider than rounding of their corners. All others are as they were. Nothing is
// returned if none has any.
std::optional<CellRings> tidied(const CellRings& cells, const Subdivision& known);

}  // namespace rondel::overlay
