// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Divides a text file into lines, and these into words between blanks, for .xyz .off .obj and ASCII
// .ply.
//
// in    the text of a file
// out   the words of one line after the other
// index lines, from 1; words of a line, from 0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace rondel::io {

// Lines end with LF or CRLF. A '#' begins a comment; lines without words are skipped.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) position_ = 3;
  }

  // Goes to the next line that has words; returns false at the end.
  bool next();

  [[nodiscard]] const std::vector<std::string_view>& words() const noexcept { return words_; }
  // Returns the number of the current line, counted from 1.
  [[nodiscard]] std::uint64_t line() const noexcept { return line_; }
  // Returns how many bytes have been read.
  [[nodiscard]] std::size_t position() const noexcept { return position_; }
  [[nodiscard]] std::size_t size() const noexcept { return text_.size(); }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::uint64_t line_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace rondel::io
