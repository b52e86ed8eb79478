// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files of netCDF: of the classic formats, read in place; of netCDF-4 (HDF5), read by netCDF-C where it is installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file_bytes.h"
#include "io/netcdf_format.h"
#include "rondel/export.h"

namespace rondel::io {

class Netcdf4File;
struct NetcdfHeader;

// `count[d]` places from `start[d]` on along dimension d of a variable.
struct NetcdfBox {
  std::vector<std::size_t> start;
  std::vector<std::size_t> count;
};

// Whether the bytes that a file begins with are those of a netCDF file, of any of its formats.
RONDEL_API bool is_netcdf(std::string_view head);

// A file of netCDF-4 has what the classic formats have, and more:
// 1. Variables of a group are called "group/name", and come after those of the file itself, as do dimensions.
// 2. A variable of strings is of the type text. Its values are not read.
// 3. An attribute of several strings is a text with spaces between them.
// 4. Variables and attributes of types that the file defines itself are left out; require() tells so of such a variable.
class RONDEL_API NetcdfReader {
 public:
  struct Variable : NetcdfVariable {
    std::vector<std::uint64_t> shape;  // of records as many as there are
    std::uint64_t offset = 0;          // in the file
    bool has_records = false;
    std::uint64_t record_values = 0;  // values in a record; else all
    std::uint64_t num_values = 0;
    int group = 0;  // netCDF-4: the numbers that netCDF-C has for its group and for itself
    int number = 0;
  };

  // Reads the header and holds it against the bytes, which live as long as this. Throws BadValue:
  // nothing is allocated for what a count claims before the bytes can have it, and every value of every
  // variable is there. netCDF-4 is compressed, and is held against what compression can do.
  explicit NetcdfReader(std::string_view bytes);
  // The same of a file, which lives as long as this, of which only the header is in memory, and values are read when they are
  // asked for; all of it, where its size is not known. Throws FileError, too.
  explicit NetcdfReader(FileBytes& file);

  [[nodiscard]] std::uint64_t num_bytes() const { return size_; }
  // No variable has more values than this: as many as there are bytes, or as compression can make of these.
  [[nodiscard]] std::uint64_t most_values() const;
  [[nodiscard]] std::span<const NetcdfDimension> dimensions() const { return dimensions_; }
  [[nodiscard]] std::span<const NetcdfAttribute> attributes() const { return attributes_; }
  [[nodiscard]] std::span<const Variable> variables() const { return variables_; }
  // Null if there is none.
  [[nodiscard]] const Variable* find(std::string_view name) const;
  // Throws BadValue if there is none, or none of a type that is read.
  [[nodiscard]] const Variable& require(std::string_view name) const;

  // All values as doubles. Throws BadValue if they are a text.
  // Integers of 64 bits that are no doubles are NaN if they are missing, as wide_integers.h says; otherwise BadValue is thrown.
  [[nodiscard]] std::vector<double> numbers(const Variable& variable) const;
  // The same, but those that are no doubles are rounded. Sets `is_rounded` if there are some.
  [[nodiscard]] std::vector<double> rounded_numbers(const Variable& variable,
                                                    bool& is_rounded) const;
  // Throws BadValue if the variable is a text, or has more values than the file can have: before there is room for them.
  void require_room(const Variable& variable) const;
  // As many as there is room for, from this one on. Throws BadValue as numbers() and integers() do.
  void read_numbers(const Variable& variable, std::uint64_t begin, std::span<double> out) const;
  void read_integers(const Variable& variable, std::uint64_t begin,
                     std::span<std::int64_t> out) const;
  // The numbers of a box of one value or more, its last dimension changing fastest. Throws BadValue as numbers() does.
  void read_box(const Variable& variable, const NetcdfBox& box, std::span<double> out) const;
  // The lengths along its dimensions of the chunks that are compressed one by one; 1 where there are none.
  [[nodiscard]] std::vector<std::uint64_t> chunk_of(const Variable& variable) const;
  // The same as integers. Throws BadValue if they are a text, are floating, or are beyond 2^63.
  [[nodiscard]] std::vector<std::int64_t> integers(const Variable& variable) const;

 private:
  void take(NetcdfHeader&& header);
  void parse(std::string_view head);
  static void require_numbers(const Variable& variable);
  [[nodiscard]] std::uint64_t place(const Variable& variable, std::uint64_t index) const;
  // Those of 64 bits, uint64 as bits.
  void read_wide(const Variable& variable, std::uint64_t begin, std::span<std::int64_t> out) const;
  template <typename T, typename Out>
  void copy(const Variable& variable, std::uint64_t begin, std::span<Out> out) const;
  void place_records(std::uint64_t claimed);

  std::string_view bytes_;
  const FileBytes* file_ = nullptr;  // where the bytes are not in memory
  std::shared_ptr<const Netcdf4File> netcdf4_;
  std::uint64_t size_ = 0;
  std::vector<NetcdfDimension> dimensions_;
  std::vector<NetcdfAttribute> attributes_;
  std::vector<Variable> variables_;
  std::vector<std::string> passed_over_;
  std::uint64_t record_size_ = 0;
};

// The text of an attribute; empty if there is none, or it is a number.
RONDEL_API std::string netcdf_text(std::span<const NetcdfAttribute> attributes,
                                   std::string_view name);
// The attribute; null if there is none.
RONDEL_API const NetcdfAttribute* find_attribute(std::span<const NetcdfAttribute> attributes,
                                                 std::string_view name);

// The lengths of a grid of `size` cells, which SCRIP names from the fastest one on, in the order of arrays, the slowest one
// first; empty if there is one or none, which says nothing. Throws BadValue if several do not multiply to the size.
RONDEL_API std::vector<std::uint64_t> shape_of_grid(const NetcdfReader& file,
                                                    const NetcdfReader::Variable& lengths,
                                                    std::uint64_t size);

}  // namespace rondel::io
