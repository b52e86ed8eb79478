// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/ending.h"

#include "rondel/error.h"

namespace rondel::io {

std::string ending(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos || dot + 1 == path.size()) return {};
  std::string result(path.substr(dot));
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

void throw_unknown_ending(const std::string& path, std::string_view what,
                          std::span<const std::string_view> known) {
  const std::string found = ending(path);
  std::string message = path + ": ";
  message += found.empty() ? "the name has no ending" : "unknown ending \"" + found + "\"";
  message += "; ";
  message += what;
  for (const std::string_view format : known) (message += ' ') += format;
  throw FileError(message);
}

}  // namespace rondel::io
