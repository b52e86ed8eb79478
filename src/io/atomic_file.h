// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file that appears complete or not at all: it is written without a name, or under a temporary
// one, in the same directory and renamed at the end.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

struct stat;

namespace rondel::io {

// 1. Until commit() returns, `path` is what it was before; after it, the whole new content. Nothing
//    waits for the disk: a power failure soon after commit() may leave the file cut or empty.
// 2. Whatever fails, the temporary file is removed and FileError names `path` and the reason:
//    "out.geojson: No space left on device". A process that is killed leaves a temporary file only
//    if that happens between its naming and its renaming, or if the file system has no files
//    without a name.
// 3. A symbolic link stays and its target is replaced, or made where there is none. Other names of
//    the target (hard links) keep the old content. What is not a regular file (a device, a pipe)
//    and standard output ("-") are written directly.
// 4. The permissions of a new file are 0666 less the umask. A file that replaces another one has
//    its permissions, owner and group as far as this process may give them, and never more than
//    those permissions; where the group cannot be kept, its rights are those of others. A file that
//    this process may not write is refused.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Appends to the content; buffered.
  void write(std::string_view bytes);

  // Flushes, closes and renames.
  void commit();

 private:
  void create(mode_t mode);
  void take_permissions(const struct stat& replaced);
  // Calls `make` with temporary names until one is new.
  void make_temporary(const std::function<bool(const char*)>& make);
  void flush();
  void drain(std::string_view bytes);
  [[noreturn]] void fail(int error);
  int close() noexcept;
  void discard() noexcept;

  std::string path_;
  std::string target_;  // path_ with symbolic links resolved
  std::string directory_;
  std::string temporary_;  // empty when the target is written directly or has no name yet
  bool is_nameless_ = false;
  std::string buffer_;
  std::size_t slot_;  // in the registry of temporaries
  int descriptor_ = -1;
};

}  // namespace rondel::io
