// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks the names of result files: a run must not overwrite its input, nor one result by another.
#pragma once

#include <string>
#include <vector>

namespace rondel::distributed {

// Throws FileError if the name has an ending other than .npy; it may have none.
void require_npy(const std::string& name);

// Throws FileError if the faces, the first result, have no name, or if two of the sites and the
// results are one file. Results with empty names are not wanted. They are .npy files, and the
// caller has checked the ending of the faces, except for .zarr, which is refused.
void require_different(const std::string& sites, const std::vector<std::string>& results);

// True if both are names of one file, which need not exist.
bool are_same_file(const std::string& a, const std::string& b);

}  // namespace rondel::distributed
