// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file of netCDF-4 as netCDF-C reads it, for NetcdfReader.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/netcdf_header.h"
#include "io/netcdf_library.h"
#include "io/netcdf_reader.h"

namespace rondel::io {

// Whether a file with these first bytes is one of HDF5: its signature is at its start, or at 512 bytes, 1024, 2048 ...
bool is_hdf5(std::string_view head);

class Netcdf4File {
 public:
  // Throws BadValue: also where netCDF-C is not there.
  explicit Netcdf4File(const std::string& path);
  // Reads bytes, which live as long as this.
  explicit Netcdf4File(std::string_view bytes);
  ~Netcdf4File();
  Netcdf4File(const Netcdf4File&) = delete;
  Netcdf4File& operator=(const Netcdf4File&) = delete;

  // The dimensions, attributes and variables, with their shapes. A variable that netCDF-C cannot describe is left out.
  [[nodiscard]] NetcdfHeader header() const;

  // Reads as many values as there is room for, from this one on. Throws BadValue.
  void read(const NetcdfReader::Variable& variable, std::uint64_t begin,
            std::span<double> out) const;
  void read_box(const NetcdfReader::Variable& variable, const NetcdfBox& box,
                std::span<double> out) const;
  // The lengths of its chunks, if it has any.
  void take_chunk(const NetcdfReader::Variable& variable, std::span<std::uint64_t> lengths) const;
  // Precondition: they are integers.
  void read(const NetcdfReader::Variable& variable, std::uint64_t begin,
            std::span<std::int64_t> out) const;
  void read_box(const NetcdfReader::Variable& variable, const NetcdfBox& box,
                std::span<std::int64_t> out) const;

 private:
  const NetcdfLibrary& library_;
  int number_ = 0;
};

}  // namespace rondel::io
