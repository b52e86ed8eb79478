// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Atomic files on POSIX, which have no name while they are written if the system can do that
// (Linux).
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "io/atomic_file.h"
#include "rondel/error.h"
#include "rondel/io.h"

namespace rondel::io {
namespace {

// The names of temporary files for signal handlers, which may use neither the heap nor a lock. A
// slot goes from free to claimed, in_use and back to free; handlers read slots in use, which do not
// change.
class Temporaries {
 public:
  // If no slot is free, a signal does not remove the file.
  static constexpr std::size_t num_slots = 8;

  // Returns the number of the slot, for forget().
  std::size_t remember(const std::string& name) noexcept {
    if (name.size() >= PATH_MAX) return num_slots;
    for (std::size_t i = 0; i < num_slots; ++i) {
      State expected = State::free;
      if (!states_[i].compare_exchange_strong(expected, State::claimed)) continue;
      std::memcpy(names_[i].data(), name.c_str(), name.size() + 1);
      states_[i].store(State::in_use);
      return i;
    }
    return num_slots;
  }

  // Frees a slot.
  void forget(std::size_t slot) noexcept {
    if (slot < num_slots) states_[slot].store(State::free);
  }

  // Removes the files of all slots; signal handlers call it.
  void remove_all() const noexcept {
    for (std::size_t i = 0; i < num_slots; ++i) {
      if (states_[i].load() == State::in_use) ::unlink(names_[i].data());
    }
  }

 private:
  enum class State : int { free, claimed, in_use };
  static_assert(std::atomic<State>::is_always_lock_free);

  std::array<std::atomic<State>, num_slots> states_ = {};
  std::array<std::array<char, PATH_MAX>, num_slots> names_ = {};
};

Temporaries temporaries;

// Returns the path of the file of that name with symbolic links resolved; the file need not exist.
std::string resolve_links(const std::string& path) {
  constexpr int max_links = 40;  // Linux follows as many
  std::filesystem::path target = path;
  std::error_code error;
  for (int i = 0; i < max_links && std::filesystem::is_symlink(target, error); ++i) {
    target = target.parent_path() / std::filesystem::read_symlink(target, error);
    if (error) return path;
  }
  return target;
}

// Gives an open file the owner, group and permissions of the file that it replaces, as far as this
// process may. It was created for its owner alone, so that it never has more permissions than it
// should. If the file system has no permissions, nothing is lost when it refuses to set them.
void take_permissions(int descriptor, const struct stat& replaced) {
  constexpr auto same_owner = static_cast<uid_t>(-1);
  mode_t mode = replaced.st_mode & 0777U;
  if (::fchown(descriptor, replaced.st_uid, replaced.st_gid) != 0 &&
      ::fchown(descriptor, same_owner, replaced.st_gid) != 0) {
    mode &= 0707U | (mode & 07U) << 3U;  // this process has another group
  }
  static_cast<void>(::fchmod(descriptor, mode));
}

}  // namespace

std::string replaced_by(const std::string& path) { return resolve_links(path); }

// Permissions of a file that is replaced are given to the new one before anything is written.
int open_replacement(const std::string& temporary, const std::string& target) noexcept {
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists) {
    if (::access(target.c_str(), W_OK) != 0) return -1;
    if (!S_ISREG(status.st_mode)) {
      errno = S_ISDIR(status.st_mode) ? EISDIR : EOPNOTSUPP;
      return -1;
    }
  }
  const mode_t mode = exists ? 0600 : 0666;
  const int descriptor = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (exists && descriptor >= 0) take_permissions(descriptor, status);
  return descriptor;
}

void AtomicFile::open() {
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail(errno);
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && ::access(path_.c_str(), W_OK) != 0) fail(errno);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  target_ = resolve_links(path_);
  directory_ = target_.substr(0, target_.rfind('/') + 1);
  create(exists ? 0600 : 0666);
  if (exists) take_permissions(descriptor_, status);
}

void AtomicFile::create(unsigned permissions) {
  const auto mode = static_cast<mode_t>(permissions);
#if defined(O_TMPFILE)
  // The file has no name, so that not even a killed process leaves it; some file systems cannot do
  // that.
  if (::access("/proc/self/fd", X_OK) == 0) {
    descriptor_ = ::open(directory_.empty() ? "." : directory_.c_str(),
                         O_WRONLY | O_TMPFILE | O_CLOEXEC, mode);
    is_nameless_ = descriptor_ >= 0;
  }
  if (is_nameless_) return;
#endif
  make_temporary([&](const std::string& name) {
    descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    return descriptor_ >= 0;
  });
}

void AtomicFile::make_temporary(const std::function<bool(const std::string&)>& make) {
  for (;;) {
    temporary_ = temporary_name(directory_);
    slot_ = temporaries.remember(temporary_);
    if (make(temporary_)) return;
    const int error = errno;
    temporaries.forget(slot_);
    temporary_.clear();
    if (error != EEXIST) fail(error);
  }
}

void AtomicFile::rename() {
  if (is_nameless_) {
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor_);
    make_temporary([&](const std::string& name) {
      return ::linkat(AT_FDCWD, link.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
    });
  }
  if (close() != 0) fail(errno);
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporaries.forget(slot_);
  temporary_.clear();
}

void AtomicFile::discard() noexcept {
  close();
  if (temporary_.empty()) return;
  ::unlink(temporary_.c_str());
  temporaries.forget(slot_);
  temporary_.clear();
}

}  // namespace rondel::io

namespace rondel {

void remove_temporaries() noexcept { io::temporaries.remove_all(); }

}  // namespace rondel
