// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The whole content of a file for reading.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rondel::io {

// A regular file is mapped, so that a large one costs no copy; it must not be cut while it is
// read: then the system sends SIGBUS, whose handler can ask what was read. Anything else (a pipe;
// standard input under the name "-") is read to its end.
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
  std::size_t slot_ = 0;  // in the registry of mapped files
};

// The name of the mapped file in which the address lies; nullptr if it is in none, or in one of
// more files at once than are remembered. For signal handlers.
const char* mapped_file_at(const void* address) noexcept;

}  // namespace rondel::io
