// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/ending.h"

#include "rondel/error.h"

namespace rondel::io {

std::string ending(const FileName& file) {
  std::string_view name = file.path;
  while (name.ends_with('/')) name.remove_suffix(1);  // of a folder
  name.remove_prefix(name.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  std::string result;
  if (!file.format.empty()) {
    result = (file.format.front() == '.' ? "" : ".") + file.format;
  } else if (dot < name.size() - 1) {
    result = name.substr(dot);
  }
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

void throw_unknown_ending(const FileName& file, std::string_view what,
                          std::span<const std::string_view> known) {
  const std::string found = ending(file);
  std::string message = file.path + ": ";
  if (!file.format.empty()) {
    message += "unknown format \"" + file.format + "\"";
  } else {
    message += found.empty() ? "the name has no ending" : "unknown ending \"" + found + "\"";
  }
  message += "; ";
  message += what;
  for (const std::string_view format : known) (message += ' ') += format;
  throw FileError(message);
}

}  // namespace rondel::io
