// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/file_part.h"

#include <filesystem>
#include <system_error>

namespace rondel::io {

std::pair<FileName, std::string> split_part(const FileName& file) {
  const std::size_t at = file.path.rfind(':');
  constexpr std::size_t drive = 2;  // a drive of Windows, C:
  if (at == std::string::npos || at < drive || at + 1 == file.path.size()) return {file, {}};
  std::error_code ignored;
  const std::string whole = file.path.substr(0, at);
  if (std::filesystem::exists(file.path, ignored) || !std::filesystem::exists(whole, ignored)) {
    return {file, {}};
  }
  return {FileName(whole, file.format), file.path.substr(at + 1)};
}

}  // namespace rondel::io
