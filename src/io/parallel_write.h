// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes what takes longer to make than to write: made by several threads, written in order. The
// bytes do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "io/atomic_file.h"
#include "rondel/export.h"

namespace rondel::io {

// So many items, each with a short text, are one thread's work at a time.
inline constexpr std::size_t items_per_piece = 4096;

// Calls append(text, begin, end) for the pieces of [0, count), which appends their text, and writes
// the texts one after the other. In memory are those of 4 pieces for each thread. Between pieces
// calls report(end), from the calling thread, if there is something to call.
RONDEL_API void write_in_parallel(
    AtomicFile& file, unsigned threads, std::size_t count, std::size_t grain,
    const std::function<void(std::string& text, std::size_t begin, std::size_t end)>& append,
    const std::function<void(std::size_t end)>& report = {});

}  // namespace rondel::io
