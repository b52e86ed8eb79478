// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads a netCDF-4 file by netCDF-C, for NetcdfReader.
//
// in    a path, or the bytes of a file
// out   a header, and values
// index values of a variable, the last dimension varying fastest
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/hdf5_chunks.h"
#include "io/netcdf_header.h"
#include "io/netcdf_library.h"
#include "io/netcdf_reader.h"

namespace rondel::io {

// True if the first bytes contain the signature of HDF5, at offset 0, 512, 1024, 2048, ...
bool is_hdf5(std::string_view head);
// True if it is at offset 0.
bool has_hdf5_at_begin(std::string_view head);

// An open file. All calls of netCDF-C hold its lock, so that threads may share this object.
class Netcdf4File {
 public:
  // Throws BadValue if the file cannot be read, or netCDF-C is not installed.
  explicit Netcdf4File(const std::string& path);
  // Reads from bytes, which must outlive this object.
  explicit Netcdf4File(std::string_view bytes);
  ~Netcdf4File();
  Netcdf4File(const Netcdf4File&) = delete;
  Netcdf4File& operator=(const Netcdf4File&) = delete;

  // Returns the dimensions, attributes and variables with their shapes. Variables that netCDF-C
  // cannot describe are left out.
  [[nodiscard]] NetcdfHeader header() const;

  // Reads as many values as `out` has room for, from value `begin` on. Throws BadValue if reading
  // fails.
  void read(const VariableInFile& variable, std::uint64_t begin, std::span<double> out) const;
  void read_box(const VariableInFile& variable, const NetcdfBox& box, std::span<double> out) const;
  // Sets the lengths of the variable's chunks, if it has chunks.
  void take_chunk(const VariableInFile& variable, std::span<std::uint64_t> lengths) const;
  // Returns what reads the chunks of a variable by any number of threads; null if it has none, or
  // they are of another kind. The object lives as long as this one.
  [[nodiscard]] const Hdf5Chunks* chunks(const VariableInFile& variable) const;
  // Reads integers. Precondition: the variable has a type of integers.
  void read(const VariableInFile& variable, std::uint64_t begin, std::span<std::int64_t> out) const;
  void read_box(const VariableInFile& variable, const NetcdfBox& box,
                std::span<std::int64_t> out) const;
  // Reads all characters of a text. Precondition: `out` has their number.
  void read(const VariableInFile& variable, std::string& out) const;
  // Returns all strings of a variable that has strings.
  [[nodiscard]] std::vector<std::string> strings(const VariableInFile& variable) const;

 private:
  // Says how long arrays are in the file, where that is known and less than their dimensions.
  void take_stored_lengths(NetcdfHeader& header) const;

  const NetcdfLibrary& library_;
  int number_ = 0;
  std::string path_;  // empty if the file is in memory
  std::shared_ptr<ChunkMemory> memory_ = std::make_shared<ChunkMemory>();
  // The results of chunks() by the numbers of a group and of a variable; null for those that
  // netCDF-C reads.
  mutable std::map<std::pair<int, int>, std::unique_ptr<const Hdf5Chunks>> chunks_;
};

}  // namespace rondel::io
