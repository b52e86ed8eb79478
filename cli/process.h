// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What the tool asks of the system that runs it: process_posix.cpp, process_windows.cpp.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace rondel::cli {

/// To be called first. From then on standard streams are files that cannot be mistaken for others,
/// which carry the same bytes on every system, and what ends the process leaves no temporary file.
void prepare_process();

/// From the first call on: a flag that Ctrl-C sets, instead of ending the process. The second Ctrl-C does that.
const std::atomic<bool>& interrupted_by_user();

/// The arguments of main(); in UTF-8 on Windows.
std::vector<const char*> arguments_of_process(int argc, const char* const* argv);

/// Whether standard error is a terminal that obeys the sequence that clears a line.
bool has_terminal();

/// The largest resident size of this process so far.
std::uint64_t peak_memory_bytes();

/// A library that the system finds by its name or path; nullptr if there is none. It stays loaded.
void* open_library(const char* name);

/// What a library calls so; nullptr if it has no such name.
void* symbol_of(void* library, const char* name);

}  // namespace rondel::cli
