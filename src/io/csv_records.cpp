// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/csv_records.h"

#include <algorithm>
#include <cstring>

#include "io/number.h"

namespace rondel::io {

std::string_view table_text(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    throw BadValue("the file is UTF-16, not UTF-8");
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  return bytes;
}

bool CsvRecords::next() {
  fields_.clear();
  unescaped_.clear();
  skip_empty_lines();
  line_ = next_line_;
  if (next_ == end_) return false;
  while (read_field()) {
  }
  return true;
}

void CsvRecords::skip_empty_lines() {
  while (next_ != end_) {
    const char* p = next_;
    while (p != end_ && *p == '\r') ++p;
    if (p == end_ || *p != '\n') return;
    next_ = p + 1;
    ++next_line_;
  }
}

// Reads a field and what ends it; returns false if the record ends too.
bool CsvRecords::read_field() {
  if (next_ != end_ && *next_ == '"') {
    fields_.push_back(read_quoted());
    return finish_field();
  }
  const char* const first = next_;
  const char* p = first;
  while (p != end_ && *p != delimiter_ && *p != '\n' && *p != '\r') ++p;
  next_ = p;
  fields_.emplace_back(first, p);
  return finish_field();
}

// Goes past what ends a field, which must be a delimiter, the end of a line or the end of the text;
// returns false if the record ends too.
bool CsvRecords::finish_field() {
  bool is_return = false;
  for (; next_ != end_ && *next_ == '\r'; ++next_) is_return = true;
  if (next_ == end_) return false;
  const char c = *next_++;
  if (is_return && c != '\n') throw BadValue("lines end with CR alone, not LF");
  if (c == delimiter_) return true;
  if (c != '\n') throw BadValue("text behind the closing quote of a field");
  ++next_line_;
  return false;
}

std::string_view CsvRecords::read_quoted() {
  const char* first = ++next_;
  std::string* unescaped = nullptr;
  while (true) {
    const auto rest = static_cast<std::size_t>(end_ - first);
    const auto* const quote = static_cast<const char*>(std::memchr(first, '"', rest));
    if (quote == nullptr) throw BadValue("a quoted field does not end");
    next_line_ += static_cast<std::uint64_t>(std::count(first, quote, '\n'));
    const bool is_doubled = quote + 1 != end_ && quote[1] == '"';
    if (is_doubled && unescaped == nullptr) unescaped = &unescaped_.emplace_back();
    const char* const stop = is_doubled ? quote + 1 : quote;  // one of two doubled quotes is kept
    if (unescaped != nullptr) unescaped->append(first, stop);
    if (!is_doubled) {
      const std::string_view field(next_, static_cast<std::size_t>(quote - next_));
      next_ = quote + 1;
      return unescaped != nullptr ? std::string_view(*unescaped) : field;
    }
    first = quote + 2;
  }
}

}  // namespace rondel::io
