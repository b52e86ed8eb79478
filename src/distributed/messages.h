// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Messages between ranks: plain values and arrays of them, one after the other, after one byte that
// says whether the sender has failed (bsp_session.h). All ranks run the same program on machines of
// one kind.
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

// Builds a message.
class MessageWriter {
 public:
  MessageWriter() : bytes_(1) {}

  void reserve(std::size_t num_bytes) { bytes_.reserve(1 + num_bytes); }

  template <class T>
  void add_value(const T& value) {
    add_values(std::span(&value, 1));
  }

  // Appends values without their count.
  template <class T>
  void add_values(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto bytes = std::as_bytes(values);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  // Appends the count of the values and the values.
  template <class T, class Allocator>
  void add(const std::vector<T, Allocator>& values) {
    add_value<std::uint64_t>(values.size());
    add_values(std::span<const T>(values));
  }

  // Appends `num_bytes` bytes that the caller sets later, in the bytes that take() returns.
  void add_room(std::size_t num_bytes) { bytes_.resize(bytes_.size() + num_bytes); }

  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

// Reads what a MessageWriter wrote. Precondition: the calls are those of the writer, in the same
// order.
class MessageReader {
 public:
  explicit MessageReader(std::span<const std::byte> message)
      : rest_(message.empty() ? message : message.subspan(1)) {}

  [[nodiscard]] bool is_at_end() const { return rest_.empty(); }

  template <class T>
  // Returns the next value.
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
  // Returns the next array, which MessageWriter::add() wrote.
  std::vector<T> values() {
    std::vector<T> result(value<std::uint64_t>());
    read_values(std::span(result));
    return result;
  }

  // Returns the next `num_bytes` bytes, without copying them.
  std::span<const std::byte> skip(std::size_t num_bytes) {
    const auto bytes = rest_.first(num_bytes);
    rest_ = rest_.subspan(num_bytes);
    return bytes;
  }

 private:
  std::span<const std::byte> rest_;
};

}  // namespace rondel::distributed
