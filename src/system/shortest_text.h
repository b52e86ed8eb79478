// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers in messages.
#pragma once

#include <string>

#include "rondel/export.h"

namespace rondel::system {

// The shortest text that reads back as this double, as std::to_chars writes it.
RONDEL_API std::string shortest_text(double value);

// What shortest_text() gives, without std::to_chars, whose tables of powers of ten would be a third of
// a module of WebAssembly: up to 17 attempts, for machines where size counts.
std::string shortest_text_without_tables(double value);

}  // namespace rondel::system
