// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What the tool needs from the operating system: process_posix.cpp, process_windows.cpp.
///
/// in    the arguments of main() and the standard streams
/// out   the same behaviour on every system
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rondel::cli {

/// Call this first. Afterwards the standard streams are files that cannot be confused with others,
/// carry the same bytes on every system, and temporary files are removed whatever ends the process.
void prepare_process();

/// Returns a flag that Ctrl-C sets from the first call on, instead of ending the process. A second
/// Ctrl-C ends it.
const std::atomic<bool>& interrupted_by_user();

/// Returns the arguments of main(), in UTF-8 on Windows.
std::vector<const char*> arguments_of_process(int argc, const char* const* argv);

/// Returns where the program is that was called by this name; an empty path if it is not found.
std::filesystem::path path_of_executable(const std::string& name);

/// True if standard error is a terminal that obeys the sequence that clears a line.
bool has_terminal();

/// Returns the largest resident size of this process so far.
std::uint64_t peak_memory_bytes();

}  // namespace rondel::cli
