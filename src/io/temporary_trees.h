// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The names in temporary folders, for signal handlers on POSIX, which may use neither the heap nor
// a lock.
//
// in    paths of folders and files, before they are created
// out   their removal when a signal ends the process
// index slots, one for each folder that is being written
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <string>

namespace rondel::io {

// A slot goes from free to in_use and back, and keeps its memory. Handlers read slots in use, to
// which names are only added.
class TemporaryTrees {
 public:
  // If no slot is free, a signal does not remove the folder.
  static constexpr std::size_t num_slots = 4;

  // Returns the number of a slot, which the other functions need.
  std::size_t claim() noexcept;
  // Adds the path of a file or folder that will be created; the outermost folder comes first.
  // Throws bad_alloc.
  void add(std::size_t slot, const std::string& path);
  // Frees a slot, whose files are then kept.
  void forget(std::size_t slot) noexcept;
  // Removes all files and folders that were added, without allocating memory.
  void remove(std::size_t slot) const noexcept;
  void remove_all() const noexcept;

 private:
  // Paths, each ending with a zero byte.
  struct NameBlock {
    std::atomic<std::size_t> used{0};
    std::atomic<NameBlock*> next{nullptr};
    std::array<char, std::size_t{1} << 16U> text;
  };
  struct TreeSlot {
    std::atomic<bool> is_claimed{false};
    std::atomic<bool> is_in_use{false};
    std::atomic<NameBlock*> first{nullptr};
    NameBlock* last = nullptr;
  };
  static_assert(std::atomic<NameBlock*>::is_always_lock_free &&
                std::atomic<std::size_t>::is_always_lock_free);

  template <class Visit>
  static void for_each_path(const TreeSlot& slot, Visit visit) noexcept;

  std::array<TreeSlot, num_slots> slots_;
};

TemporaryTrees& temporary_trees() noexcept;

}  // namespace rondel::io
