// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Packs arrays for a page: bytes sorted by planes, compressed as a zlib stream (RFC 1950), written
// in base64 (RFC 4648).
//
// in    bytes
// out   bytes, text
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rondel::page {

// Returns the first bytes of all numbers of `width` bytes, then all second bytes, and so on. Bytes
// of one plane resemble each other more than the bytes of one number, so they compress better.
// Precondition: bytes.size() is a multiple of `width`.
std::string in_planes(std::string_view bytes, std::size_t width);

// Returns the bytes as a zlib stream. Pieces of a fixed size are compressed by several threads, so
// the result does not depend on their number. Throws Interrupted if the calling thread is told to
// stop.
std::string zlib_stream(std::string_view bytes, unsigned threads);

// Returns the bytes in base64, padded with '='.
std::string base64(std::string_view bytes);

}  // namespace rondel::page
