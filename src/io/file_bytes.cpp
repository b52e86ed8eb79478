// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/file_bytes.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "rondel/error.h"
#include "system/descriptor.h"

namespace rondel::io {
namespace {

// The longest header of .npy of version 1 has 65545 bytes, which is less.
constexpr std::size_t head_size = 131072;

// The first bytes of compressed files.
constexpr std::pair<std::string_view, const char*> compressed[] = {{"\x1F\x8B", "gzip"},
                                                                   {"PK\x03\x04", "zip"},
                                                                   {"\xFD"
                                                                    "7zXZ",
                                                                    "xz"},
                                                                   {"\x28\xB5\x2F\xFD", "zstd"}};

// True if standard input had bytes before, which cannot be read again.
bool had_standard_input(bool has_bytes) {
  static std::atomic<bool> had_bytes = false;
  return has_bytes ? had_bytes.exchange(true) : had_bytes.load();
}

}  // namespace

FileBytes::FileBytes(const FileName& file, bool may_be_zip) : name_(file.path), descriptor_(-1) {
  if (file.bytes == nullptr) {
    open(file.path);
  } else {
    claimed_size_ = num_read_ = file.bytes->size();
    is_at_end_ = true;
    bytes_ = system::make_large_array<char>(num_read_);
    std::ranges::copy(*file.bytes, bytes_.get());
  }
  for (const auto& [magic, format] : compressed) {
    if (!head().starts_with(magic) || (may_be_zip && format == std::string_view("zip"))) continue;
    throw FileError(name_ + ": compressed (" + format + "); unpack it first");
  }
}

void FileBytes::open(const std::string& path) {
  const bool is_input = path == "-";
  if (is_input) name_ = "<stdin>";
  descriptor_.value = is_input ? system::standard_input : system::open_to_read(path);
  if (descriptor_.value < 0) fail(errno);
  if (is_input) system::keep_bytes(descriptor_.value);
  claimed_size_ = system::size_of(descriptor_.value);
  bytes_ = system::make_large_array<char>(head_size);
  read_up_to(head_size);
  if (is_input && had_standard_input(num_read_ > 0) && num_read_ == 0) {
    throw FileError(name_ + ": standard input can be read once, and has been read before");
  }
}

FileBytes::Descriptor::~Descriptor() {
  if (value > system::standard_input) system::close(value);
}

// The file may be longer than it claims: files in /proc claim to be empty.
std::string_view FileBytes::text() {
  std::size_t capacity = head_size;
  while (!is_at_end_) {
    capacity = std::max<std::size_t>(2 * std::max(capacity, num_read_), claimed_size_ + 1);
    grow(capacity);
  }
  return head();
}

std::string_view FileBytes::longer_head(std::size_t size) {
  if (size > num_read_ && !is_at_end_) grow(size);
  return head();
}

void FileBytes::grow(std::size_t capacity) {
  auto longer = system::make_large_array<char>(capacity);
  std::copy_n(bytes_.get(), num_read_, longer.get());
  bytes_ = std::move(longer);
  read_up_to(capacity);
}

void FileBytes::read_at(std::uint64_t place, char* bytes, std::size_t size) const {
  if (descriptor_.value < 0) {
    if (size > num_read_ || place > num_read_ - size)
      throw FileError(name_ + ": shorter than it says");
    std::copy_n(bytes_.get() + place, size, bytes);
    return;
  }
  while (size > 0) {
    const std::ptrdiff_t count = system::read_at(descriptor_.value, place, bytes, size);
    if (count < 0) fail(errno);
    if (count == 0) throw FileError(name_ + ": cut off while it was read");
    const auto read = static_cast<std::size_t>(count);
    place += read;
    bytes += read;
    size -= read;
  }
}

// Reads until `size` bytes are in memory. Precondition: `bytes_` has room for them.
void FileBytes::read_up_to(std::size_t size) {
  while (num_read_ < size && !is_at_end_) {
    const std::ptrdiff_t count =
        system::read(descriptor_.value, bytes_.get() + num_read_, size - num_read_);
    if (count < 0) fail(errno);
    num_read_ += static_cast<std::size_t>(count);
    is_at_end_ = count == 0;
  }
}

void require_no_pipe(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_fifo(path, error)) return;
  throw FileError(path + ": a pipe, and this file is read more than once; copy it to a file first");
}

void FileBytes::fail(int error) const {
  throw FileError(name_, std::error_code(error, std::generic_category()));
}

}  // namespace rondel::io
