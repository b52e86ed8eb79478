// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads netCDF files: the classic formats in place, netCDF-4 (HDF5) by netCDF-C if it is installed.
//
// in    a file, or its bytes
// out   dimensions, attributes, variables, and values as doubles or integers
// index dimensions of the file, dimensions of a variable; values of a variable, its last dimension
//       fastest
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file_bytes.h"
#include "io/netcdf_format.h"

namespace rondel::io {

class Hdf5Chunks;
class Netcdf4File;
struct NetcdfHeader;

// The places that the values of a box go to: value (i, j, ...) of the box to begin[i * steps[0] + j * steps[1] + ...].
struct BoxPlace {
  double* begin;
  std::span<const std::size_t> steps;
};

// A box of a variable: `count[d]` indices from `start[d]` on along each dimension d.
struct NetcdfBox {
  std::vector<std::size_t> start;
  std::vector<std::size_t> count;
};

// True if a netCDF file of any format begins with these bytes.
bool is_netcdf(std::string_view head);

// A variable with its place in the file.
struct VariableInFile : NetcdfVariable {
  std::vector<std::uint64_t> shape;  // with the number of records that the file has
  std::uint64_t offset = 0;          // in the file
  bool has_records = false;
  std::uint64_t record_values = 0;  // values in a record; all values if there are no records
  std::uint64_t num_values = 0;
  bool has_strings = false;  // netCDF-4: of the type text, and each value is a string of any length
  int group = 0;  // netCDF-4: the numbers that netCDF-C has for its group and for the variable
  int number = 0;
  // netCDF-4: the lengths that the array has in the file, where they are shorter than those of
  // dimensions that others have made longer; empty where they are not. What lacks is filled.
  std::vector<std::uint64_t> stored;
  // netCDF-4: how many first dimensions of the array in the file this variable lacks, because only
  // their index 0 is read.
  std::size_t num_fixed = 0;
  // True if the values are others at other indices of the first dimension, which counts times.
  bool changes_with_time = false;
};

// A file of netCDF-4 has what the classic formats have, and more:
// 1. Variables of a group are called "group/name", and come after those of the file itself, as do
//    dimensions. Attributes that name variables have these names, too (netcdf_groups.h).
// 2. A variable of strings is of the type text.
// 3. An attribute of several strings is a text with spaces between them.
// 4. Variables and attributes of types that the file defines itself are left out; the message of
//    require() says so of such a variable.
class NetcdfReader {
 public:
  // Reads the header and checks it against the bytes, which must outlive this object. Throws
  // BadValue if it is not valid. Nothing is allocated for a count before the bytes can hold as
  // much, and every value of every variable is present. netCDF-4 is compressed, and is checked
  // against what compression can achieve.
  explicit NetcdfReader(std::string_view bytes);
  // Reads a file, which must outlive this object. Only the header is kept in memory, and values are
  // read when they are asked for; if the size of the file is not known, all of it is read. Also
  // throws FileError.
  explicit NetcdfReader(FileBytes& file);

  [[nodiscard]] std::uint64_t num_bytes() const { return size_; }
  // Returns an upper bound of the number of values of a variable, given the size of the file and
  // compression.
  [[nodiscard]] std::uint64_t max_values() const;
  [[nodiscard]] std::span<const NetcdfDimension> dimensions() const { return dimensions_; }
  [[nodiscard]] std::span<const NetcdfAttribute> attributes() const { return attributes_; }
  [[nodiscard]] std::span<const VariableInFile> variables() const { return variables_; }
  // Returns the names of variables of types that the file defines itself.
  [[nodiscard]] std::span<const std::string> passed_over() const { return passed_over_; }
  // Returns the same file with other facts of some variables, by their numbers.
  [[nodiscard]] NetcdfReader with(std::map<std::size_t, VariableInFile> variables) const;
  // Returns null if there is no variable of this name.
  [[nodiscard]] const VariableInFile* find(std::string_view name) const;
  // Throws BadValue if there is none, or none of a type that is read.
  [[nodiscard]] const VariableInFile& require(std::string_view name) const;

  // Returns all values as doubles. Throws BadValue if they are a text, and for integers of 64 bits
  // that are no doubles; those that are missing, as wide_integers.h says, are NaN.
  [[nodiscard]] std::vector<double> numbers(const VariableInFile& variable) const;
  // Returns what numbers() returns, with integers that are no doubles rounded; sets `is_rounded` if
  // there are some.
  [[nodiscard]] std::vector<double> rounded_numbers(const VariableInFile& variable,
                                                    bool& is_rounded) const;
  // Throws BadValue if the variable is a text, or has more values than the file can have: before
  // there is room for them.
  void require_room(const VariableInFile& variable) const;
  // Read as many values as `out` has room for, from value `begin` on. Throw BadValue like numbers()
  // and integers().
  void read_numbers(const VariableInFile& variable, std::uint64_t begin,
                    std::span<double> out) const;
  void read_integers(const VariableInFile& variable, std::uint64_t begin,
                     std::span<std::int64_t> out) const;
  // Reads the numbers of a box of one or more values, its last dimension varying fastest. Throws
  // BadValue like numbers().
  void read_box(const VariableInFile& variable, const NetcdfBox& box, std::span<double> out) const;
  // Returns the characters of a variable of the type text that has no strings.
  [[nodiscard]] std::string characters(const VariableInFile& variable) const;
  // Returns the strings of a variable that has strings. Throws BadValue if reading fails.
  [[nodiscard]] std::vector<std::string> strings(const VariableInFile& variable) const;
  // Returns the lengths of the compressed chunks along the variable's dimensions; 1 if there are
  // none.
  [[nodiscard]] std::vector<std::uint64_t> chunk_of(const VariableInFile& variable) const;
  // True if read_chunk() reads the chunks of a variable, and one is worth a call.
  [[nodiscard]] bool has_chunks(const VariableInFile& variable) const;
  // Sets how many bytes of chunks read_chunk() may keep, of which it has read a part; it was none.
  void keep_chunks(const VariableInFile& variable, std::size_t bytes) const;
  // Reads a chunk of a compressed variable, or a part of one, beside other threads that do the same.
  // Returns false if the box has values of several chunks, or only netCDF-C can read it; then `out`
  // may have been written, and read_box() reads the values or throws.
  [[nodiscard]] bool read_chunk(const VariableInFile& variable, const NetcdfBox& box,
                                const BoxPlace& out) const;
  // Returns all values as integers. Throws BadValue if they are a text, floating-point numbers, or
  // 2^63 or more.
  [[nodiscard]] std::vector<std::int64_t> integers(const VariableInFile& variable) const;

 private:
  // Keeps the definitions of a header.
  void take(NetcdfHeader&& header);
  // Parses a classic header and places the variables in the file.
  void parse(std::string_view head);
  static void require_numbers(const VariableInFile& variable);
  // Returns what reads its chunks; null if only netCDF-C does.
  [[nodiscard]] const Hdf5Chunks* chunks_of(const VariableInFile& variable) const;
  // Returns the offset in the file of a value, by its number in the variable.
  [[nodiscard]] std::uint64_t place(const VariableInFile& variable, std::uint64_t index) const;
  // Reads integers of 64 bits, uint64 as bits.
  void read_wide(const VariableInFile& variable, std::uint64_t begin,
                 std::span<std::int64_t> out) const;
  template <typename T, typename Out>
  void copy(const VariableInFile& variable, std::uint64_t begin, std::span<Out> out) const;
  // Places the variables of records; `claimed` is the number of records by the header, or all bits
  // 1.
  void place_records(std::uint64_t claimed);

  std::string_view bytes_;
  const FileBytes* file_ = nullptr;  // null if the bytes are in memory
  std::shared_ptr<const Netcdf4File> netcdf4_;
  std::uint64_t size_ = 0;
  std::vector<NetcdfDimension> dimensions_;
  std::vector<NetcdfAttribute> attributes_;
  std::vector<VariableInFile> variables_;
  std::map<std::string, std::size_t, std::less<>> numbers_;  // of the variables, by their names
  std::vector<std::string> passed_over_;
  std::uint64_t record_size_ = 0;
};

// Returns the text of an attribute; an empty text if there is none, or it is a number.
std::string netcdf_text(std::span<const NetcdfAttribute> attributes, std::string_view name);
// Returns the attribute, or null.
const NetcdfAttribute* find_attribute(std::span<const NetcdfAttribute> attributes,
                                      std::string_view name);

// Returns the lengths of a grid of `size` cells, which SCRIP lists from the fastest dimension on,
// with the slowest dimension first. Returns an empty vector if there are fewer than two. Throws
// BadValue if their product is not the size, but for a single one of 0 or 1.
std::vector<std::uint64_t> shape_of_grid(const NetcdfReader& file, const VariableInFile& lengths,
                                         std::uint64_t size);

}  // namespace rondel::io
