// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "io/number.h"
#include "io/site_collector.h"
#include "io/site_formats.h"
#include "io/text_lines.h"

// Reads three numbers a line with blanks between them; '#' begins a comment.
namespace rondel::io {
namespace {

void read_lines(TextLines& lines, const ReadJob& options, SiteTable& table) {
  SiteCollector collector(table, options);
  while (lines.next()) {
    const auto& words = lines.words();
    if (words.size() != 3) {
      throw BadValue(std::to_string(words.size()) + (words.size() == 1 ? " field" : " fields") +
                     " where three numbers are expected");
    }
    collector.add_point(
        {parse_number(words[0], "x"), parse_number(words[1], "y"), parse_number(words[2], "z")},
        lines.line());
    collector.report_progress(lines.position(), lines.size());
  }
}

}  // namespace

void read_xyz(std::string_view bytes, const ReadJob& options, SiteTable& table) {
  TextLines lines(bytes);
  at_line_of(lines, [&] { read_lines(lines, options, table); });
}

}  // namespace rondel::io
