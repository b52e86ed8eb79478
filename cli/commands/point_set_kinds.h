// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The sets of rondel/point_sets.h as kinds of `rondel generate`.
///
/// in    a number of sites, or a least distance in degrees
/// out   points of the unit sphere
#pragma once

#include <span>
#include <string_view>

#include "inputs/kinds.h"

namespace rondel::cli {

/// Returns the kinds, in the order in which the help shows them.
std::span<const inputs::Kind> point_set_kinds();
/// Returns the kind of this name, among these and those of rondel/inputs; null if there is none.
const inputs::Kind* find_kind(std::string_view name);

}  // namespace rondel::cli
