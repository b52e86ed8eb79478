// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The main program of same_bytes_weights and same_bytes_overlay.
#pragma once

#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "same_bytes/portable/hashes.h"

namespace rondel::test {

// PROGRAM EXPECTED compares the lines with those that are recorded and tells what differs, PROGRAM EXPECTED --update
// records them. The exit status.
inline int compare_or_record(const char* program, std::vector<std::string> (*make_lines)(),
                             int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool is_update = arguments.size() == 2 && arguments[1] == "--update";
  if (arguments.size() != 1 && !is_update) {
    std::fprintf(stderr, "usage: %s EXPECTED [--update]\n", program);
    return 2;
  }
  try {
    if (!is_update) return num_different(arguments[0], make_lines()) == 0 ? 0 : 1;
    std::ofstream file(arguments[0]);
    for (const std::string& line : make_lines()) file << line << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return 1;
  }
}

}  // namespace rondel::test
