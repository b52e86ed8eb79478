// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The record of what a run has done, so that another run can resume it. A record is present as a
// whole or not at all.
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
  // Opens or creates the journal. Throws FileError if another process has it open, or if the file
  // is no journal.
  explicit Journal(const std::string& path);

  // Returns the records that the journal had when it was opened, up to the first damaged one.
  [[nodiscard]] const std::vector<Words>& records() const { return records_; }

  // Appends a record.
  void append(std::span<const std::uint64_t> words);
  // Forgets all records.
  void clear();

 private:
  // True if the file begins like a journal.
  [[nodiscard]] bool has_mark(std::uint64_t size) const;

  ScratchFile file_;
  std::vector<Words> records_;
  std::uint64_t end_ = 16;  // after the mark
};

}  // namespace rondel::distributed
