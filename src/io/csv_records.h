// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The records of a CSV file (RFC 4180).
//
// in    the text of a table
// out   one record after the other, as a list of fields
// index fields of a record, from 0; lines of the text, from 1
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace rondel::io {

// Returns the text of a table without the byte order mark of UTF-8. Throws BadValue for UTF-16.
std::string_view table_text(std::string_view bytes);

// 1. Records end with LF or CRLF, or with the text. Empty lines are skipped. A CR alone ends no
//    record, and may stand only in quotes.
// 2. A field that starts with a quote ends with the next single quote; inside, two quotes stand for
//    one and line ends are part of it. Elsewhere quotes are ordinary characters.
class CsvRecords {
 public:
  CsvRecords(std::string_view text, char delimiter)
      : next_(text.data()), start_(next_), end_(next_ + text.size()), delimiter_(delimiter) {}

  // Goes to the next record; returns false at the end. Throws BadValue for an unclosed quote and
  // for a CR alone.
  bool next();

  // The fields are valid until the next call of next().
  [[nodiscard]] const std::vector<std::string_view>& fields() const noexcept { return fields_; }
  // Returns the line in which the record starts, counted from 1.
  [[nodiscard]] std::uint64_t line() const noexcept { return line_; }
  // Returns how many bytes of the text have been read.
  [[nodiscard]] std::size_t position() const noexcept {
    return static_cast<std::size_t>(next_ - start_);
  }

 private:
  // Goes to the next line that is not empty.
  void skip_empty_lines();
  bool read_field();
  // Reads a field in quotes; a field without doubled quotes is a part of the text.
  std::string_view read_quoted();
  bool finish_field();

  const char* next_;
  const char* start_;
  const char* end_;
  char delimiter_;
  std::uint64_t line_ = 1;       // of the current record
  std::uint64_t next_line_ = 1;  // of next_
  std::vector<std::string_view> fields_;
  std::deque<std::string> unescaped_;  // fields of this record that had doubled quotes
};

}  // namespace rondel::io
