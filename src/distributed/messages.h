// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What ranks tell each other: plain values and arrays of them, one after the other, behind one byte that
// says how the sender is (supersteps.h). Ranks run the same program on machines of one kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "rondel/distributed.h"

namespace rondel::distributed {

using Bytes = Communicator::Bytes;

class MessageWriter {
 public:
  MessageWriter() : bytes_(1) {}

  void reserve(std::size_t num_bytes) { bytes_.reserve(1 + num_bytes); }

  template <class T>
  void add_value(const T& value) {
    add_values(std::span(&value, 1));
  }

  // Without their number.
  template <class T>
  void add_values(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto bytes = std::as_bytes(values);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  // The number of values comes first.
  template <class T, class Allocator>
  void add(const std::vector<T, Allocator>& values) {
    add_value<std::uint64_t>(values.size());
    add_values(std::span<const T>(values));
  }

  // To be written later, from take() on.
  void add_room(std::size_t num_bytes) { bytes_.resize(bytes_.size() + num_bytes); }

  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

// Reads what a writer wrote. Precondition: the calls are those of the writer.
class MessageReader {
 public:
  explicit MessageReader(std::span<const std::byte> message)
      : rest_(message.empty() ? message : message.subspan(1)) {}

  [[nodiscard]] bool is_at_end() const { return rest_.empty(); }

  template <class T>
  T value() {
    T value{};
    read_values(std::span(&value, 1));
    return value;
  }

  template <class T>
  void read_values(std::span<T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (!values.empty()) {
      std::memcpy(static_cast<void*>(values.data()), skip(values.size_bytes()).data(),
                  values.size_bytes());
    }
  }

  template <class T>
  std::vector<T> values() {
    std::vector<T> result(value<std::uint64_t>());
    read_values(std::span(result));
    return result;
  }

  // So many bytes, which are not copied.
  std::span<const std::byte> skip(std::size_t num_bytes) {
    const auto bytes = rest_.first(num_bytes);
    rest_ = rest_.subspan(num_bytes);
    return bytes;
  }

 private:
  std::span<const std::byte> rest_;
};

}  // namespace rondel::distributed
