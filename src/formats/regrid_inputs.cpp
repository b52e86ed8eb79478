// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_inputs.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <system_error>

#include "io/file_bytes.h"
#include "rondel/error.h"
#include "system/hash.h"

namespace rondel::formats {
namespace {

// Returns the state of a regular file, or nothing. The bytes at its beginning are compared, too,
// since two changes may have the same time on systems whose clocks are coarse.
std::optional<std::string> file_state(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return std::nullopt;
  const auto time = std::filesystem::last_write_time(path, error);
  if (error) return std::nullopt;
  std::uint64_t hash = 0;
  const io::FileBytes bytes(FileName{path, {}}, true);
  for (const char c : bytes.head()) {
    hash = system::mixed(hash, static_cast<unsigned char>(c));
  }
  // Clocks of some C++ libraries count in integers of 128 bits.
  const auto ticks = static_cast<std::int64_t>(time.time_since_epoch().count());
  return std::to_string(size) + " bytes of time " + std::to_string(ticks) + " and hash " +
         std::to_string(hash);
}

}  // namespace

void RegridInputs::add(const std::string& role, const FileName& file) {
  if (file.bytes != nullptr) return;
  const std::string path = file_and_variable(file).first.path;
  io::require_no_pipe(path);
  if (const auto state = file_state(path)) files_.push_back({role, path, *state});
}

void RegridInputs::require_other(const FileName& out) const {
  if (out.bytes != nullptr) return;
  for (const FileState& file : files_) {
    std::error_code error;
    if (!std::filesystem::equivalent(file.path, out.path, error)) continue;
    throw FileError(out.path + ": it is the file of the " + file.role + ", too");
  }
}

void RegridInputs::require_unchanged() const {
  for (const FileState& file : files_) {
    if (file_state(file.path) != file.text) {
      throw FileError(file.path + ": changed while it was read");
    }
  }
}

std::vector<JournalFact> RegridInputs::facts() const {
  std::vector<JournalFact> facts;
  for (const FileState& file : files_) {
    facts.push_back({file.role, file.path + ", " + file.text});
  }
  return facts;
}

bool RegridInputs::has(const std::string& role) const {
  return std::ranges::any_of(files_, [&](const FileState& file) { return file.role == role; });
}

}  // namespace rondel::formats
