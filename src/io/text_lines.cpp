// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/text_lines.h"

#include <algorithm>

#include "io/bad_value.h"

namespace rondel::io {

bool TextLines::next() {
  constexpr std::string_view blanks = " \t\r\v\f";
  words_.clear();
  while (words_.empty() && position_ < text_.size()) {
    ++line_;
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    std::string_view line = text_.substr(position_, end - position_);
    position_ = end == text_.size() ? end : end + 1;
    while (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find('\r') != line.npos) throw BadValue("lines end with CR alone, not LF");
    line = line.substr(0, line.find('#'));
    std::size_t first = line.find_first_not_of(blanks);
    while (first != std::string_view::npos) {
      const std::size_t last = std::min(line.find_first_of(blanks, first), line.size());
      words_.push_back(line.substr(first, last - first));
      first = line.find_first_not_of(blanks, last);
    }
  }
  return !words_.empty();
}

}  // namespace rondel::io
