// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks text of files, which goes into JSON and messages.
//
// in    bytes
// out   whether they are valid UTF-8
#pragma once

#include <string_view>

namespace rondel::io {

// True if `text` is UTF-8 (RFC 3629).
bool is_utf8(std::string_view text);

}  // namespace rondel::io
