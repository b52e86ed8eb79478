// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Data in the format of zlib (RFC 1950), compressed and uncompressed as a whole. The library libdeflate,
// which takes about half of zlib's time, does it where the system has it; zlib does elsewhere.
//
// in    bytes, and the level 1 (fast) to 9 (small); or compressed bytes, and how many come of them
// out   compressed bytes, which depend on the library; or the bytes, which do not
#pragma once

#include <span>
#include <vector>

namespace rondel::io {

// Returns the compressed bytes; none if memory is missing.
std::vector<unsigned char> zlib_compressed(std::span<const unsigned char> bytes, int level);

// Writes the bytes that were compressed; returns false if the data is damaged, or their number is not
// that of `bytes`. What follows the data is passed over.
bool zlib_uncompress(std::span<const unsigned char> data, std::span<unsigned char> bytes);

}  // namespace rondel::io
