// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A folder that appears complete or not at all: it is made under a temporary name beside its own and
// renamed at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "rondel/export.h"

namespace rondel::io {

// What a folder of some kind may have in it.
struct FolderKind {
  // Of "faces", "faces/c.0.0".
  bool (*is_known)(std::string_view name);
  // Empty, or why the folder at `path`, where all is known, must stay.
  std::string (*objection)(const std::string& path);
};

// 1. Until commit() returns, `path` is what it was before; after it, the whole new folder. As with
//    AtomicFile, nothing waits for the disk.
// 2. Whatever fails, the temporary folder is removed and FileError names `path` and the reason. A
//    process that is killed leaves the temporary folder, ".rondel-PROCESS-NUMBER.tmp".
// 3. A folder that exists is replaced if all in it is known by its name to be of such a folder; so is
//    an empty one. Whatever else is there is refused, and nothing but what is known is ever removed.
// 4. The permissions of a new folder are 0777 less the umask. One that replaces another has its
//    permissions, owner and group as far as this process may give them, and never more; what is in
//    it is new. On Windows permissions are those that the directory around gives.
class RONDEL_API AtomicFolder {
 public:
  AtomicFolder(const std::string& path, const FolderKind& kind);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  void make_folder(const std::string& name);
  // A file that can be written, to be closed by the caller.
  int make_file(const std::string& name);
  void write_file(const std::string& name, std::string_view bytes);
  // Writes to such a file, which is closed if that fails.
  void write(int& descriptor, std::string_view bytes);

  // Asks for room on the disk for so many bytes.
  void reserve(std::uint64_t size);
  // Gives back room for what is going to be written.
  void release(std::uint64_t size);

  void commit();

  // Ends all with what the system says.
  [[noreturn]] void fail(int error);

 private:
  [[nodiscard]] std::string inside(const std::string& name) const {
    return temporary_ + "/" + name;
  }
  // Throws FileError if what is at `target_` may not be replaced; says whether there is something.
  bool check_target();
  void close_room() noexcept;
  void discard() noexcept;

  // What depends on the system, in a file for each.
  //
  // The path without links.
  static std::string resolved(const std::string& path);
  // Makes `temporary_`; for its owner alone if it replaces something. Returns 0 or the error.
  int make_temporary(bool is_private);
  // From now on signals remove what has this path.
  void remember(const std::string& path);
  void forget() noexcept;
  // Does what a signal would do.
  void remove_remembered() noexcept;
  // Gives `temporary_` what it takes over from `target_`.
  void take_over_permissions() const noexcept;
  // Lets the two change their names at once, if the system can.
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
