// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/hdf5_chunk_writer.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "io/netcdf_library.h"
#include "io/zlib_data.h"
#include "system/parallel.h"

namespace rondel::io {
namespace {

// How many chunks are compressed at a time: some for each thread.
constexpr std::size_t most_waiting = 16;

}  // namespace

std::unique_ptr<Hdf5ChunkWriter> Hdf5ChunkWriter::open(ChunkedVariable variable, unsigned threads) {
  const Hdf5Library* const hdf5 = hdf5_library();
  if (hdf5 == nullptr) return {};
  const Hdf5Id array = open_hdf5_array(*hdf5, variable.file, variable.name);
  if (array < 0) return {};
  std::unique_ptr<Hdf5ChunkWriter> made(new Hdf5ChunkWriter(std::move(variable), array, threads));
  if (made->variable_.is_unlimited) {
    const std::vector<unsigned long long> lengths(made->variable_.shape.begin(),
                                                  made->variable_.shape.end());
    if (hdf5->set_lengths(array, lengths.data()) < 0) return {};
  }
  return made;
}

Hdf5ChunkWriter::Hdf5ChunkWriter(ChunkedVariable variable, Hdf5Id array, unsigned threads)
    : variable_(std::move(variable)),
      array_(array, hdf5_library()->close_array),
      threads_(threads),
      start_(variable_.shape.size(), 0) {
  const std::size_t last = variable_.shape.size() - 1;
  while (divided_ < last && variable_.chunk[divided_] == 1) ++divided_;
  for (std::size_t d = divided_ + 1; d <= last; ++d) of_index_ *= variable_.chunk[d];
  bytes_of_chunk_ = of_index_ * variable_.chunk[divided_] * variable_.value_size;
  for (const std::uint64_t length : variable_.shape) values_left_ *= length;
}

std::size_t Hdf5ChunkWriter::values_of_next() const {
  const std::uint64_t left = variable_.shape[divided_] - start_[divided_];
  return of_index_ *
         static_cast<std::size_t>(std::min<std::uint64_t>(left, variable_.chunk[divided_]));
}

void Hdf5ChunkWriter::go_on() {
  start_[divided_] += variable_.chunk[divided_];
  for (std::size_t d = divided_; d > 0 && start_[d] >= variable_.shape[d]; --d) {
    start_[d] = 0;
    ++start_[d - 1];
  }
}

bool Hdf5ChunkWriter::write(const void* values, std::size_t count) {
  const auto* bytes = static_cast<const unsigned char*>(values);
  values_left_ -= count;
  while (count > 0) {
    const std::size_t room = values_of_next() - next_.size() / variable_.value_size;
    const std::size_t taken = std::min(room, count);
    if (next_.empty()) next_.reserve(bytes_of_chunk_);
    next_.insert(next_.end(), bytes, bytes + taken * variable_.value_size);
    bytes += taken * variable_.value_size;
    count -= taken;
    if (taken < room) break;
    // A chunk at the end of a dimension is as long as the others: its rest shows if that grows.
    while (next_.size() < bytes_of_chunk_) {
      next_.insert(next_.end(), variable_.fill.begin(), variable_.fill.end());
    }
    waiting_.push_back({start_, std::move(next_)});
    next_ = {};
    go_on();
    if (waiting_.size() == most_waiting && !write_waiting()) return false;
  }
  return values_left_ > 0 || write_waiting();
}

bool Hdf5ChunkWriter::write_waiting() {
  std::vector<std::vector<unsigned char>> chunks(waiting_.size());
  system::parallel_for(threads_, chunks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) chunks[k] = packed(waiting_[k].values);
  });
  const std::lock_guard<system::Mutex> lock(netcdf_library_lock());
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    if (chunks[k].empty() ||
        hdf5_library()->write_chunk(array_.id(), hdf5_default, 0, waiting_[k].start.data(),
                                    chunks[k].size(), chunks[k].data()) < 0) {
      return false;
    }
  }
  waiting_.clear();
  return true;
}

std::vector<unsigned char> Hdf5ChunkWriter::packed(const std::vector<unsigned char>& values) const {
  const std::size_t size = variable_.value_size;
  const std::size_t count = values.size() / size;
  std::vector<unsigned char> shuffled(values.size());
  for (std::size_t b = 0; b < size; ++b) {
    unsigned char* const to = shuffled.data() + b * count;
    for (std::size_t i = 0; i < count; ++i) to[i] = values[i * size + b];
  }
  return zlib_compressed(shuffled, variable_.deflate);
}

}  // namespace rondel::io
