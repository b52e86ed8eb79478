// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Atomic folders on Windows, which remain under their temporary names if the process is killed.
#include <filesystem>
#include <system_error>

#include "io/atomic_folder.h"

namespace rondel::io {

std::string AtomicFolder::resolved(const std::string& path) { return path; }

int AtomicFolder::make_temporary(bool /*is_private*/) {
  std::error_code error;
  if (std::filesystem::create_directory(temporary_, error)) return 0;
  return error ? error.default_error_condition().value() : static_cast<int>(std::errc::file_exists);
}

void AtomicFolder::remember(const std::string& /*path*/) {}
void AtomicFolder::forget() noexcept {}
void AtomicFolder::remove_remembered() noexcept {}
void AtomicFolder::take_over_permissions() const noexcept {}
bool AtomicFolder::exchange(const std::string& /*a*/, const std::string& /*b*/) noexcept {
  return false;
}

}  // namespace rondel::io
