// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The journal is a list of records, each a row of words whose first one is its kind. The first
// record says what the run is about; the others repeat the changes of the state in their order.

#include "distributed/run_state.h"

#include <algorithm>
#include <utility>

#include "rondel/error.h"

namespace rondel::distributed {
namespace {

// The kinds of records, which are their first words.
enum JournalRecord : std::uint64_t { about, counted, scattered, done };

template <class T>
std::vector<T> one(const T& value) {
  return std::vector<T>(1, value);
}

Words about_record(const std::vector<RunPart>& parts) {
  Words words;
  for (const RunPart& part : parts) words.insert(words.end(), part.words.begin(), part.words.end());
  WordWriter writer;
  writer.add(JournalRecord::about);
  writer.add(words);
  return writer.words();
}

// Returns the text of the first part that differs from the record, or null.
const char* difference_of(const Words& record, const std::vector<RunPart>& parts) {
  std::size_t next = 2;  // after the kind of the record and the number of words
  for (const RunPart& part : parts) {
    const auto rest = std::span(record).subspan(std::min(next, record.size()));
    if (!std::ranges::equal(part.words, rest.first(std::min(part.words.size(), rest.size()))))
      return part.difference;
    next += part.words.size();
  }
  return parts.front().difference;
}

}  // namespace

RunState::RunState(const std::string& journal, const std::vector<RunPart>& about_run, bool resume)
    : journal_(journal) {
  const Words about_words = about_record(about_run);
  if (journal_.records().size() <= 1) {  // nothing has been done
    journal_.clear();
    journal_.append(about_words);
    return;
  }
  if (!resume) {
    throw FileError(journal +
                    ": a run that has not come to its end; resume it, or remove the directory");
  }
  if (journal_.records().front() != about_words) {
    throw FileError(journal + ": a run with " +
                    difference_of(journal_.records().front(), about_run));
  }
  for (const Words& record : std::span(journal_.records()).subspan(1)) read(record);
}

void RunState::read(const Words& record) {
  WordReader reader(record);
  const std::uint64_t kind = reader.word();
  if (kind == JournalRecord::counted) {
    std::vector<bulk::AllSites> all;
    reader.read(all);
    counts_ = {all.front(), {}};
    reader.read(counts_->cuts);
    scattered_.resize(counts_->cuts.size());
    done_.resize(counts_->cuts.size());
  } else if (kind == JournalRecord::scattered) {
    std::vector<std::uint64_t> buckets;
    std::vector<SpoolChecksums> sums;
    reader.read(buckets);
    reader.read(sums);
    for (std::size_t i = 0; i < buckets.size(); ++i) scattered_[buckets[i]] = sums[i];
  } else {
    std::vector<StoredBucket> stored;
    const std::uint64_t bucket = reader.word();
    reader.read(stored);
    done_[bucket] = stored.front();
  }
}

void RunState::set_counts(SiteCounts counts) {
  WordWriter writer;
  writer.add(JournalRecord::counted);
  writer.add(one(counts.all));
  writer.add(counts.cuts);
  journal_.append(writer.words());
  counts_ = std::move(counts);
  scattered_.resize(counts_->cuts.size());
  done_.resize(counts_->cuts.size());
}

void RunState::set_scattered(std::span<const SpoolChecksums> sums,
                             const std::vector<bool>& wanted) {
  std::vector<std::uint64_t> buckets;
  std::vector<SpoolChecksums> wanted_sums;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    buckets.push_back(i);
    wanted_sums.push_back(sums[i]);
    scattered_[i] = sums[i];
  }
  WordWriter writer;
  writer.add(JournalRecord::scattered);
  writer.add(buckets);
  writer.add(wanted_sums);
  journal_.append(writer.words());
}

void RunState::set_done(std::size_t i, const StoredBucket& stored) {
  WordWriter writer;
  writer.add(JournalRecord::done);
  writer.add(i);
  writer.add(one(stored));
  journal_.append(writer.words());
  done_[i] = stored;
}

}  // namespace rondel::distributed
