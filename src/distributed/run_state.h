// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How far a run has come, as its journal tells.
//
// in    what the run is about, and its journal
// out   the buckets, and which of them are scattered and done
// index buckets
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "distributed/journal.h"
#include "distributed/result_store.h"
#include "distributed/site_counts.h"
#include "distributed/site_spool.h"

namespace rondel::distributed {

// One aspect of a run that must be the same if the run is to be resumed.
struct RunPart {
  const char* difference;  // continues "a run with ..." if it differs
  Words words;             // the number of words is the same for every run
};

// The state of a run; each change is written to the journal.
class RunState {
 public:
  // `about` identifies the run. Throws FileError if the journal belongs to another run, and says
  // what differs, or if it belongs to this run and `resume` is false.
  RunState(const std::string& journal, const std::vector<RunPart>& about, bool resume);

  [[nodiscard]] bool has_counts() const { return counts_.has_value(); }
  [[nodiscard]] const SiteCounts& counts() const { return *counts_; }
  [[nodiscard]] std::size_t num_buckets() const { return counts_->cuts.size(); }
  [[nodiscard]] const SpoolChecksums& scattered(std::size_t i) const { return *scattered_[i]; }
  [[nodiscard]] const StoredBucket& done(std::size_t i) const { return *done_[i]; }
  [[nodiscard]] bool is_scattered(std::size_t i) const { return scattered_[i].has_value(); }
  [[nodiscard]] bool is_done(std::size_t i) const { return done_[i].has_value(); }

  // Records that the sites have been counted.
  void set_counts(SiteCounts counts);
  // Records that the buckets that are `wanted` have been scattered, with their checksums.
  void set_scattered(std::span<const SpoolChecksums> sums, const std::vector<bool>& wanted);
  // Records that bucket i has been triangulated and stored.
  void set_done(std::size_t i, const StoredBucket& stored);
  // Forgets that a bucket was scattered or done, because the files do not contain it.
  void lose_scattered(std::size_t i) { scattered_[i].reset(); }
  void lose_done(std::size_t i) { done_[i].reset(); }

 private:
  // Applies a record of the journal.
  void read(const Words& record);

  Journal journal_;
  std::optional<SiteCounts> counts_;
  std::vector<std::optional<SpoolChecksums>> scattered_;
  std::vector<std::optional<StoredBucket>> done_;
};

}  // namespace rondel::distributed
