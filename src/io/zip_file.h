// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes zip archives of uncompressed members from front to back (PKWARE's APPNOTE 6.3.9).
//
// in    names and contents of members
// out   a file
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"

namespace rondel::io {

// Equal members give equal bytes, since the date is always January 1, 1980. Members and archives of
// 4 GiB and more use the zip64 fields.
class ZipWriter {
 public:
  explicit ZipWriter(AtomicFile& file) : file_(file) {}

  // Adds a member whose content is `head` followed by `body`.
  void add(const std::string& name, std::string_view head, std::string_view body);

  // Writes the directory; nothing may follow.
  void finish();

 private:
  // A member, as the directory at the end describes it.
  struct Member {
    std::string name;
    std::uint32_t checksum;
    std::uint64_t size;
    std::uint64_t offset;
  };

  void write(std::string_view bytes);

  AtomicFile& file_;
  std::uint64_t position_ = 0;
  std::vector<Member> members_;
};

}  // namespace rondel::io
