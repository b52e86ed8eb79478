// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reading and writing at a place go on until all bytes are done, as the system may do fewer.

#include "distributed/scratch_file.h"

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include "rondel/error.h"
#include "system/descriptor.h"

namespace rondel::distributed {

ScratchFile::ScratchFile(std::string path)
    : path_(std::move(path)), descriptor_(system::open_to_change(path_)) {
  if (descriptor_ < 0) fail(errno);
}

ScratchFile::~ScratchFile() { system::close(descriptor_); }

std::uint64_t ScratchFile::size() const { return system::size_of(descriptor_); }

void ScratchFile::reserve(std::uint64_t size) {
  if (size != 0 && system::reserve(descriptor_, size) != 0) fail(errno);
}

void ScratchFile::cut(std::uint64_t size) {
  if (system::resize(descriptor_, size) != 0) fail(errno);
}

bool ScratchFile::lock() const { return system::lock(descriptor_); }

void ScratchFile::read_bytes(std::uint64_t place, std::span<char> bytes) const {
  while (!bytes.empty()) {
    const std::ptrdiff_t count = system::read_at(descriptor_, place, bytes.data(), bytes.size());
    if (count < 0) fail(errno);
    if (count == 0) throw FileError(path_ + ": the file was cut");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    place += static_cast<std::uint64_t>(count);
  }
}

void ScratchFile::write_bytes(std::uint64_t place, std::span<const char> bytes) {
  std::string_view rest(bytes.data(), bytes.size());
  while (!rest.empty()) {
    const std::ptrdiff_t count = system::write_at(descriptor_, place, rest);
    if (count < 0) fail(errno);
    rest.remove_prefix(static_cast<std::size_t>(count));
    place += static_cast<std::uint64_t>(count);
  }
}

void ScratchFile::fail(int error) const {
  throw FileError(path_, std::error_code(error, std::generic_category()));
}

}  // namespace rondel::distributed
