// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Threads of the tool's own: the library's are not public.
#pragma once

#include <functional>

namespace rondel::cli {

/// How many threads `--threads` stands for: for 0 one for each core.
unsigned num_workers(unsigned threads);

/// Calls work(0), ..., work(count - 1), at once by at most so many threads, the caller among them.
/// \throws what one of the calls has thrown; calls that had not begun by then are left out.
void run_pieces(unsigned threads, int count, const std::function<void(int)>& work);

}  // namespace rondel::cli
