// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The whole content of a file for reading.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rondel::io {

// A regular file is mapped, so that a large one costs no copy; it must not be cut while it is
// read. Anything else (a pipe; standard input under the name "-") is read to its end.
class FileBytes {
 public:
  // Throws FileError: "stations.csv: No such file or directory".
  explicit FileBytes(const std::string& path);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  // The bytes will be read again, in any order.
  void keep() const noexcept;

  [[nodiscard]] std::string_view text() const noexcept {
    return mapping_ ? std::string_view(static_cast<const char*>(mapping_), size_) : copy_;
  }

 private:
  void* mapping_ = nullptr;
  std::size_t size_ = 0;
  std::string copy_;
};

}  // namespace rondel::io
