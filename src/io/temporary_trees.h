// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// POSIX: the names in temporary folders, for signal handlers, which may touch neither the heap nor a lock.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <string>

namespace rondel::io {

// A slot goes free -> in_use -> free and keeps its memory; handlers read slots in use, to which names
// are only added.
class TemporaryTrees {
 public:
  // A folder that finds no free slot is not removed by a signal.
  static constexpr std::size_t num_slots = 4;

  // Returns the number of a slot, for the others.
  std::size_t claim() noexcept;
  // The path of a file or folder that will be made; the outermost folder first. Throws bad_alloc.
  void add(std::size_t slot, const std::string& path);
  void forget(std::size_t slot) noexcept;
  // Removes all that was added, without memory.
  void remove(std::size_t slot) const noexcept;
  void remove_all() const noexcept;

 private:
  // Paths, each with a zero behind it.
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
