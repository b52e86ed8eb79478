// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Paths as Windows wants them.
#pragma once

#include <string>

namespace rondel::system {

// The UTF-16 of a path in UTF-8; what is no UTF-8 becomes a character that no file's name has.
std::wstring wide_path(const std::string& path);

}  // namespace rondel::system
