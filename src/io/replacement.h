// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file that will replace another one and that several processes write, so that it needs a name before.
// AtomicFile is for all others.
#pragma once

#include <string>

#include "rondel/export.h"

namespace rondel::io {

// The file that is replaced: `path`, or where its symbolic links lead to.
RONDEL_API std::string replaced_by(const std::string& path);

// Makes an empty file, to be renamed to `target`; with the owner, the group and the permissions that an
// AtomicFile would have. Returns its descriptor, or -1 and leaves the reason in errno: EEXIST if there is
// one of that name, or `target` may not be written or is no regular file.
RONDEL_API int open_replacement(const std::string& temporary, const std::string& target) noexcept;

}  // namespace rondel::io
