// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file for what does not fit into memory, which stays if the process ends. Numbers are stored as the
// machine has them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

namespace rondel::distributed {

// Every function throws FileError.
class ScratchFile {
 public:
  // Opens the file, or makes it.
  explicit ScratchFile(std::string path);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const;

  // Asks for room on the disk.
  void reserve(std::uint64_t size);
  void cut(std::uint64_t size);
  // Returns whether no other process has locked it.
  [[nodiscard]] bool lock() const;

  // All of them, or an exception: what is not there is an error.
  template <class T>
  void read(std::uint64_t place, std::span<T> values) const {
    static_assert(std::is_trivially_copyable_v<T>);
    read_bytes(place, {reinterpret_cast<char*>(values.data()), values.size_bytes()});
  }
  template <class T>
  void write(std::uint64_t place, std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    write_bytes(place, {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }

 private:
  void read_bytes(std::uint64_t place, std::span<char> bytes) const;
  void write_bytes(std::uint64_t place, std::span<const char> bytes);
  [[noreturn]] void fail(int error) const;

  std::string path_;
  int descriptor_;
};

}  // namespace rondel::distributed
