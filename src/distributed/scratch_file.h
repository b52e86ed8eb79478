// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file for data that does not fit into memory; it remains when the process ends. Numbers are
// stored in the byte order of the machine.
//
// in    values at a byte offset
// out   the same values
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

namespace rondel::distributed {

// Every function throws FileError if the operation fails.
class ScratchFile {
 public:
  // Opens or creates the file.
  explicit ScratchFile(std::string path);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const;

  // Reserves disk space.
  void reserve(std::uint64_t size);
  // Cuts the file to `size` bytes.
  void cut(std::uint64_t size);
  // Locks the file; returns false if another process has locked it.
  [[nodiscard]] bool lock() const;

  // Reads or writes all values at the byte offset `place`. Reading beyond the end of the file is an
  // error.
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
