// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Names in files with groups: CF 1.11, section 2.7.1.
//
// in    names of variables as attributes and users write them
// out   the full names that the reader gives to variables, "group/name"
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "io/netcdf_header.h"
#include "io/netcdf_reader.h"

namespace rondel::io {

// Replaces the names in attributes such as `bounds` and `coordinates` by those that the reader has,
// "group/name". A name with a slash at its front begins at the root, "../" leads to the group
// above, and other names are searched in the group of the variable and then in those above it.
// Names of no variable stay as they are.
void resolve_names(NetcdfHeader& header);

// Returns the variable's name in the reader for one that a user wrote: "/group/name", or the name
// alone if only one group has it. An index in brackets may follow. Other names are returned as they
// are.
std::string full_name(std::span<const VariableInFile> variables, const std::string& name);

// Throws BadValue, which names the variables, if several groups have one of the name.
void require_one_group(std::span<const VariableInFile> variables, std::string_view name);

}  // namespace rondel::io
