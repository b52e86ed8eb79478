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

// Throws FileError for an input that is there and holds no fields: other formats than netCDF, and
// tables and arrays unless the source says where their values are.
void require_file_of_fields(const FileName& in, bool has_source);

// Returns the variables that are wanted: those that are named, or the one that `in` names (FILE.nc:NAME).
// None stand for all at the places of the side.
std::vector<std::string> wanted_variables(const FileName& in,
                                          const std::vector<std::string>& names);

// Opens the fields with these names, or all at the places of the side.
std::unique_ptr<FieldFile> open_fields(const FileName& in, const std::vector<std::string>& names,
                                       const RegridSide& side);

// True if the values of an array stand for categories.
bool has_flags(const FieldArray& array);

// Returns arrays at the targets, with what the input has beside its fields, the attributes that tell of
// corners that were made, and a line in front of the attribute `history` unless it is empty.
FieldSet fields_at_targets(const FieldSet& in, std::vector<FieldArray>&& arrays,
                           const RegridSide& source, const RegridSide& target,
                           const std::string& history);

// Adds remarks about a file, each with its name and once.
void add_remarks(const std::string& file, const std::vector<std::string>& remarks,
                 std::vector<std::string>& all);

// Returns the remarks of both sides and of the fields, which are those of `file`.
std::vector<std::string> remarks_of(const RegridSide& source, const RegridSide& target,
                                    const std::string& file, const FieldSet& fields);

}  // namespace rondel::formats
