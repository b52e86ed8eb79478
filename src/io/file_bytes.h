// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The whole content of a file for reading.
//
// in    a path, "-" for standard input, or a string in memory
// out   bytes
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "rondel/io.h"
#include "system/large_arrays.h"

namespace rondel::io {

// Throws FileError if a path is that of a pipe, for what reads a file more than once: it would wait
// forever for another writer.
void require_no_pipe(const std::string& path);

// A file that is read in two steps, so that false claims in its header can be refused before the
// rest takes time and memory.
class FileBytes {
 public:
  // Opens the file and reads its head. "-" is standard input. Throws FileError:
  // "stations.csv: No such file or directory", "stations.csv: compressed (gzip); unpack it first".
  explicit FileBytes(const FileName& file, bool may_be_zip = false);

  // Returns the name of the file for messages.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  // True if the file has a name by which others can open it.
  [[nodiscard]] bool has_path() const noexcept { return descriptor_.value > 0; }
  // Returns the first bytes: 128 KiB, as many as longer_head() has read, or all.
  [[nodiscard]] std::string_view head() const noexcept { return {bytes_.get(), num_read_}; }
  // Returns the size of the file as the system reports it; 0 if it is not known.
  [[nodiscard]] std::uint64_t claimed_size() const noexcept { return claimed_size_; }

  // Reads and returns all bytes. Throws FileError if reading fails.
  std::string_view text();
  // Returns at least `size` of the first bytes, or all. Throws FileError if reading fails.
  std::string_view longer_head(std::size_t size);

  // Reads `size` bytes at `place` of a file of known size, without those before; several threads
  // may call it. Throws FileError if reading fails or the file has become shorter.
  void read_at(std::uint64_t place, char* bytes, std::size_t size) const;

 private:
  struct Descriptor {
    int value;
    explicit Descriptor(int descriptor) : value(descriptor) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor();
  };

  // Makes room for `capacity` bytes and reads them.
  void grow(std::size_t capacity);
  void read_up_to(std::size_t size);
  // Opens what the path names and reads its head.
  void open(const std::string& path);
  [[noreturn]] void fail(int error) const;

  std::string name_;
  Descriptor descriptor_;
  std::uint64_t claimed_size_ = 0;
  system::LargeArray<char> bytes_;
  std::size_t num_read_ = 0;
  bool is_at_end_ = false;
};

}  // namespace rondel::io
