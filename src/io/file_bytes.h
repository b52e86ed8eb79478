// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The whole content of a file for reading.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "rondel/export.h"
#include "system/huge_pages.h"

namespace rondel::io {

// The file is read in two steps, so that what its head claims can be refused before the rest takes
// time and memory.
class RONDEL_API FileBytes {
 public:
  // Opens the file and reads its head. "-" is standard input. Throws FileError:
  // "stations.csv: No such file or directory", "stations.csv: compressed (gzip); unpack it first".
  explicit FileBytes(const std::string& path, bool may_be_zip = false);

  // The file in messages.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  // Whether the name is that of a file, which others can open.
  [[nodiscard]] bool has_path() const noexcept { return descriptor_.value > 0; }
  // The first bytes: 128 KiB, those that were asked for, or all.
  [[nodiscard]] std::string_view head() const noexcept { return {bytes_.get(), num_read_}; }
  // The number of bytes as the system tells it; 0 if it does not know.
  [[nodiscard]] std::uint64_t claimed_size() const noexcept { return claimed_size_; }

  // All bytes. Throws FileError.
  std::string_view text();
  // Returns at least so many of the first bytes, or all. Throws FileError.
  std::string_view longer_head(std::size_t size);

  // Bytes of a file of known size, from this place on, without those before; several threads may ask.
  // Throws FileError, also where the file has ended by now.
  void read_at(std::uint64_t place, char* bytes, std::size_t size) const;

 private:
  struct Descriptor {
    int value;
    explicit Descriptor(int descriptor) : value(descriptor) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor();
  };

  void grow(std::size_t capacity);
  void read_up_to(std::size_t size);
  [[noreturn]] void fail(int error) const;

  std::string name_;
  Descriptor descriptor_;
  std::uint64_t claimed_size_ = 0;
  system::LargeArray<char> bytes_;
  std::size_t num_read_ = 0;
  bool is_at_end_ = false;
};

}  // namespace rondel::io
