// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Doubles as text, fast: what files of text consist of.
#pragma once

namespace rondel::io {

// What write_number() needs room for; the longest double takes 24: -2.2250738585072014e-308
inline constexpr int number_room = 32;

// Writes the shortest digits that give back the same bits, as std::to_chars does, and returns their
// end. `out` has room for number_room bytes, all of which may change.
char* write_number(char* out, double value);

}  // namespace rondel::io
