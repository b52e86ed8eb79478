// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A file of netCDF-4 as netCDF-C reads it: what NetcdfReader makes of one.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/netcdf_header.h"
#include "io/netcdf_library.h"
#include "io/netcdf_reader.h"

namespace rondel::io {

// Whether a file that begins so is one of HDF5: its signature is at its start, or at 512 bytes, 1024, 2048 ...
bool is_hdf5(std::string_view head);

class Netcdf4File {
 public:
  // Throws BadValue: also where netCDF-C is not there.
  explicit Netcdf4File(const std::string& path);
  // Of bytes, which live as long as this.
  explicit Netcdf4File(std::string_view bytes);
  ~Netcdf4File();
  Netcdf4File(const Netcdf4File&) = delete;
  Netcdf4File& operator=(const Netcdf4File&) = delete;

  // Dimensions, attributes and variables, with their shapes. What netCDF-C cannot tell of a variable costs that one alone.
  [[nodiscard]] NetcdfHeader header() const;

  // As many values as there is room for, from this one on. Throws BadValue.
  void read(const NetcdfReader::Variable& variable, std::uint64_t begin,
            std::span<double> out) const;
  // Precondition: they are integers.
  void read(const NetcdfReader::Variable& variable, std::uint64_t begin,
            std::span<std::int64_t> out) const;

 private:
  const NetcdfLibrary& library_;
  int number_ = 0;
};

}  // namespace rondel::io
