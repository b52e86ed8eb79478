// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Atomic folders on POSIX, and the names in them for signal handlers.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "io/atomic_folder.h"
#include "io/replaced.h"
#include "io/temporary_trees.h"

namespace rondel::io {
namespace {

TemporaryTrees trees;

}  // namespace

TemporaryTrees& temporary_trees() noexcept { return trees; }

std::size_t TemporaryTrees::claim() noexcept {
  for (std::size_t i = 0; i < num_slots; ++i) {
    TreeSlot& slot = slots_[i];
    if (slot.is_claimed.exchange(true)) continue;
    for (NameBlock* block = slot.first; block != nullptr; block = block->next) block->used = 0;
    slot.last = slot.first;
    slot.is_in_use = true;
    return i;
  }
  return num_slots;
}

void TemporaryTrees::add(std::size_t slot, const std::string& path) {
  if (slot == num_slots) return;
  TreeSlot& paths = slots_[slot];
  const std::size_t size = path.size() + 1;
  if (size > std::tuple_size_v<decltype(NameBlock::text)>) return;
  if (paths.last == nullptr || paths.last->used + size > paths.last->text.size()) {
    std::atomic<NameBlock*>& place = paths.last == nullptr ? paths.first : paths.last->next;
    if (place == nullptr) place = new NameBlock;
    paths.last = place;
  }
  std::memcpy(&paths.last->text[paths.last->used], path.c_str(), size);
  paths.last->used += size;
}

void TemporaryTrees::forget(std::size_t slot) noexcept {
  if (slot == num_slots) return;
  slots_[slot].is_in_use = false;
  slots_[slot].is_claimed = false;
}

template <class Visit>
void TemporaryTrees::for_each_path(const TreeSlot& slot, Visit visit) noexcept {
  for (const NameBlock* block = slot.first; block != nullptr; block = block->next) {
    const std::size_t used = block->used;
    for (std::size_t i = 0; i < used; i += std::strlen(&block->text[i]) + 1) visit(&block->text[i]);
  }
}

// Removes the files, then the folders, which are empty then, and at last the outermost one.
void TemporaryTrees::remove(std::size_t slot) const noexcept {
  if (slot == num_slots) return;
  for_each_path(slots_[slot], [](const char* path) { ::unlink(path); });
  for_each_path(slots_[slot], [](const char* path) { ::rmdir(path); });
  const NameBlock* const first = slots_[slot].first;
  if (first != nullptr && first->used != 0) ::rmdir(first->text.data());
}

void TemporaryTrees::remove_all() const noexcept {
  for (std::size_t i = 0; i < num_slots; ++i) {
    if (slots_[i].is_in_use) remove(i);
  }
}

std::string AtomicFolder::resolved(const std::string& path) { return resolve_links(path); }

int AtomicFolder::make_temporary(bool is_private) {
  slot_ = temporary_trees().claim();
  remember(temporary_);
  if (::mkdir(temporary_.c_str(), is_private ? 0700 : 0777) == 0) return 0;
  const int error = errno;
  forget();
  return error;
}

void AtomicFolder::remember(const std::string& path) { temporary_trees().add(slot_, path); }

void AtomicFolder::forget() noexcept {
  temporary_trees().forget(std::exchange(slot_, TemporaryTrees::num_slots));
}

void AtomicFolder::remove_remembered() noexcept { temporary_trees().remove(slot_); }

void AtomicFolder::take_over_permissions() const noexcept {
  struct stat replaced {};
  const int folder = ::open(temporary_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  if (::stat(target_.c_str(), &replaced) == 0) take_permissions(folder, replaced);
  ::close(folder);
}

bool AtomicFolder::exchange(const std::string& a, const std::string& b) noexcept {
#if defined(RENAME_EXCHANGE)
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
#else
  return a == b;
#endif
}

}  // namespace rondel::io
