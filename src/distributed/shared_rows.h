// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A .npy file that several ranks write, each its own successive rows. Rank 0 creates it under a
// temporary name, and gives it its name when all ranks have written their rows.
//
// in    the rows of each rank
// out   one file
// index rows of the file
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "distributed/bsp_session.h"

namespace rondel::distributed {

// The array that all ranks write, and the rows of this rank.
struct SharedShape {
  std::uint64_t num_rows = 0;       // rows of all ranks
  std::uint64_t num_columns = 0;    // with 1 the array has one dimension
  std::uint64_t num_different = 0;  // numbers are less than this
  std::uint64_t first_row = 0;      // first row of this rank
  bool are_doubles = false;
};

// Writes the rows of this rank.
class SharedRows {
 public:
  // All ranks call this together. Every function throws FileError if the operation fails.
  SharedRows(BspSession& session, const std::string& path, const SharedShape& shape);
  // Removes the file if it has not got its name yet.
  ~SharedRows();
  SharedRows(const SharedRows&) = delete;
  SharedRows& operator=(const SharedRows&) = delete;

  // Appends a number, or a double if are_doubles.
  void add(std::uint64_t number) {
    if (is_narrow_) {
      narrow_.push_back(static_cast<std::uint32_t>(number));
    } else {
      wide_.push_back(static_cast<std::int64_t>(number));
    }
    if (narrow_.size() + wide_.size() == buffer_size) write_buffer();
  }
  void add(double number) {
    doubles_.push_back(number);
    if (doubles_.size() == buffer_size) write_buffer();
  }

  // Writes the rest. Call it when all rows of this rank have been added.
  void finish();
  // Gives the file its name. Rank 0 calls this when all ranks have finished.
  void commit();

 private:
  static constexpr std::size_t buffer_size = std::size_t{1} << 18;

  // Rank 0 creates the file and tells the others its name.
  void make(const std::string& header, std::uint64_t num_bytes);
  // Returns the message with the temporary name.
  [[nodiscard]] Bytes name_message() const;
  // Takes the temporary name out of rank 0's message.
  void take_name(const Bytes& message);
  // Returns the header of the .npy file.
  [[nodiscard]] std::string header_of(const SharedShape& shape) const;
  void write_buffer();
  void write(std::string_view bytes);
  void close();
  [[noreturn]] void fail(int error) const;

  std::string path_;
  std::string target_;  // path_ with symbolic links resolved
  std::string temporary_;
  bool is_maker_;
  bool is_narrow_;
  int descriptor_ = -1;
  std::uint64_t place_ = 0;
  std::vector<std::uint32_t> narrow_;
  std::vector<std::int64_t> wide_;
  std::vector<double> doubles_;
};

}  // namespace rondel::distributed
