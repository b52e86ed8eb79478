// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_folder.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "io/atomic_file.h"
#include "rondel/error.h"
#include "system/descriptor.h"

namespace rondel::io {
namespace {

namespace fs = std::filesystem;

// The file in the folder whose space is reserved for the others.
constexpr const char* room_name = "room";

// A file, folder or link in a folder.
struct FolderEntry {
  std::string name;  // path within the folder, with slashes
  bool is_folder = false;
  bool is_file = false;
};

// Returns everything in the folder; a folder comes before its content, otherwise names are sorted.
// Symbolic links are not followed.
std::vector<FolderEntry> content_of(const std::string& path, std::error_code& error) {
  std::vector<FolderEntry> content;
  fs::recursive_directory_iterator at(path, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    const fs::file_status status = at->symlink_status(error);
    if (error) break;
    content.push_back({at->path().lexically_relative(path).generic_string(),
                       fs::is_directory(status), fs::is_regular_file(status)});
  }
  std::ranges::sort(content, {}, &FolderEntry::name);
  return content;
}

// Removes the known files, and folders that are empty then.
void remove_known(const std::string& path, const FolderKind& kind) {
  std::error_code ignored;
  std::vector<FolderEntry> content = content_of(path, ignored);
  std::ranges::reverse(content);
  for (const FolderEntry& found : content) {
    const bool is_ours = kind.is_known(found.name) || found.name == room_name;
    if (is_ours && (found.is_file || found.is_folder)) fs::remove(path + "/" + found.name, ignored);
  }
  fs::remove(path, ignored);
}

// Returns the number that the system has for the error.
int number_of(const std::error_code& error) { return error.default_error_condition().value(); }

// Returns the path without slashes at its end.
std::string without_slashes(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

}  // namespace

AtomicFolder::AtomicFolder(const std::string& path, const FolderKind& kind)
    : path_(path), target_(resolved(without_slashes(path))), kind_(kind) {
  const bool is_private = check_target();
  int error = EEXIST;
  while (error == EEXIST) {
    temporary_ = temporary_name(target_.substr(0, target_.find_last_of("/\\") + 1));
    error = make_temporary(is_private);
  }
  if (error == 0) return;
  temporary_.clear();
  fail(error);
}

AtomicFolder::~AtomicFolder() { discard(); }

bool AtomicFolder::check_target() {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (status.type() == fs::file_type::not_found) {
    if (error && error != std::errc::no_such_file_or_directory) fail(number_of(error));
    return false;
  }
  if (error) fail(number_of(error));
  if (!fs::is_directory(status)) throw FileError(path_ + ": a file, where a folder is to be made");
  const std::vector<FolderEntry> content = content_of(target_, error);
  if (error) fail(number_of(error));
  for (const FolderEntry& found : content) {
    if (kind_.is_known(found.name) && (found.is_file || found.is_folder)) continue;
    throw FileError(path_ + ": '" + found.name + "' in it is not ours; the folder is not replaced");
  }
  const std::string objection = content.empty() ? std::string() : kind_.objection(target_);
  if (!objection.empty())
    throw FileError(path_ + ": " + objection + "; the folder is not replaced");
  return true;
}

void AtomicFolder::make_folder(const std::string& name) {
  const std::string path = inside(name);
  remember(path);
  std::error_code error;
  fs::create_directory(path, error);
  if (error) fail(number_of(error));
}

int AtomicFolder::make_file(const std::string& name) {
  const std::string path = inside(name);
  remember(path);
  const int descriptor = system::open_to_change(path);
  if (descriptor < 0) fail(errno);
  return descriptor;
}

void AtomicFolder::write_file(const std::string& name, std::string_view bytes) {
  int descriptor = make_file(name);
  write(descriptor, bytes);
  if (system::close(descriptor) != 0) fail(errno);
}

void AtomicFolder::write(int& descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t count = system::write(descriptor, bytes);
    if (count < 0) {
      const int error = errno;
      system::close(std::exchange(descriptor, -1));
      fail(error);
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

// The reserved space is a file in the folder, which is shortened while others are written.
void AtomicFolder::reserve(std::uint64_t size) {
  if (size == 0) return;
  if (room_ < 0) room_ = make_file(room_name);
  room_size_ += size;
  if (system::reserve(room_, room_size_) != 0) fail(errno);
}

void AtomicFolder::release(std::uint64_t size) {
  if (room_ < 0) return;
  room_size_ -= std::min(room_size_, size);
  if (system::resize(room_, room_size_) != 0) fail(errno);
}

void AtomicFolder::close_room() noexcept {
  if (room_ >= 0) system::close(std::exchange(room_, -1));
}

// Checks again what is replaced, as it may have changed.
void AtomicFolder::commit() {
  std::error_code error;
  close_room();
  fs::remove(inside(room_name), error);
  if (!check_target()) {
    fs::rename(temporary_, target_, error);
    if (error) fail(number_of(error));
    forget();
    temporary_.clear();
    return;
  }
  take_over_permissions();
  if (!exchange(temporary_, target_)) {
    const std::string old = temporary_ + "-old";
    fs::rename(target_, old, error);
    if (error) fail(number_of(error));
    fs::rename(temporary_, target_, error);
    if (error) {
      std::error_code ignored;
      fs::rename(old, target_, ignored);
      fail(number_of(error));
    }
    temporary_ = old;
  }
  discard();  // removes the folder that was replaced
}

void AtomicFolder::discard() noexcept {
  if (temporary_.empty()) return;
  close_room();
  try {
    remove_known(temporary_, kind_);
  } catch (...) {  // there is no memory for the names
    remove_remembered();
  }
  forget();
  temporary_.clear();
}

void AtomicFolder::fail(int error) {
  discard();
  throw FileError(path_, std::error_code(error, std::generic_category()));
}

}  // namespace rondel::io
