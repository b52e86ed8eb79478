// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <io.h>
#include <stdio.h>
#include <sys/locking.h>
#include <sys/stat.h>
#include <windows.h>

#include <algorithm>
#include <cerrno>
#include <limits>

#include "system/descriptor.h"
#include "system/wide_path.h"

namespace rondel::system {
namespace {

// What one call can read or write.
unsigned clipped(std::size_t size) {
  constexpr std::size_t most = std::numeric_limits<int>::max();
  return static_cast<unsigned>(std::min(size, most));
}

// Calls move() at a place of the file, and goes back to where the file was.
template <class Move>
std::ptrdiff_t at(int descriptor, std::uint64_t place, Move move) {
  const std::int64_t before = ::_telli64(descriptor);
  if (before < 0) return -1;
  if (::_lseeki64(descriptor, static_cast<std::int64_t>(place), SEEK_SET) < 0) return -1;
  const std::ptrdiff_t count = move();
  return ::_lseeki64(descriptor, before, SEEK_SET) < 0 ? -1 : count;
}

}  // namespace

std::wstring wide_path(const std::string& path) {
  const int size = static_cast<int>(path.size());
  const auto convert = [&](wchar_t* to, int room) {
    return ::MultiByteToWideChar(CP_UTF8, 0, path.data(), size, to, room);
  };
  std::wstring wide(static_cast<std::size_t>(convert(nullptr, 0)), L'\0');
  convert(wide.data(), static_cast<int>(wide.size()));
  return wide;
}

void keep_bytes(int standard_stream) noexcept { ::_setmode(standard_stream, _O_BINARY); }

int open_to_read(const std::string& path) noexcept {
  const std::wstring name = wide_path(path);
  const DWORD attributes = ::GetFileAttributesW(name.c_str());
  if (attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) {
    errno = EISDIR;
    return -1;
  }
  return ::_wopen(name.c_str(), _O_RDONLY | _O_BINARY | _O_NOINHERIT);
}

std::uint64_t size_of(int descriptor) noexcept {
  struct _stat64 status {};
  const bool is_known =
      ::_fstat64(descriptor, &status) == 0 && (status.st_mode & _S_IFMT) == _S_IFREG;
  return is_known ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::ptrdiff_t read(int descriptor, char* bytes, std::size_t size) noexcept {
  return ::_read(descriptor, bytes, clipped(size));
}

std::ptrdiff_t write(int descriptor, std::string_view bytes) noexcept {
  return ::_write(descriptor, bytes.data(), clipped(bytes.size()));
}

int open_to_change(const std::string& path) noexcept {
  return ::_wopen(wide_path(path).c_str(), _O_RDWR | _O_CREAT | _O_BINARY | _O_NOINHERIT,
                  _S_IREAD | _S_IWRITE);
}

std::ptrdiff_t read_at(int descriptor, std::uint64_t place, char* bytes,
                       std::size_t size) noexcept {
  return at(descriptor, place, [&] { return read(descriptor, bytes, size); });
}

std::ptrdiff_t write_at(int descriptor, std::uint64_t place, std::string_view bytes) noexcept {
  return at(descriptor, place, [&] { return write(descriptor, bytes); });
}

int reserve(int descriptor, std::uint64_t size) noexcept {
  return size <= size_of(descriptor) ? 0 : resize(descriptor, size);
}

int prepare(int /*descriptor*/, std::uint64_t /*size*/) noexcept { return 0; }

int allocate(int /*descriptor*/, std::uint64_t /*size*/) noexcept { return 0; }

int resize(int descriptor, std::uint64_t size) noexcept {
  const int error = ::_chsize_s(descriptor, static_cast<std::int64_t>(size));
  errno = error;
  return error == 0 ? 0 : -1;
}

// Far behind all that is read and written: locked bytes cannot be.
bool lock(int descriptor) noexcept {
  constexpr std::uint64_t behind_all = std::uint64_t{1} << 62U;
  return at(descriptor, behind_all, [&] { return ::_locking(descriptor, _LK_NBLCK, 1); }) == 0;
}

int close(int descriptor) noexcept { return ::_close(descriptor); }

std::uint64_t process_number() noexcept { return ::GetCurrentProcessId(); }

}  // namespace rondel::system
