// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
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

int open_to_change(const std::string& path) noexcept {
  return ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
}

std::ptrdiff_t read_at(int descriptor, std::uint64_t place, char* bytes,
                       std::size_t size) noexcept {
  for (;;) {
    const ssize_t count = ::pread(descriptor, bytes, size, static_cast<off_t>(place));
    if (count >= 0 || errno != EINTR) return count;
  }
}

std::ptrdiff_t write_at(int descriptor, std::uint64_t place, std::string_view bytes) noexcept {
  for (;;) {
    const ssize_t count =
        ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (count >= 0 || errno != EINTR) return count;
  }
}

int reserve(int descriptor, std::uint64_t size) noexcept {
#if defined(__APPLE__)
  return size <= size_of(descriptor) ? 0 : resize(descriptor, size);
#else
  int error = EINTR;
  while (error == EINTR) error = ::posix_fallocate(descriptor, 0, static_cast<off_t>(size));
  errno = error;
  return error == 0 ? 0 : -1;
#endif
}

namespace {

int allocate_if_possible(int descriptor, int mode, std::uint64_t size) noexcept {
#if defined(__linux__)
  int status = -1;
  do {
    status = ::fallocate(descriptor, mode, 0, static_cast<off_t>(size));
  } while (status != 0 && errno == EINTR);
  const bool cannot = errno == EOPNOTSUPP || errno == ENOSYS || errno == EINVAL;
  return status == 0 || cannot ? 0 : -1;
#else
  static_cast<void>(descriptor);
  static_cast<void>(mode);
  static_cast<void>(size);
  return 0;
#endif
}

}  // namespace

int prepare(int descriptor, std::uint64_t size) noexcept {
  return allocate_if_possible(descriptor, 0, size);
}

int allocate(int descriptor, std::uint64_t size) noexcept {
  // Linux does not hold room beyond the end of a file against the limit of the process.
  struct rlimit limit {};
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      size > limit.rlim_cur) {
    errno = EFBIG;
    return -1;
  }
#if defined(__linux__)
  return allocate_if_possible(descriptor, FALLOC_FL_KEEP_SIZE, size);
#else
  return allocate_if_possible(descriptor, 0, size);
#endif
}

int resize(int descriptor, std::uint64_t size) noexcept {
  return ::ftruncate(descriptor, static_cast<off_t>(size));
}

bool lock(int descriptor) noexcept { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0; }

int close(int descriptor) noexcept { return ::close(descriptor); }

std::uint64_t process_number() noexcept { return static_cast<std::uint64_t>(::getpid()); }

}  // namespace rondel::system
