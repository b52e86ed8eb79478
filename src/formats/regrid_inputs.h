// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The files that a regridding reads: that its output is none of them, and that nobody changes them
// meanwhile.
#pragma once

#include <string>
#include <vector>

#include "formats/regrid_journal.h"
#include "rondel/io.h"

namespace rondel::formats {

// A file as it is at a time: its size, when it was changed, and what it begins with.
struct FileState {
  std::string role;  // "input", "target", "source"
  std::string path;
  std::string text;
};

class RegridInputs {
 public:
  // Notes the state of a file. Names of grids, strings in memory and pipes have none.
  void add(const std::string& role, const FileName& file);
  // Throws FileError if the output is one of the files.
  void require_other(const FileName& out) const;
  // Throws FileError if one of the files is not what it was when it was added.
  void require_unchanged() const;
  // Returns a fact for each file.
  [[nodiscard]] std::vector<JournalFact> facts() const;
  // True if there is a file with this role.
  [[nodiscard]] bool has(const std::string& role) const;

 private:
  std::vector<FileState> files_;
};

}  // namespace rondel::formats
