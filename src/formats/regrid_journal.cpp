// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_journal.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "rondel/error.h"
#include "rondel/version.h"
#include "system/descriptor.h"
#include "system/hash.h"

namespace rondel::formats {
namespace {

// The first line of every journal, and the line behind the last fact.
constexpr std::string_view journal_first_line =
    "rondel regrid, the values of a run that was not completed\n";
constexpr std::string_view journal_last_line = "values\n";

// The numbers before the values of a record.
struct RegridRecordHead {
  std::uint64_t num_values;
  std::uint64_t checksum;
};

// Values are checked and copied in pieces of this many.
constexpr std::size_t values_per_check = std::size_t{1} << 16U;

std::uint64_t checksum_of_values(std::span<const double> values, std::uint64_t before) {
  for (const double value : values) {
    before = system::mixed(before, std::bit_cast<std::uint64_t>(value));
  }
  return before;
}

// Returns a fact as a line of the file. A value has no end of a line of its own.
std::string fact_as_line(const JournalFact& fact) {
  std::string line = fact.what + ": " + fact.value;
  std::ranges::replace(line, '\n', ' ');
  return line + '\n';
}

std::string journal_head(const std::vector<JournalFact>& about) {
  std::string head(journal_first_line);
  head += fact_as_line({"version", std::string(version)});
  head += fact_as_line({"bytes", std::endian::native == std::endian::little ? "little" : "big"});
  for (const JournalFact& fact : about) head += fact_as_line(fact);
  head += journal_last_line;
  return head;
}

// Returns the first line of `wanted` that differs from that of the file, and the latter.
std::pair<std::string_view, std::string_view> first_difference(std::string_view wanted,
                                                               std::string_view found) {
  while (!wanted.empty()) {
    const std::string_view ours = wanted.substr(0, wanted.find('\n'));
    const std::string_view theirs = found.substr(0, found.find('\n'));
    if (ours != theirs) return {ours, theirs};
    wanted.remove_prefix(ours.size() + 1);
    found.remove_prefix(std::min(theirs.size() + 1, found.size()));
  }
  return {};
}

}  // namespace

RegridJournal::RegridJournal(std::string path, const std::vector<JournalFact>& about)
    : path_(std::move(path)) {
  open();
  try {
    require_head(about);
    find_records();
  } catch (...) {
    system::close(descriptor_);
    throw;
  }
}

RegridJournal::~RegridJournal() {
  if (descriptor_ >= 0) system::close(descriptor_);
}

void RegridJournal::open() {
  descriptor_ = system::open_to_change(path_);
  if (descriptor_ < 0) fail(errno);
  if (system::lock(descriptor_)) return;
  system::close(descriptor_);
  throw FileError(path_ + ": another process works with it");
}

// A file that ends within its head was cut when it was made, and is made anew.
void RegridJournal::require_head(const std::vector<JournalFact>& about) {
  const std::string head = journal_head(about);
  const std::uint64_t size = system::size_of(descriptor_);
  constexpr std::uint64_t longest_head = std::uint64_t{1} << 20U;
  std::string found(std::min(size, longest_head), '\0');
  read_bytes(0, found.data(), found.size());
  const std::string_view begin = std::string_view(found).substr(0, journal_first_line.size());
  if (!journal_first_line.starts_with(begin)) {
    throw FileError(path_ + ": it is not what a run of regrid has left; the name is taken");
  }
  if (found.starts_with(head)) {
    end_ = head.size();
    return;
  }
  const std::size_t end_of_head = found.find('\n' + std::string(journal_last_line));
  if (end_of_head != std::string::npos) {
    const auto [ours, theirs] = first_difference(head, found.substr(0, end_of_head + 1));
    throw FileError(path_ + ": of a run with '" + std::string(theirs) + "', not '" +
                    std::string(ours) + "'; remove it to begin anew");
  }
  if (system::resize(descriptor_, 0) != 0) fail(errno);
  write_bytes(head.data(), head.size());
}

void RegridJournal::find_records() {
  const std::uint64_t size = system::size_of(descriptor_);
  std::vector<double> piece;
  for (;;) {
    RegridRecordHead head{};
    if (size - end_ < sizeof head) break;
    read_bytes(end_, &head, sizeof head);
    const std::uint64_t begin = end_ + sizeof head;
    if (head.num_values > (size - begin) / sizeof(double)) break;
    std::uint64_t checksum = head.num_values;
    for (std::uint64_t k = 0; k < head.num_values; k += piece.size()) {
      piece.resize(std::min<std::uint64_t>(values_per_check, head.num_values - k));
      read_bytes(begin + k * sizeof(double), piece.data(), piece.size() * sizeof(double));
      checksum = checksum_of_values(piece, checksum);
    }
    if (checksum != head.checksum) break;
    records_.push_back({begin, head.num_values});
    num_left_ += head.num_values;
    end_ = begin + head.num_values * sizeof(double);
  }
}

void RegridJournal::read(std::span<double> out) {
  num_left_ -= out.size();
  while (!out.empty()) {
    const RegridRecord& record = records_[current_];
    const std::size_t count = std::min<std::uint64_t>(out.size(), record.num_values - num_read_);
    read_bytes(record.begin + num_read_ * sizeof(double), out.data(), count * sizeof(double));
    out = out.subspan(count);
    num_read_ += count;
    if (num_read_ < record.num_values) continue;
    ++current_;
    num_read_ = 0;
  }
}

// What has been read of a record that is not read to its end becomes a record.
void RegridJournal::drop_unread() {
  num_left_ = 0;
  if (current_ == records_.size()) return;
  const RegridRecord record = records_[current_];
  std::vector<double> kept(num_read_);
  read_bytes(record.begin, kept.data(), kept.size() * sizeof(double));
  end_ = record.begin - sizeof(RegridRecordHead);
  records_.clear();
  current_ = 0;
  num_read_ = 0;
  if (!kept.empty()) append_record(kept);
}

void RegridJournal::append(std::span<const double> values) {
  drop_unread();
  append_record(values);
}

// The rest of the file is cut first: it may have a record that was damaged.
void RegridJournal::append_record(std::span<const double> values) {
  if (system::resize(descriptor_, end_) != 0) fail(errno);
  const RegridRecordHead head{values.size(), checksum_of_values(values, values.size())};
  write_bytes(&head, sizeof head);
  write_bytes(values.data(), values.size_bytes());
}

void RegridJournal::remove() {
  system::close(std::exchange(descriptor_, -1));
  std::error_code error;
  std::filesystem::remove(path_, error);
  if (error) throw FileError(path_, error);
}

void RegridJournal::read_bytes(std::uint64_t place, void* bytes, std::size_t size) const {
  char* to = static_cast<char*>(bytes);
  while (size > 0) {
    const std::ptrdiff_t count = system::read_at(descriptor_, place, to, size);
    if (count < 0) fail(errno);
    if (count == 0) throw FileError(path_ + ": cut off while it was read");
    place += static_cast<std::uint64_t>(count);
    to += count;
    size -= static_cast<std::size_t>(count);
  }
}

void RegridJournal::write_bytes(const void* bytes, std::size_t size) {
  std::string_view left(static_cast<const char*>(bytes), size);
  while (!left.empty()) {
    const std::ptrdiff_t count = system::write_at(descriptor_, end_, left);
    if (count < 0) fail(errno);
    left.remove_prefix(static_cast<std::size_t>(count));
    end_ += static_cast<std::uint64_t>(count);
  }
}

void RegridJournal::fail(int error) const {
  throw FileError(path_, std::error_code(error, std::generic_category()));
}

}  // namespace rondel::formats
