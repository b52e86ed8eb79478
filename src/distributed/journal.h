// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a run has done, record by record, so that another one can go on. A record is there as a whole or
// not at all.
//
// in    records of words
// out   those that an earlier run wrote
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "distributed/packed_words.h"
#include "distributed/scratch_file.h"

namespace rondel::distributed {

class Journal {
 public:
  // Opens the journal or makes it. Throws FileError if another process has it open, or if it is none.
  explicit Journal(const std::string& path);

  // Those that were there. After the first one that is damaged there are none.
  [[nodiscard]] const std::vector<Words>& records() const { return records_; }

  void append(std::span<const std::uint64_t> words);
  // Forgets all records.
  void clear();

 private:
  [[nodiscard]] bool has_mark(std::uint64_t size) const;

  ScratchFile file_;
  std::vector<Words> records_;
  std::uint64_t end_ = 16;  // behind the mark
};

}  // namespace rondel::distributed
