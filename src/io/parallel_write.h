// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes text that takes longer to make than to write: several threads make it, and it is written
// in order. The bytes do not depend on the number of threads.
//
// in    a function that appends the text of items
// out   the text of all items, in their order, in a file
// index items, from 0 to count - 1
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "io/atomic_file.h"

namespace rondel::io {

// The number of items with a short text that one thread takes at a time.
inline constexpr std::size_t items_per_piece = 4096;

// Calls append(text, begin, end) for the pieces of [0, count), which appends their text, and writes
// the texts one after the other. The texts of four pieces a thread are in memory at once. Between
// pieces it calls report(end) from the calling thread, if that is given.
void write_in_parallel(
    AtomicFile& file, unsigned threads, std::size_t count, std::size_t grain,
    const std::function<void(std::string& text, std::size_t begin, std::size_t end)>& append,
    const std::function<void(std::size_t end)>& report = {});

}  // namespace rondel::io
