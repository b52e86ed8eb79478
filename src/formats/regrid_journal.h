// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The record of the values that a regridding has written, in a file beside its output, so that
// another run goes on where a killed one stopped.
//
// in    what the run is about, and values as they are computed
// out   the values of an earlier run about the same
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rondel::formats {

// One thing that must be the same if a run is to be resumed: "method", "linear".
struct JournalFact {
  std::string what;
  std::string value;
};

// The file has a line for each fact, and then records: the number of values, their checksum, and
// the values. A process that is killed may leave a part of a record, which is dropped.
class RegridJournal {
 public:
  // Opens or creates the journal. Throws FileError if another process has it open, if the file is
  // no journal, or if it is that of a run about something else, with the first fact that differs.
  RegridJournal(std::string path, const std::vector<JournalFact>& about);
  RegridJournal(const RegridJournal&) = delete;
  RegridJournal& operator=(const RegridJournal&) = delete;
  ~RegridJournal();

  // Returns the number of values of the earlier run that have not been read.
  [[nodiscard]] std::uint64_t num_left() const { return num_left_; }
  // Reads the next values. Precondition: there are as many.
  void read(std::span<double> out);
  // Appends values. Those of the earlier run that have not been read are dropped.
  void append(std::span<const double> values);
  // Removes the file.
  void remove();

 private:
  struct RegridRecord {
    std::uint64_t begin;  // the place of its values in the file
    std::uint64_t num_values;
  };

  void open();
  // Reads the head of the file, and writes it if there is none.
  void require_head(const std::vector<JournalFact>& about);
  // Finds the whole records.
  void find_records();
  // Cuts the file behind what has been read.
  void drop_unread();
  void append_record(std::span<const double> values);
  void read_bytes(std::uint64_t place, void* bytes, std::size_t size) const;
  void write_bytes(const void* bytes, std::size_t size);
  [[noreturn]] void fail(int error) const;

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t end_ = 0;  // where the next record is written
  std::vector<RegridRecord> records_;
  std::size_t current_ = 0;     // the record that is read next
  std::uint64_t num_read_ = 0;  // values of it that have been read
  std::uint64_t num_left_ = 0;
};

}  // namespace rondel::formats
