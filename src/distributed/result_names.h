// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a run from a file to files may write over: nothing that it reads, no result twice.
#pragma once

#include <string>
#include <vector>

namespace rondel::distributed {

// Throws FileError if the ending of the name is another one; it may have none.
void require_npy(const std::string& name);

// Throws FileError if the faces, the first result, have no name, or if of the sites and the results two are
// one file; results without a name are not wanted. All results may be one Zarr group, others are .npy files; the faces are
// whatever the caller knows them to be.
void require_different(const std::string& sites, const std::vector<std::string>& results);

// Whether both are names of one file, which need not be there.
bool are_same_file(const std::string& a, const std::string& b);

}  // namespace rondel::distributed
