// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the attributes of depths and heights say.
//
// in    units, `positive` and standard_name of a variable
// out   kilometers, and the direction in which its numbers are positive
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "rondel/mesh_size_files.h"

namespace rondel::formats {

// Returns the kilometers in a unit of length, meters or kilometers in letters of either case; nothing
// for other units.
std::optional<double> kilometers_of_units(std::string_view units);

// Returns a standard_name as CF spells it: "depth below geoid" is depth_below_geoid.
std::string standard_name_of(std::string_view text);

// The direction in which heights or depths are positive, and the attribute that says so.
struct VerticalSense {
  mesh::Positive positive;
  std::string evidence;
};

// Returns what `positive` says, or else the standard_name; nothing if neither one does.
std::optional<VerticalSense> vertical_sense_of(const std::string& positive,
                                               const std::string& standard_name);

}  // namespace rondel::formats
