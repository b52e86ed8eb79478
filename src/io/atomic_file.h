// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file that appears complete or not at all: it is written without a name or under a temporary
// name in the same directory, and renamed at the end.
//
// in    a path, and the bytes of the file from front to back
// out   a file, or a string in memory
//
// Writers that know the size of their file reserve it first: a full disk is then noticed before the
// work, not after it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "rondel/export.h"
#include "rondel/io.h"

namespace rondel::io {

// Returns a name in a directory ("data/", or empty) that no other thread or process has been given.
RONDEL_API std::string temporary_name(const std::string& directory);

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
//
// A string in memory gets all bytes at once, by commit().
//
// On Windows paths are UTF-8, a symbolic link is replaced itself, a temporary file is deleted by
// the system if its process ends before the renaming, and the permissions of every file are those
// that its directory gives to new files.
class RONDEL_API AtomicFile {
 public:
  explicit AtomicFile(const FileName& file);
  ~AtomicFile();
  // Takes over what the other one has written.
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Appends bytes, by way of a buffer.
  void write(std::string_view bytes);

  // True if bytes can be written at any place: a string, or a file that is not written directly.
  [[nodiscard]] bool has_places() const { return string_ != nullptr || !is_direct(); }
  // Writes bytes at a place, which may lie beyond the end; what is left out has zeros. After the first
  // call write() must not be called. Precondition: has_places().
  void write_at(std::uint64_t place, std::string_view bytes);
  // Makes the file at least so long, with zeros at its end. Precondition: has_places().
  void extend(std::uint64_t size);

  // Reserves disk space for `size` bytes, unless the file is written directly. commit() frees what
  // is not written.
  void reserve(std::uint64_t size);

  // Tells the system the expected size of the file, so that it can allocate the space at once, or
  // report that there is none. The file may become longer or shorter.
  void expect(std::uint64_t size);

  // Flushes, closes and renames the file; or leaves the last two to FilesTogether::commit() if this
  // thread has such an object.
  void commit();

  // Returns the path as it was given, or "<stdout>" for standard output.
  [[nodiscard]] const std::string& path() const { return path_; }

  // True if the file is written directly. Otherwise target() is the file that is replaced, and
  // directory() its directory ("data/", or empty).
  [[nodiscard]] bool is_direct() const { return target_.empty(); }
  [[nodiscard]] const std::string& target() const { return target_; }
  [[nodiscard]] const std::string& directory() const { return directory_; }

 private:
  // Writes what is in the buffer.
  void flush();
  // Writes bytes to the descriptor, whose system may take them in parts.
  void drain(std::string_view bytes);
  // Removes the temporary file and throws FileError with the reason that the system gives for
  // `error`.
  [[noreturn]] void fail(int error);

  // Closes the descriptor; returns 0 or -1, as the system does.
  int close() noexcept;

  // The functions below depend on the system and are defined in one file for each.
  //
  // Opens a file that is written directly, or creates the file that will replace the target.
  void open();
  // Closes the file and gives it its name.
  void rename();
  // Removes a file that has not been renamed, if there is one.
  void discard() noexcept;
  // Creates the file that will become `target_`.
  void create(unsigned permissions);
  // Calls `make` with temporary names until one is new.
  void make_temporary(const std::function<bool(const std::string&)>& make);

  std::string path_;
  std::string* string_;  // null for a file; otherwise all bytes are kept in the buffer
  std::string target_;   // path_ with symbolic links resolved
  std::string directory_;
  std::string temporary_;  // empty when the target is written directly or has no name yet
  bool is_nameless_ = false;
  std::string buffer_;
  std::uint64_t num_drained_ = 0;
  bool is_reserved_ = false;
  std::size_t slot_ = 0;  // slot of `temporary_` in the registry, if it has a name
  int descriptor_ = -1;
};

// --- files that several processes write, so that they need a name while they are written ---

// Returns the file that is replaced: `path`, or the file to which its symbolic links lead.
RONDEL_API std::string replaced_by(const std::string& path);

// Creates an empty file, to be renamed to `target`, with the owner, the group and the permissions
// that an AtomicFile would have. Returns its descriptor; or -1 with the reason in errno, which is
// EEXIST if `temporary` exists. It fails also if `target` may not be written or is not a regular
// file.
RONDEL_API int open_replacement(const std::string& temporary, const std::string& target) noexcept;

}  // namespace rondel::io
