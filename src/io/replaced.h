// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What replaces a file or a folder on POSIX: where it lies, and what it takes over.
#pragma once

#include <string>

struct stat;

namespace rondel::io {

// Where the file of that name is, or would be made: the last symbolic link may lead to nothing.
std::string resolve_links(const std::string& path);

// Gives what is open owner, group and permissions of what it replaces, as far as this process may.
// It was made for its owner alone, so that it has at no moment more rights than it may have.
void take_permissions(int descriptor, const struct stat& replaced);

}  // namespace rondel::io
