// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the chunks of a netCDF-4 variable beside netCDF-C, which decompresses one after the other
// under one lock. HDF5 says where they are in the file; any number of threads reads them there.
//
// in    a file that netCDF-C has open, a variable of it
// out   numbers
// index chunks along the dimensions of the variable, numbered with the last dimension varying fastest
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "system/large_arrays.h"
#include "system/mutex.h"

namespace rondel::io {

// Memory for the values of chunks, which the next chunks use again: new memory is cleared first.
// There is never more than was in use at a time.
class ChunkMemory {
 public:
  // Returns so many bytes of any values.
  [[nodiscard]] LargeVector<unsigned char> take(std::size_t size);
  void give_back(LargeVector<unsigned char> bytes) noexcept;

 private:
  system::Mutex lock_;
  std::vector<LargeVector<unsigned char>> free_;  // all of one size
};

class Hdf5Chunks {
 public:
  // Returns null if the variable is not in chunks that this class can read: of numbers of at most 32
  // bits or doubles, all of them in the file, unchanged or compressed by zlib, with or without
  // shuffled bytes. `path` is the name that netCDF-C was given. Precondition: the lock of netCDF-C is
  // held.
  static std::unique_ptr<const Hdf5Chunks> find(const std::string& path,
                                                const VariableInFile& variable,
                                                std::shared_ptr<ChunkMemory> memory);

  // Returns the number of values of a chunk.
  [[nodiscard]] std::size_t num_values() const { return values_per_chunk_; }
  // True if a box has no values of several chunks.
  [[nodiscard]] bool is_in_chunk(const NetcdfBox& box) const;
  // Reads a box, all or a part of a chunk. Returns false if the chunk is damaged; `out` may have been
  // written then. Any number of threads may call it. Throws FileError if reading fails.
  //
  // A chunk of which a part is read, and not its end, is kept uncompressed if there is room: chunks
  // that hold many times are read some times at a time.
  [[nodiscard]] bool read(const FileBytes& file, const NetcdfBox& box, const BoxPlace& out) const;
  // Sets the room for chunks that are kept, in bytes; it was none.
  void set_room(std::size_t bytes) const;

 private:
  // The values of a chunk as they are in memory of the file's machine; empty if they are damaged.
  struct ChunkValues {
    LargeVector<unsigned char> bytes;
    bool are_shuffled = false;
  };
  struct StoredChunk {
    std::uint64_t offset;
    std::uint64_t size;
    unsigned filters_left_out;  // a bit for each filter
  };
  // A step that the values went through when they were written.
  enum class Filter { shuffle, deflate };

  Hdf5Chunks() = default;
  // Each of these returns false if the array is not of the kind that is read.
  bool take_type(std::int64_t array, const VariableInFile& variable);
  bool take_filters(std::int64_t properties);
  bool take_places(std::int64_t array);
  bool take_place(const unsigned long long* begin, const StoredChunk& chunk);
  // Returns the number of chunks along a dimension.
  [[nodiscard]] std::uint64_t num_along(std::size_t dimension) const {
    return (shape_[dimension] + chunk_[dimension] - 1) / chunk_[dimension];
  }
  // True if a chunk begins with these indices.
  [[nodiscard]] bool is_begin(std::span<const std::size_t> start) const;
  // Returns the number of the chunk that has these indices.
  [[nodiscard]] std::size_t number_of(std::span<const std::size_t> start) const;
  // True if a box has the last value of its chunk.
  [[nodiscard]] bool has_last(const NetcdfBox& box) const;
  [[nodiscard]] ChunkValues values_of(const FileBytes& file, const StoredChunk& place) const;
  // Returns the values of a chunk, whose memory others use again at the end.
  [[nodiscard]] std::shared_ptr<const ChunkValues> shared_values_of(const FileBytes& file,
                                                                    const StoredChunk& place) const;
  // Returns the values of the chunk of a box, which are kept or read.
  [[nodiscard]] std::shared_ptr<const ChunkValues> chunk_of(const FileBytes& file,
                                                            const NetcdfBox& box) const;

  std::shared_ptr<ChunkMemory> memory_;
  std::vector<std::uint64_t> shape_;
  std::vector<std::uint64_t> chunk_;  // lengths
  std::vector<Filter> filters_;       // in the order in which they were applied
  std::vector<StoredChunk> places_;   // by number of the chunk
  NetcdfType type_ = NetcdfType::float32;
  std::size_t value_size_ = 0;
  std::size_t values_per_chunk_ = 1;
  bool is_big_endian_ = false;
  mutable system::Mutex lock_;  // of what follows
  mutable std::map<std::size_t, std::shared_ptr<const ChunkValues>>
      kept_;  // by number of the chunk
  mutable std::size_t room_ = 0;
};

}  // namespace rondel::io
