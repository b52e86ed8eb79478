// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The fields of a file that is regridded, and what all outputs of such files have.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "formats/regrid_side.h"
#include "rondel/fields.h"
#include "rondel/types.h"

namespace rondel::formats {

// Places that are compared with those of the fields' file; more are known by their number alone.
inline constexpr std::size_t max_compared = std::size_t{1} << 24U;

// The fields of a file at the places of a side.
struct FieldsOfSide {
  std::vector<LonLat> places;  // with which those of the file are compared; empty if they are many
  std::unique_ptr<FieldFile> file;
};

// Opens the fields with these names, or those that `in` names (FILE.nc:NAME), or all at the places of
// the side.
FieldsOfSide fields_of_side(const FileName& in, std::vector<std::string>&& names,
                            const RegridSide& side);

// Returns the remarks of both sides and of the fields, each once.
std::vector<std::string> remarks_of(const RegridSide& source, const RegridSide& target,
                                    const FieldSet& fields);

// Puts a line in front of the attribute `history`, unless it is empty.
void add_history(const std::string& line, FieldSet& fields);

}  // namespace rondel::formats
