// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a regridding writes: the file of fields, and where a run may be resumed the journal of its
// values. Of several processes one writes.
//
// in    values in the order of the file
// out   a file that appears when it is complete
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/regrid_journal.h"
#include "rondel/fields.h"

namespace rondel::formats {

class RegridOutput {
 public:
  // The output of a process that does not write. Nothing is written to it.
  RegridOutput() = default;
  RegridOutput(const FileName& file, const FieldSet& fields, const WeightSide& points,
               const NetcdfOptions& netcdf, const Execution& execution) {
    writer_.emplace(file, fields, points, netcdf, execution);
  }

  // Keeps values in a journal beside the output from now on.
  void keep(const std::string& path, const std::vector<JournalFact>& about);
  // The number of values that an earlier run has left in the journal, which come first.
  [[nodiscard]] std::uint64_t num_kept() const { return num_kept_; }
  // Says the same number to a process that does not write.
  void set_num_kept(std::uint64_t number) { num_kept_ = number; }

  // Writes so many values of the earlier run and returns true, or returns false if it has left
  // fewer; then it has left none that count.
  bool skip(std::size_t num_values);
  // Writes as many whole fields of the earlier run as it has left, of `num_fields`, and returns their
  // number.
  std::size_t skip_fields(std::size_t num_fields, std::size_t values_per_field);
  void write(std::span<const double> values);
  // Completes the file. Precondition: all values are written.
  void finish();
  // Returns what FieldWriter::remarks() says.
  [[nodiscard]] std::vector<std::string> remarks() const {
    return writer_ ? writer_->remarks() : std::vector<std::string>();
  }
  // Returns the number of values that were missing.
  [[nodiscard]] std::size_t num_missing() const { return num_missing_; }

 private:
  void pass_on(std::span<const double> values);

  std::optional<FieldWriter> writer_;
  std::optional<RegridJournal> journal_;
  std::uint64_t num_kept_ = 0;
  std::size_t num_missing_ = 0;
};

}  // namespace rondel::formats
