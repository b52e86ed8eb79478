// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A folder that appears complete or not at all: it is made under a temporary name beside its own,
// and renamed at the end.
//
// in    a path, and files to put into the folder
// out   a folder
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "rondel/export.h"

namespace rondel::io {

// A kind of folder: the files that it may contain.
struct FolderKind {
  // True for names such as "faces" and "faces/c.0.0".
  bool (*is_known)(std::string_view name);
  // Returns why the folder at `path`, all of whose names are known, must not be replaced; empty if
  // it may.
  std::string (*objection)(const std::string& path);
};

// 1. Until commit() returns, `path` is what it was before; after it, the whole new folder. As with
//    AtomicFile, nothing waits for the disk.
// 2. Whatever fails, the temporary folder is removed and FileError names `path` and the reason. A
//    process that is killed leaves the temporary folder, ".rondel-PROCESS-NUMBER.tmp".
// 3. A folder that exists is replaced if all in it is known by its name to be of such a folder; so
//    is an empty one. Whatever else is there is refused, and nothing but what is known is ever
//    removed.
// 4. The permissions of a new folder are 0777 less the umask. One that replaces another has its
//    permissions, owner and group as far as this process may give them, and never more; what is in
//    it is new. On Windows permissions are those that the directory around gives.
class RONDEL_API AtomicFolder {
 public:
  AtomicFolder(const std::string& path, const FolderKind& kind);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  // Makes a folder in the folder; a name such as "faces/part" has slashes on every system.
  void make_folder(const std::string& name);
  // Creates a file and returns its descriptor, which the caller closes.
  int make_file(const std::string& name);
  // Writes a whole file.
  void write_file(const std::string& name, std::string_view bytes);
  // Writes to such a file, and closes it if that fails.
  void write(int& descriptor, std::string_view bytes);

  // Reserves disk space.
  void reserve(std::uint64_t size);
  // Frees reserved space for what is going to be written.
  void release(std::uint64_t size);

  // Gives the folder its name.
  void commit();

  // Throws FileError with the system's reason.
  [[noreturn]] void fail(int error);

 private:
  [[nodiscard]] std::string inside(const std::string& name) const {
    return temporary_ + "/" + name;
  }
  // Throws FileError if what is at `target_` may not be replaced; returns true if there is
  // something.
  bool check_target();
  // Closes the file of reserved space, if there is one.
  void close_room() noexcept;
  // Removes the temporary folder, if it has not been renamed.
  void discard() noexcept;

  // The functions below depend on the system and are defined in one file for each.
  //
  // Returns the path without symbolic links.
  static std::string resolved(const std::string& path);
  // Creates `temporary_`, for its owner alone if it replaces a folder. Returns 0 or the error.
  int make_temporary(bool is_private);
  // Makes signals remove what has this path.
  void remember(const std::string& path);
  // Makes signals remove nothing more.
  void forget() noexcept;
  // Removes what a signal would remove.
  void remove_remembered() noexcept;
  // Gives `temporary_` the owner, group and permissions of `target_`.
  void take_over_permissions() const noexcept;
  // Exchanges the names of two folders at once, if the system can; returns false otherwise.
  static bool exchange(const std::string& a, const std::string& b) noexcept;

  std::string path_;    // as given, for messages
  std::string target_;  // without links and slashes at the end
  std::string temporary_;
  const FolderKind& kind_;
  std::size_t slot_ = 0;
  int room_ = -1;
  std::uint64_t room_size_ = 0;
};

}  // namespace rondel::io
