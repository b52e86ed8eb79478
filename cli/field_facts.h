// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What `rondel info` says of the fields of a netCDF file.
///
/// in    the fields at the places of the file, without their values
/// out   lines for people, members of a JSON object
/// index fields, in the order of the file
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "rondel/fields.h"
#include "rondel/io.h"

namespace rondel::cli {

/// Returns lines that say which grid the places are on, which fields there are, with units and the
/// lengths of further dimensions, from where to where axes such as times go, and what was left out.
std::string lines_of_fields(const FieldSet& fields);

/// Adds the members "grid", the lengths of the dimensions of the places, "fields", "axes" and
/// "remarks".
void add_facts_of(const FieldSet& fields, nlohmann::ordered_json& json);

/// Returns the name by which an option takes the first field: "tas", or "tas[0,0]" if the variable
/// has several; an empty text if there are no fields.
std::string first_field_of(const FieldSet& fields);

/// Returns the fields of a netCDF file, without their values, that are at other places than the
/// centers of its cells, such as the nodes of its mesh, where none is at these; nothing for other
/// files. Several places may have fields: they are those of the first one, and a remark names others.
/// \param table  the sites of the file
std::optional<FieldSet> fields_elsewhere(const FileName& file, const SiteTable& table);

}  // namespace rondel::cli
