// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Names for a signal handler, which may touch neither the heap nor a lock: in fixed buffers.
#pragma once

#include <array>
#include <atomic>
#include <climits>
#include <cstddef>
#include <cstring>
#include <string>

namespace rondel::io {

// A slot goes free -> claimed -> in_use -> free; a handler reads slots in use only, which do not
// change. What finds no free slot is not known to handlers.
template <std::size_t num_slots>
class SignalSlots {
 public:
  struct Slot {
    std::array<char, PATH_MAX> name = {};
    const char* begin = nullptr;  // of memory that belongs to the name
    const char* end = nullptr;
  };

  // Returns the number of the slot, for forget().
  std::size_t remember(const std::string& name, const char* begin = nullptr,
                       const char* end = nullptr) noexcept {
    if (name.size() >= PATH_MAX) return num_slots;
    for (std::size_t i = 0; i < num_slots; ++i) {
      State expected = State::free;
      if (!states_[i].compare_exchange_strong(expected, State::claimed)) continue;
      std::memcpy(slots_[i].name.data(), name.c_str(), name.size() + 1);
      slots_[i].begin = begin;
      slots_[i].end = end;
      states_[i].store(State::in_use);
      return i;
    }
    return num_slots;
  }

  void forget(std::size_t slot) noexcept {
    if (slot < num_slots) states_[slot].store(State::free);
  }

  // The first slot in use for which `is_wanted`; nullptr if there is none.
  template <class IsWanted>
  [[nodiscard]] const Slot* find(const IsWanted& is_wanted) const noexcept {
    for (std::size_t i = 0; i < num_slots; ++i) {
      if (states_[i].load() == State::in_use && is_wanted(slots_[i])) return &slots_[i];
    }
    return nullptr;
  }

 private:
  enum class State : int { free, claimed, in_use };
  static_assert(std::atomic<State>::is_always_lock_free);

  std::array<std::atomic<State>, num_slots> states_ = {};
  std::array<Slot, num_slots> slots_ = {};
};

}  // namespace rondel::io
