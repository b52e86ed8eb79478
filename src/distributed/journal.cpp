// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/journal.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "distributed/checksum.h"
#include "rondel/error.h"

namespace rondel::distributed {
namespace {

// Every journal begins with this, even one that was cut.
constexpr std::string_view mark = "rondel journal\n\n";

// The words before each record.
struct RecordHead {
  std::uint64_t num_words;
  std::uint64_t checksum;
};

std::uint64_t checksum_of(std::span<const std::uint64_t> words) {
  Checksum sum;
  sum.add(words);
  return sum.value();
}

}  // namespace

Journal::Journal(const std::string& path) : file_(path) {
  if (!file_.lock()) throw FileError(path + ": another process works here");
  const std::uint64_t size = file_.size();
  if (!has_mark(size))
    throw FileError(path + ": not of a run; the scratch directory must be one of its own");
  RecordHead head{};
  while (end_ + sizeof(RecordHead) <= size) {
    file_.read(end_, std::span(&head, 1));
    const std::uint64_t max_words = (size - end_ - sizeof(RecordHead)) / sizeof(std::uint64_t);
    if (head.num_words > max_words) break;
    Words words(head.num_words);
    file_.read(end_ + sizeof(RecordHead), std::span(words));
    if (checksum_of(words) != head.checksum) break;
    end_ += sizeof(RecordHead) + words.size() * sizeof(std::uint64_t);
    records_.push_back(std::move(words));
  }
}

// True if the file begins like a journal. Half of the mark suffices, as a part of it may be
// damaged.
bool Journal::has_mark(std::uint64_t size) const {
  std::array<char, mark.size()> begin{};
  const auto there = std::span(begin).first(std::min<std::uint64_t>(size, mark.size()));
  file_.read(0, there);
  std::size_t num_equal = 0;
  for (std::size_t i = 0; i < there.size(); ++i) num_equal += there[i] == mark[i] ? 1 : 0;
  return 2 * num_equal >= there.size();
}

// Writes the record at once, as a killed process may leave a part of it.
void Journal::append(std::span<const std::uint64_t> words) {
  if (end_ == mark.size()) file_.write(0, std::span(mark));
  Words record = {words.size(), checksum_of(words)};
  record.insert(record.end(), words.begin(), words.end());
  file_.write(end_, std::span<const std::uint64_t>(record));
  end_ += record.size() * sizeof(std::uint64_t);
}

void Journal::clear() {
  file_.cut(0);
  records_.clear();
  end_ = mark.size();
}

}  // namespace rondel::distributed
