// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A Zarr group of version 3 (https://zarr-specs.readthedocs.io/en/latest/v3/core): a folder with a folder
// for each array, each with its description, zarr.json, and chunks, files of numbers as they are:
// the lowest byte first, not compressed. Chunks are runs of rows, all of the same number.
//
// For readers that open the group at once, its own zarr.json repeats the descriptions of all arrays
// ("consolidated metadata", as Zarr for Python writes it).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/atomic_folder.h"
#include "rondel/export.h"

namespace rondel::io {

// Names, and values as JSON has them.
using ZarrAttributes = std::vector<std::pair<std::string, std::string>>;

// A text as JSON has it; it has no character that JSON cannot have in quotes.
std::string zarr_text(std::string_view text);

struct ZarrHead {
  std::string name;
  std::string type;  // uint32, int32, int64, float64
  std::vector<std::uint64_t> shape;
  std::vector<std::string> dimensions;  // their names
  ZarrAttributes attributes;
};

// The rows of a chunk, the same number in all: at most 2^20, and as few chunks as that allows.
std::uint64_t zarr_chunk_rows(std::uint64_t num_rows);

class RONDEL_API ZarrGroup {
 public:
  // A group that exists is replaced if it was made here, and no array was added (AtomicFolder).
  explicit ZarrGroup(const std::string& path);

  void reserve(std::uint64_t num_bytes) { folder_.reserve(num_bytes); }
  // An array that has no chunk yet: its numbers are 0.
  void add(const ZarrHead& head);
  // All arrays are written.
  void commit(const ZarrAttributes& attributes);

 private:
  friend class ZarrArray;

  AtomicFolder folder_;
  std::vector<std::pair<std::string, std::string>> arrays_;  // names and descriptions
};

// An array while it is written, row by row.
class RONDEL_API ZarrArray {
 public:
  // Adds it to the group, which lives as long.
  ZarrArray(ZarrGroup& group, const ZarrHead& head);
  ~ZarrArray();
  ZarrArray(const ZarrArray&) = delete;
  ZarrArray& operator=(const ZarrArray&) = delete;

  void write(std::string_view bytes);
  // All rows are written.
  void finish();

 private:
  void open_chunk();
  void close_chunk();

  ZarrGroup& group_;
  std::string name_;
  std::string tail_;  // of the names of chunks, behind their number
  std::uint64_t chunk_bytes_;
  std::uint64_t num_chunks_ = 0;
  std::uint64_t left_ = 0;  // of the chunk that is open
  int descriptor_ = -1;
};

}  // namespace rondel::io
