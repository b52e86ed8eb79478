// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays as a page holds them: by planes, as a zlib stream (RFC 1950), in base64 (RFC 4648).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rondel::page {

// The first bytes of all numbers of `width` bytes, then all second ones ...: bytes of a plane are alike,
// those of a number are not.
std::string in_planes(std::string_view bytes, std::size_t width);

// Pieces of a fixed size are compressed by several threads, so that the bytes do not depend on
// their number. Throws Interrupted where the calling thread is told to stop.
std::string zlib_stream(std::string_view bytes, unsigned threads);

std::string base64(std::string_view bytes);

}  // namespace rondel::page
