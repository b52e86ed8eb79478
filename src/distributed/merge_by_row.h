// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Merges the records of all buckets in the order of their rows. Each bucket has its records in a
// file, in that order.
//
// in    sorted lists of records
// out   all records, sorted
// index rows of the input
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rondel::distributed {

// One list of `size` records, which read(first, records) reads into a buffer.
template <class Record, class Read>
class RecordReader {
 public:
  RecordReader(Read read, std::uint64_t size, std::size_t buffer_size)
      : read_(std::move(read)), size_(size), buffer_size_(buffer_size) {
    fill();
  }

  [[nodiscard]] bool is_at_end() const { return at_ == buffer_.size(); }
  [[nodiscard]] const Record& front() const { return buffer_[at_]; }
  // Goes to the next record.
  void next() {
    if (++at_ == buffer_.size()) fill();
  }

 private:
  // Reads the next records into the buffer.
  void fill() {
    const std::uint64_t size = std::min<std::uint64_t>(buffer_size_, size_ - num_read_);
    buffer_.resize(size);
    read_(num_read_, std::span(buffer_));
    num_read_ += size;
    at_ = 0;
  }

  Read read_;
  std::uint64_t size_;
  std::size_t buffer_size_;
  std::uint64_t num_read_ = 0;
  std::vector<Record> buffer_;
  std::size_t at_ = 0;
};

// Calls visit(record) for all records of all lists, in increasing order of record.row. read(list,
// first, records) reads records of one list from `first` on.
template <class Record, class Read, class Visit>
void merge_by_row(const std::vector<std::uint64_t>& sizes, const Read& read, Visit visit) {
  constexpr std::size_t all_bytes = std::size_t{1} << 24;
  const std::size_t buffer_size =
      std::max<std::size_t>(all_bytes / sizeof(Record) / (sizes.size() + 1), 16);
  const auto reader = [&](std::size_t list) {
    const auto read_some = [&read, list](std::uint64_t first, std::span<Record> records) {
      read(list, first, records);
    };
    return RecordReader<Record, decltype(read_some)>(read_some, sizes[list], buffer_size);
  };
  using Reader = decltype(reader(0));
  std::vector<Reader> readers;
  std::vector<std::size_t> heap;  // indices of readers, the one with the lowest row first
  const auto is_later = [&](std::size_t a, std::size_t b) {
    return readers[a].front().row > readers[b].front().row;
  };
  for (std::size_t list = 0; list < sizes.size(); ++list) {
    readers.push_back(reader(list));
    if (!readers.back().is_at_end()) heap.push_back(list);
  }
  std::ranges::make_heap(heap, is_later);
  while (!heap.empty()) {
    std::ranges::pop_heap(heap, is_later);
    Reader& first = readers[heap.back()];
    visit(first.front());
    first.next();
    if (first.is_at_end()) {
      heap.pop_back();
    } else {
      std::ranges::push_heap(heap, is_later);
    }
  }
}

}  // namespace rondel::distributed
