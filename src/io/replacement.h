// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file that will replace another one and that several processes write, so that it needs a name
// while it is written. All other files are written by AtomicFile.
//
// in    the path of the file that is replaced, and a temporary name beside it
// out   a descriptor of an empty file
#pragma once

#include <string>

#include "rondel/export.h"

namespace rondel::io {

// Returns the file that is replaced: `path`, or the file to which its symbolic links lead.
RONDEL_API std::string replaced_by(const std::string& path);

// Creates an empty file, to be renamed to `target`, with the owner, the group and the permissions
// that an AtomicFile would have. Returns its descriptor; or -1 with the reason in errno, which is
// EEXIST if `temporary` exists. It fails also if `target` may not be written or is not a regular
// file.
RONDEL_API int open_replacement(const std::string& temporary, const std::string& target) noexcept;

}  // namespace rondel::io
