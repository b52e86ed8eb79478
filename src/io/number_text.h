// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes doubles as text, fast, since text files consist of little else.
//
// in    a double
// out   its digits, the same on every machine
#pragma once

namespace rondel::io {

// The room that write_number() needs; the longest double has 24 characters:
// -2.2250738585072014e-308
inline constexpr int number_room = 32;

// Writes the shortest digits that give back the same bits, as std::to_chars does, and returns their
// end. `out` has room for number_room bytes, all of which may change.
char* write_number(char* out, double value);

}  // namespace rondel::io
