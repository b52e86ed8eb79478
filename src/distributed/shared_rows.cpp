// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rank 0 makes the file with its header and its full size; each rank then writes at the place of
// its first row. The shape decides the type of the numbers: doubles, or 32 or 64 bits.

#include "distributed/shared_rows.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <span>
#include <system_error>
#include <utility>

#include "distributed/row_file.h"
#include "io/atomic_file.h"
#include "io/binary.h"
#include "io/npy_header.h"
#include "rondel/error.h"
#include "system/descriptor.h"

namespace rondel::distributed {

SharedRows::SharedRows(BspSession& session, const std::string& path, const SharedShape& shape)
    : path_(path),
      target_(io::replaced_by(path)),
      is_maker_(session.rank() == 0),
      is_narrow_(!shape.are_doubles && are_narrow(shape.num_different)) {
  const std::string header = header_of(shape);
  const std::uint64_t row_bytes = shape.num_columns * (is_narrow_ ? 4 : 8);
  try {
    if (is_maker_) make(header, header.size() + shape.num_rows * row_bytes);
    take_name(session.all_gather(name_message()).front());
    if (!is_maker_) descriptor_ = system::open_to_change(temporary_);
    if (descriptor_ < 0) fail(errno);
  } catch (...) {
    close();
    throw;
  }
  place_ = header.size() + shape.first_row * row_bytes;
}

SharedRows::~SharedRows() { close(); }

std::string SharedRows::header_of(const SharedShape& shape) const {
  const std::array<std::uint64_t, 2> sizes = {shape.num_rows, shape.num_columns};
  const char* const type = shape.are_doubles ? "<f8" : is_narrow_ ? "<u4" : "<i8";
  return io::make_npy_header(type, std::span(sizes).first(shape.num_columns == 1 ? 1 : 2));
}

Bytes SharedRows::name_message() const {
  MessageWriter writer;
  writer.add_values(std::span<const char>(temporary_));
  return writer.take();
}

void SharedRows::take_name(const Bytes& message) {
  const auto name = std::span(message).subspan(1);
  temporary_.assign(reinterpret_cast<const char*>(name.data()), name.size());
}

void SharedRows::make(const std::string& header, std::uint64_t num_bytes) {
  do {
    temporary_ = io::temporary_name(target_.substr(0, target_.find_last_of("/\\") + 1));
    descriptor_ = io::open_replacement(temporary_, target_);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0 || system::reserve(descriptor_, num_bytes) != 0) fail(errno);
  write(header);
}

void SharedRows::finish() {
  write_buffer();
  const int descriptor = std::exchange(descriptor_, -1);
  if (system::close(descriptor) != 0) fail(errno);
}

void SharedRows::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) throw FileError(path_ + ": " + error.message());
  temporary_.clear();
}

void SharedRows::write_buffer() {
  write(io::NumberBytes(narrow_));
  write(io::NumberBytes(wide_));
  write(io::NumberBytes(doubles_));
  narrow_.clear();
  wide_.clear();
  doubles_.clear();
}

void SharedRows::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t count = system::write_at(descriptor_, place_, bytes);
    if (count < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
    place_ += static_cast<std::uint64_t>(count);
  }
}

void SharedRows::close() {
  if (descriptor_ >= 0) system::close(std::exchange(descriptor_, -1));
  std::error_code ignored;
  if (is_maker_ && !temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void SharedRows::fail(int error) const {
  throw FileError(path_, std::error_code(error, std::generic_category()));
}

}  // namespace rondel::distributed
