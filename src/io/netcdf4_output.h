// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes a netCDF-4 file by netCDF-C, for NetcdfWriter.
//
// in    definitions, then the values of each variable in their order
// out   a file
// index variables in the order of their definitions; values of a variable, the last dimension
// varying fastest
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "io/hdf5_chunk_writer.h"
#include "io/netcdf_format.h"
#include "io/netcdf_library.h"

namespace rondel::io {

// The dimensions, variables and attributes that the file gets.
struct Netcdf4Definitions {
  const std::vector<NetcdfDimension>& dimensions;
  const std::vector<NetcdfAttribute>& attributes;
  const std::vector<NetcdfVariable>& variables;
};

// netCDF-C needs a file in which it can write at any place. This file has the permissions of the
// target and no name, if the system allows that, and its content is copied to the target at the
// end.
//
// Variables are divided into chunks of runs of values, so that values can be written in their
// order, each chunk once. Several threads compress chunks of variables that have several.
//
// HDF5 keeps data back until the file is closed, and where it cannot write them then, some versions
// (1.10) leave a file behind that crashes the process when it ends. So there is room on the disk
// for all that is handed over before it is: a full disk, or a limit of the size of files, is an
// error before HDF5 meets it.
class Netcdf4Output {
 public:
  // Throws FileError with the name of the target, and BadValue where netCDF-C is not there.
  Netcdf4Output(AtomicFile& file, const Netcdf4Definitions& definitions, int deflate,
                unsigned threads);
  ~Netcdf4Output();
  Netcdf4Output(const Netcdf4Output&) = delete;
  Netcdf4Output& operator=(const Netcdf4Output&) = delete;

  // Writes `size` values of the type of the variable, from number `begin` on. Throws FileError.
  void write(std::size_t variable, std::uint64_t begin, std::size_t size, const void* values);
  // Copies the file into the target. Throws FileError.
  void finish();

 private:
  void create(const std::string& name);
  void define(const Netcdf4Definitions& definitions, int deflate);
  void define_variable(const NetcdfVariable& variable, const std::vector<int>& dimensions,
                       int deflate);
  void put(int variable, const NetcdfAttribute& attribute);
  // Throws FileError with the message of the library if the number is that of an error; `what` is
  // what was to be done.
  void require(int error, const std::string& what) const;
  // Finds room on the disk for all that HDF5 may have kept back.
  void require_room();
  void close();

  // A variable as netCDF-C knows it, with the bytes that were handed over and may be kept back.
  struct DefinedVariable {
    int number;
    std::string name;
    std::size_t size_of_value;
    std::vector<std::uint64_t> shape;
    std::uint64_t num_bytes_stored;  // in whole chunks
    std::uint64_t num_bytes_handed;
    bool is_unlimited;                        // a dimension may grow
    std::unique_ptr<Hdf5ChunkWriter> chunks;  // null: netCDF-C compresses
  };

  // Opens what compresses chunks of a variable, if it has several.
  void open_chunks(DefinedVariable& output, const NetcdfVariable& variable);

  AtomicFile& file_;
  const NetcdfLibrary& library_;
  int deflate_;
  unsigned threads_;
  std::string path_;  // by which netCDF-C knows the file
  int descriptor_ = -1;
  int number_ = 0;
  bool is_open_ = false;
  std::string left_name_;  // name of a file that could not be unlinked while it is open
  std::vector<DefinedVariable> variables_;
  std::uint64_t size_of_definitions_ = 0;  // at most, with the places of the chunks
  std::uint64_t size_with_room_ = 0;
};

}  // namespace rondel::io
