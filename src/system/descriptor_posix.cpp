// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "system/descriptor.h"

namespace rondel::system {

void keep_bytes(int /*standard_stream*/) noexcept {}

int open_to_read(const std::string& path) noexcept {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0 || !S_ISDIR(status.st_mode)) {
    return descriptor;
  }
  ::close(descriptor);
  errno = EISDIR;
  return -1;
}

std::uint64_t size_of(int descriptor) noexcept {
  struct stat status {};
  const bool is_known = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  return is_known ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::ptrdiff_t read(int descriptor, char* bytes, std::size_t size) noexcept {
  for (;;) {
    const ssize_t count = ::read(descriptor, bytes, size);
    if (count >= 0 || errno != EINTR) return count;
  }
}

std::ptrdiff_t write(int descriptor, std::string_view bytes) noexcept {
  for (;;) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count >= 0 || errno != EINTR) return count;
  }
}

int close(int descriptor) noexcept { return ::close(descriptor); }

std::uint64_t process_number() noexcept { return static_cast<std::uint64_t>(::getpid()); }

}  // namespace rondel::system
