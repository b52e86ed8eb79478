// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Atomic files on Windows. A temporary file is marked to be deleted when it is closed, which the
// system also does when the process ends in any way; the mark is removed before the file is
// renamed.
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cerrno>
#include <system_error>

#include "io/atomic_file.h"
#include "rondel/io.h"
#include "system/descriptor.h"
#include "system/wide_path.h"

namespace rondel::io {
namespace {

using system::wide_path;

// Returns the errno that corresponds to the last error of the system.
int last_error() {
  const std::error_code code(static_cast<int>(::GetLastError()), std::system_category());
  const std::error_condition condition = code.default_error_condition();
  return condition.category() == std::generic_category() ? condition.value() : EIO;
}

// Sets or removes the mark; returns false if the system refuses.
bool mark_to_delete(HANDLE file, bool is_to_delete) {
  FILE_DISPOSITION_INFO information{};
  information.DeleteFile = is_to_delete ? TRUE : FALSE;
  return ::SetFileInformationByHandle(file, FileDispositionInfo, &information,
                                      sizeof information) != 0;
}

// Returns the system's handle of a descriptor of the C library.
HANDLE handle_of(int descriptor) {
  return reinterpret_cast<HANDLE>(
      ::_get_osfhandle(descriptor));  // NOLINT(performance-no-int-to-ptr)
}

// True for a device or a pipe.
bool is_written_directly(const std::wstring& name) {
  constexpr DWORD all_may_share = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  const HANDLE file =
      ::CreateFileW(name.c_str(), 0, all_may_share, nullptr, OPEN_EXISTING, 0, nullptr);
  if (file == INVALID_HANDLE_VALUE) return false;
  const DWORD type = ::GetFileType(file);
  ::CloseHandle(file);
  return type == FILE_TYPE_CHAR || type == FILE_TYPE_PIPE;
}

}  // namespace

std::string replaced_by(const std::string& path) { return path; }

int open_replacement(const std::string& temporary, const std::string& /*target*/) noexcept {
  const int descriptor = system::open_to_change(temporary);
  if (descriptor >= 0 && system::resize(descriptor, 0) != 0) {
    const int error = errno;
    system::close(descriptor);
    errno = error;
    return -1;
  }
  return descriptor;
}

void AtomicFile::open() {
  const std::wstring name = wide_path(path_);
  const DWORD attributes = ::GetFileAttributesW(name.c_str());
  const bool exists = attributes != INVALID_FILE_ATTRIBUTES;
  if (!exists && ::GetLastError() != ERROR_FILE_NOT_FOUND) fail(last_error());
  if (exists && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) fail(EISDIR);
  if (exists && (attributes & FILE_ATTRIBUTE_READONLY) != 0) fail(EACCES);
  if (exists && is_written_directly(name)) {
    descriptor_ = ::_wopen(name.c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  target_ = path_;
  directory_ = target_.substr(0, target_.find_last_of("/\\:") + 1);
  create(0);
}

void AtomicFile::create(unsigned /*permissions*/) {
  HANDLE file = INVALID_HANDLE_VALUE;
  make_temporary([&](const std::string& name) {
    file = ::CreateFileW(wide_path(name).c_str(), GENERIC_WRITE | DELETE,
                         FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr, CREATE_NEW,
                         FILE_ATTRIBUTE_NORMAL, nullptr);
    return file != INVALID_HANDLE_VALUE;
  });
  // If the file system has no such marks, discard() deletes the file.
  mark_to_delete(file, true);
  descriptor_ = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(file), _O_BINARY | _O_NOINHERIT);
  if (descriptor_ >= 0) return;
  ::CloseHandle(file);
  fail(EMFILE);
}

void AtomicFile::make_temporary(const std::function<bool(const std::string&)>& make) {
  for (;;) {
    temporary_ = temporary_name(directory_);
    if (make(temporary_)) return;
    temporary_.clear();
    if (::GetLastError() != ERROR_FILE_EXISTS) fail(last_error());
  }
}

void AtomicFile::rename() {
  if (!temporary_.empty()) mark_to_delete(handle_of(descriptor_), false);
  if (close() != 0) fail(errno);
  if (temporary_.empty()) return;
  if (::MoveFileExW(wide_path(temporary_).c_str(), wide_path(target_).c_str(),
                    MOVEFILE_REPLACE_EXISTING) == 0) {
    fail(last_error());
  }
  temporary_.clear();
}

void AtomicFile::discard() noexcept {
  close();
  if (temporary_.empty()) return;
  ::DeleteFileW(wide_path(temporary_).c_str());
  temporary_.clear();
}

}  // namespace rondel::io

namespace rondel {

// There is nothing to do, since the system deletes the files.
void remove_temporaries() noexcept {}

}  // namespace rondel
