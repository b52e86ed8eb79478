// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A variable of a file, as users name it: FILE.nc:NAME.
#pragma once

#include <string>
#include <utility>

#include "rondel/export.h"
#include "rondel/io.h"

namespace rondel::io {

// The file and the name behind the last colon; no name where there is a file of the whole name, or none of the first part.
RONDEL_API std::pair<FileName, std::string> split_part(const FileName& file);

}  // namespace rondel::io
