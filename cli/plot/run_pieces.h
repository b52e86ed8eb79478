// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Threads of the tool, since those of the library are not public.
///
/// in    work that consists of independent pieces
/// out   all pieces done, or an exception of one of them
#pragma once

#include <functional>

namespace rondel::cli {

/// Returns how many threads `--threads` means: 0 means one for each core.
unsigned num_workers(unsigned threads);

/// Calls work(0), ..., work(count - 1) in parallel, by at most `threads` threads including the
/// caller. \throws what one of the calls has thrown; calls that had not begun by then are skipped.
/// \param threads  how many, from num_workers()
/// \param count  the number of pieces; more pieces than threads share the work more evenly
/// \param work  takes the number of a piece
void run_pieces(unsigned threads, int count, const std::function<void(int)>& work);

}  // namespace rondel::cli
