// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Names of variables of a file, which users write as FILE.nc:NAME.
//
// in    the name of a file as the user gives it
// out   the file, and the name of a variable or an empty text
#pragma once

#include <string>
#include <utility>

#include "rondel/io.h"

namespace rondel::io {

// Returns the file, and the name behind the last colon. The name is empty if a file of the whole
// name exists, or none of the part before the colon.
std::pair<FileName, std::string> split_part(const FileName& file);

}  // namespace rondel::io
