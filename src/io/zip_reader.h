// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads members of zip archives, stored or deflated.
//
// in    the bytes of an archive, and the name of a member
// out   the content of the member
#pragma once

#include <string>
#include <string_view>

namespace rondel::io {

// Returns the content of a member of the archive in `bytes`. Throws BadValue if there is none, the
// archive is damaged, or a checksum is wrong; no memory is allocated for a size that the archive's
// bytes cannot have.
std::string zip_member(std::string_view bytes, std::string_view name);

// True if the archive has such a member.
bool has_zip_member(std::string_view bytes, std::string_view name);

}  // namespace rondel::io
