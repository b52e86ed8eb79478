// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/file_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <system_error>

#include "io/signal_slots.h"
#include "rondel/error.h"

namespace rondel::io {
namespace {

SignalSlots<4> mapped_files;

[[noreturn]] void fail(const std::string& path, int error) {
  throw FileError((path == "-" ? "<stdin>" : path) + ": " + std::generic_category().message(error));
}

class Descriptor {
 public:
  explicit Descriptor(const std::string& path)
      : is_owned_(path != "-"),
        value_(is_owned_ ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC) : STDIN_FILENO) {
    if (value_ < 0) fail(path, errno);
  }
  ~Descriptor() {
    if (is_owned_) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const noexcept { return value_; }

 private:
  bool is_owned_;
  int value_;
};

std::string read_to_end(int descriptor, const std::string& path) {
  std::string bytes;
  std::size_t size = 0;
  while (true) {
    if (bytes.size() == size) bytes.resize(size < 65536 ? 65536 : 2 * size);
    const ssize_t count = ::read(descriptor, bytes.data() + size, bytes.size() - size);
    if (count == 0) break;
    if (count > 0) {
      size += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      fail(path, errno);
    }
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace

FileBytes::FileBytes(const std::string& path) {
  const Descriptor file(path);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail(path, errno);
  if (S_ISDIR(status.st_mode)) fail(path, EISDIR);
  // Files of /proc and /sys are regular too, but claim to be empty.
  if (path == "-" || !S_ISREG(status.st_mode) || status.st_size == 0) {
    copy_ = read_to_end(file.get(), path);
    return;
  }
  size_ = static_cast<std::size_t>(status.st_size);
  void* const mapping = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (mapping == MAP_FAILED) fail(path, errno);
  ::madvise(mapping, size_, MADV_SEQUENTIAL);
  mapping_ = mapping;
  const auto* const bytes = static_cast<const char*>(mapping);
  slot_ = mapped_files.remember(path, bytes, bytes + size_);
}

void FileBytes::keep() const noexcept {
  if (mapping_ != nullptr) ::madvise(mapping_, size_, MADV_NORMAL);
}

FileBytes::~FileBytes() {
  if (mapping_ == nullptr) return;
  mapped_files.forget(slot_);
  ::munmap(mapping_, size_);
}

const char* mapped_file_at(const void* address) noexcept {
  const auto* const byte = static_cast<const char*>(address);
  const auto* const slot = mapped_files.find([&](const auto& file) {
    return std::less_equal<>()(file.begin, byte) && std::less<>()(byte, file.end);
  });
  return slot == nullptr ? nullptr : slot->name.data();
}

}  // namespace rondel::io
