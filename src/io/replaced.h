// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files and folders that are replaced on POSIX: where they are, and what the new ones take over.
//
// in    a path, or an open file with the status of the one that it replaces
// out   the path without links; the owner, group and permissions of the new one
#pragma once

#include <string>

struct stat;

namespace rondel::io {

// Returns the path of the file of that name with symbolic links resolved; the file need not exist.
std::string resolve_links(const std::string& path);

// Gives an open file or folder the owner, group and permissions of what it replaces, as far as this
// process may. It was created for its owner alone, so that it never has more permissions than it
// should.
void take_permissions(int descriptor, const struct stat& replaced);

}  // namespace rondel::io
