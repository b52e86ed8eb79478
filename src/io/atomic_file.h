// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file that appears complete or not at all: it is written without a name, or under a temporary
// one, in the same directory and renamed at the end.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace rondel::io {

// 1. Until commit() returns, `path` is what it was before; after it, the whole new content.
// 2. Whatever fails, the temporary file is removed and FileError names `path` and the reason:
//    "out.geojson: No space left on device".
// 3. A symbolic link stays and its target is replaced. What is not a regular file (a device, a
//    pipe) is written directly.
// 4. The permissions are those of any new file, 0666 less the umask; a write-protected file is
//    refused.
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
  void create(const std::string& directory);
  // Calls `make` with temporary names until one is new.
  void make_temporary(const std::function<bool(const char*)>& make);
  void flush();
  void drain(std::string_view bytes);
  [[noreturn]] void fail(int error);
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
