// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes netCDF files from front to back: the classic formats by own code, netCDF-4 by netCDF-C.
//
// in    definitions, then the values of each variable in the order of definition
// out   a file
// index dimensions and variables in the order in which they were added
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "io/binary.h"
#include "io/netcdf_format.h"
#include "io/parallel_write.h"
#include "rondel/io.h"

namespace rondel::io {

class Netcdf4Output;

// The classic formats are tried in their order: CDF-1, which everything reads; CDF-2 if a variable
// starts beyond 2 GiB; CDF-5 if a variable has 64-bit integers, 4 GiB or more, or a dimension of
// 2^31 or more.
//
// First come the definitions, then begin(), then the values of all variables in the order of their
// definition, in any number of pieces, then finish(). Equal calls give equal bytes; for netCDF-4,
// with the same library. A dimension of size 0 is the dimension of records, of which there are
// none; there may be one such dimension.
//
// A dimension may be unlimited, so that others can append records. In a classic file that is one,
// the first that is the first dimension of all variables that have it; more are limited there, and
// so are all in a file that is written directly, since records of variables take turns. remarks()
// names them.
class NetcdfWriter {
 public:
  explicit NetcdfWriter(AtomicFile& file);
  ~NetcdfWriter();
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;

  // Returns the number by which variables refer to the dimension.
  std::size_t add_dimension(std::string name, std::uint64_t size, bool is_unlimited = false);
  void add_attribute(std::string name, std::string text);
  void add_attribute(NetcdfAttribute attribute);
  void add_variable(NetcdfVariable variable);

  // Return what has been added.
  [[nodiscard]] const std::vector<NetcdfDimension>& dimensions() const { return dimensions_; }
  [[nodiscard]] const std::vector<NetcdfAttribute>& attributes() const { return attributes_; }
  [[nodiscard]] const std::vector<NetcdfVariable>& variables() const { return variables_; }

  // Writes the header of this version, 1, 2 or 5; with 0, the lowest version that suffices. Throws
  // BadValue if the version does not suffice.
  void begin(int version = 0);
  // Writes a header of the kind that the options name; if they name none, of the lowest classic
  // format that can hold the variables. So many threads compress. Also throws BadValue if netCDF-C is
  // needed and not installed.
  void begin(const NetcdfOptions& options, unsigned threads = 1);
  // Returns a sentence that names the dimensions that are limited, though they should not be; after
  // begin().
  [[nodiscard]] std::vector<std::string> remarks() const;

  // Writes the next values of the variable. T must be its type: char, int8_t, int32_t, int64_t,
  // float or double.
  template <typename T>
  void write(std::span<const T> values) {
    write_values<T>(values.size(), [&](std::size_t i) { return values[i]; });
  }
  // Writes value(0), ..., value(count - 1) as the next values.
  template <typename T, typename Value>
  void write_values(std::size_t count, Value value) {
    std::array<T, 4096> block;
    for (std::size_t start = 0; start < count; start += block.size()) {
      const std::size_t size = std::min(block.size(), count - start);
      for (std::size_t i = 0; i < size; ++i) block[i] = static_cast<T>(value(start + i));
      write_block(std::span<const T>(block.data(), size));
    }
  }

  // Writes rows of `row_size` values. Several threads call fill(begin, end, values), which computes
  // rows begin ... end - 1; the values are 0 before.
  template <typename T, typename Fill>
  void write_rows(unsigned threads, std::size_t rows, std::size_t row_size, const Fill& fill) {
    const std::size_t of_row = std::max<std::size_t>(row_size, 1) * sizeof(T);
    const std::size_t of_piece = std::max<std::size_t>(bytes_per_piece / of_row, 1);
    if (netcdf4_ != nullptr || records_ != no_dimension) {
      for (std::size_t begin = 0; begin < rows; begin += of_piece) {
        const std::size_t end = std::min(rows, begin + of_piece);
        std::vector<T>& values = values_of_rows<T>();
        values.assign((end - begin) * row_size, T{});
        fill(begin, end, values.data());
        write_block(std::span<const T>(values));
      }
      return;
    }
    find_room();
    write_in_parallel(file_, threads, rows, of_piece,
                      [&](std::string& text, std::size_t begin, std::size_t end) {
                        std::vector<T>& values = values_of_rows<T>();
                        values.assign((end - begin) * row_size, T{});
                        fill(begin, end, values.data());
                        text.resize(values.size() * sizeof(T));
                        store_all(std::span<const T>(values), text.data(), std::endian::big);
                      });
    count_bytes(static_cast<std::uint64_t>(rows) * row_size * sizeof(T));
  }

  // Ends the file. Precondition: all values have been written.
  void finish();

 private:
  // The size of what a thread computes at a time, so that it stays in the cache; at least one row.
  static constexpr std::size_t bytes_per_piece = std::size_t{1} << 18U;
  // Each thread keeps its buffer, since allocating it for every piece would take as long as filling
  // it.
  template <typename T>
  static std::vector<T>& values_of_rows() {
    thread_local std::vector<T> values;
    return values;
  }

  static constexpr std::size_t no_dimension = ~std::size_t{0};

  // Chooses the dimension of records of a classic file.
  void choose_records();
  // True if the variable has a record for each index of its first dimension.
  [[nodiscard]] bool is_of_records(const NetcdfVariable& variable) const;
  // Returns the bytes of one record of a variable, without the padding.
  [[nodiscard]] std::uint64_t size_of_record(const NetcdfVariable& variable) const;
  // Returns the bytes of one record of all variables.
  [[nodiscard]] std::uint64_t size_of_records() const;
  // Returns the offset of each variable after a header of this size.
  [[nodiscard]] std::vector<std::uint64_t> offsets(std::uint64_t first_offset) const;
  // Returns the bytes of a variable's values.
  [[nodiscard]] std::uint64_t size_of_values(const NetcdfVariable& variable) const;
  // Returns the lowest version that can hold the definitions.
  [[nodiscard]] int needed_version() const;
  // Throws BadValue if classic netCDF cannot hold the dimensions of length 0.
  void require_records() const;
  // Returns the header, where the first variable begins at `first_offset`.
  [[nodiscard]] std::string header(int version, std::uint64_t first_offset) const;
  template <typename T>
  void write_block(std::span<const T> values) {
    if (netcdf4_ != nullptr) {
      write_netcdf4(values.data(), values.size_bytes());
    } else {
      write_bytes(NumberBytes(values, std::endian::big));
    }
  }
  void write_netcdf4(const void* values, std::size_t num_bytes);
  // Tells the system the size of the file, before the first rows.
  void find_room();
  void write_bytes(std::string_view bytes);
  // Writes bytes of the current variable, where records take turns.
  void write_records(std::string_view bytes);
  // Counts bytes of the current variable, and ends it when it is full.
  void count_bytes(std::uint64_t size);
  // Pads variables that are full, and goes to the next one.
  void end_full_variables();

  AtomicFile& file_;
  std::unique_ptr<Netcdf4Output> netcdf4_;  // null for a classic file
  std::vector<NetcdfDimension> dimensions_;
  std::vector<NetcdfAttribute> attributes_;
  std::vector<NetcdfVariable> variables_;
  std::size_t current_ = 0;             // the variable whose values are next
  std::uint64_t num_written_ = 0;       // bytes of its values so far
  std::uint64_t expected_ = 0;          // bytes of the file, until the system has been told
  std::size_t records_ = no_dimension;  // the dimension of records, if there are some
  std::vector<std::uint64_t> places_;   // offsets of the variables, if records take turns
  std::uint64_t end_ = 0;               // of the file, if records take turns
};

}  // namespace rondel::io
