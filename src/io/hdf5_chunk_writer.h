// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Compresses the values of a netCDF-4 variable by several threads, chunk by chunk, and gives them to
// HDF5 as they are; netCDF-C would compress one after the other.
//
// in    values in their order, the last dimension varying fastest
// out   chunks of a file that netCDF-C has open
// index chunks, which are runs of values
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/hdf5_library.h"

namespace rondel::io {

// A variable whose chunks are runs of values: they have one index of each of the first dimensions,
// some of the next one, and all of the rest.
struct ChunkedVariable {
  std::string file;  // the name that netCDF-C was given
  std::string name;
  std::vector<std::uint64_t> shape;
  std::vector<std::size_t> chunk;  // lengths
  std::size_t value_size;
  int deflate;                      // the effort of zlib, from 1 to 9
  bool is_unlimited;                // a dimension may grow
  std::vector<unsigned char> fill;  // the bytes of a value beyond the end of a dimension
};

class Hdf5ChunkWriter {
 public:
  // Returns null if HDF5 cannot be given chunks. Precondition: the lock of netCDF-C is held, as it is
  // when the object is destroyed, which is before the file is closed.
  static std::unique_ptr<Hdf5ChunkWriter> open(ChunkedVariable variable, unsigned threads);

  // Takes the next values. Returns false if they cannot be written.
  bool write(const void* values, std::size_t count);

 private:
  Hdf5ChunkWriter(ChunkedVariable variable, Hdf5Id array, unsigned threads);

  // Returns the number of values of the chunk that begins at start_.
  [[nodiscard]] std::size_t values_of_next() const;
  // Sets start_ to the begin of the next chunk.
  void go_on();
  // Compresses and writes the chunks that wait.
  bool write_waiting();
  // Returns a chunk of values as HDF5 stores it: bytes of the same weight together, compressed.
  [[nodiscard]] std::vector<unsigned char> packed(const std::vector<unsigned char>& values) const;

  // A chunk that is complete.
  struct WaitingChunk {
    std::vector<unsigned long long> start;
    std::vector<unsigned char> values;
  };

  ChunkedVariable variable_;
  Hdf5Object array_;
  unsigned threads_;
  std::size_t divided_ = 0;   // the dimension of which a chunk has some indices
  std::size_t of_index_ = 1;  // the number of values at each of these
  std::size_t bytes_of_chunk_ = 0;
  std::uint64_t values_left_ = 1;          // of the variable
  std::vector<unsigned long long> start_;  // of the next chunk
  std::vector<unsigned char> next_;        // its values so far
  std::vector<WaitingChunk> waiting_;
};

}  // namespace rondel::io
