// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// An error in a file and its place. The function that finds it says what; its callers add the
// item, the line, and at last the name of the file: `mesh.ply: face 7: index 12 is too large`.
//
// in    what is wrong, from the function that finds it
// out   an exception that says where: item, line, file
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "rondel/error.h"

namespace rondel::io {

class BadValue : public std::runtime_error {
 public:
  explicit BadValue(const std::string& what, std::uint64_t line = 0)
      : std::runtime_error(what), line_(line) {}

  // Returns the line, counted from 1; 0 in a file without lines.
  [[nodiscard]] std::uint64_t line() const noexcept { return line_; }

 private:
  std::uint64_t line_;
};

// Returns read(). If `item` is "row" and `number` 3, a BadValue gets "row 3: " before its message.
template <class Read>
decltype(auto) at_item(std::string_view item, std::uint64_t number, const Read& read) {
  try {
    return read();
  } catch (const BadValue& bad) {
    throw BadValue(std::string(item) + " " + std::to_string(number) + ": " + bad.what());
  }
}

// Returns read(). A BadValue without a line gets the one that lines.line() returns when it is thrown.
template <class Lines, class Read>
decltype(auto) at_line_of(const Lines& lines, const Read& read) {
  try {
    return read();
  } catch (const BadValue& bad) {
    throw BadValue(bad.what(), bad.line() > 0 ? bad.line() : lines.line());
  }
}

// Returns read(). A BadValue becomes a FileError "sites.csv:12: ...", or "mesh.ply: ..." if it has
// no line.
template <class Read>
decltype(auto) in_file(const std::string& name, const Read& read) {
  try {
    return read();
  } catch (const BadValue& bad) {
    throw FileError(name + (bad.line() == 0 ? "" : ":" + std::to_string(bad.line())) + ": " +
                    bad.what());
  }
}

}  // namespace rondel::io
