// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/npy_header.h"

#include <algorithm>
#include <charconv>

#include "io/number.h"
#include "system/checked_product.h"

namespace rondel::io {
namespace {

constexpr std::string_view magic = "\x93NUMPY";

// Parses the few Python literals that a header may contain.
class Literals {
 public:
  explicit Literals(std::string_view text) : text_(text) {}

  // Takes `token` if it comes next; returns false otherwise.
  bool take(std::string_view token) {
    text_.remove_prefix(std::min(text_.find_first_not_of(" \t\n"), text_.size()));
    if (!text_.starts_with(token)) return false;
    text_.remove_prefix(token.size());
    return true;
  }

  // Takes a token that has to come next.
  void require(std::string_view token) {
    if (!take(token)) throw BadValue("the .npy header is damaged");
  }

  std::string string() {
    const std::string_view quote = take("'") ? "'" : "\"";
    if (quote == "\"") require(quote);
    const std::size_t end = text_.find(quote);
    std::string value(text_.substr(0, end));
    text_.remove_prefix(std::min(end, text_.size()));
    require(quote);
    return value;
  }

  bool boolean() {
    if (take("True")) return true;
    require("False");
    return false;
  }

  std::vector<std::uint64_t> tuple() {
    std::vector<std::uint64_t> values;
    require("(");
    while (!take(")")) {
      std::uint64_t value = 0;
      take("");  // skips blanks
      const auto [stop, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
      if (error != std::errc{}) throw BadValue("the shape in the .npy header is damaged");
      text_.remove_prefix(static_cast<std::size_t>(stop - text_.data()));
      values.push_back(value);
      if (!take(",")) {
        require(")");
        break;
      }
    }
    return values;
  }

 private:
  std::string_view text_;
};

// Parses the dictionary, which has exactly these keys in any order.
void parse_dictionary(std::string_view text, NpyHeader& header) {
  Literals literals(text);
  unsigned seen = 0;
  literals.require("{");
  while (!literals.take("}")) {
    const std::string key = literals.string();
    literals.require(":");
    if (key == "descr") {
      if (literals.take("[")) throw BadValue("a structured dtype where plain numbers are needed");
      header.dtype = literals.string();
      seen |= 1U;
    } else if (key == "fortran_order") {
      header.is_fortran_order = literals.boolean();
      seen |= 2U;
    } else if (key == "shape") {
      header.shape = literals.tuple();
      seen |= 4U;
    } else {
      throw BadValue("unknown key " + in_quotes(key) + " in the .npy header");
    }
    if (!literals.take(",")) {
      literals.require("}");
      break;
    }
  }
  if (seen != 7U) throw BadValue("the .npy header is incomplete");
}

}  // namespace

NpyHeader parse_npy_header(std::string_view bytes) {
  if (!bytes.starts_with(magic)) throw BadValue("not a .npy file");
  if (bytes.size() < 12) throw BadValue("the .npy header is cut off");
  const unsigned major = static_cast<unsigned char>(bytes[6]);
  if (major < 1 || major > 3) {
    throw BadValue(".npy version " + std::to_string(major) + " is not supported");
  }
  const std::size_t start = major == 1 ? 10 : 12;
  const std::size_t length =
      major == 1 ? load<std::uint16_t>(bytes.data() + 8) : load<std::uint32_t>(bytes.data() + 8);
  if (length > bytes.size() - start) throw BadValue("the .npy header is cut off");
  NpyHeader header;
  header.data_offset = start + length;
  parse_dictionary(bytes.substr(start, length), header);
  return header;
}

std::string shape_text(std::span<const std::uint64_t> shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(shape[i]);
  }
  return text + (shape.size() == 1 ? ",)" : ")");
}

std::string make_npy_header(std::string_view dtype, std::span<const std::uint64_t> shape) {
  std::string dictionary = "{'descr': '" + std::string(dtype) +
                           "', 'fortran_order': False, 'shape': " + shape_text(shape) + ", }";
  const std::size_t unpadded = magic.size() + 4 + dictionary.size() + 1;
  dictionary.append((64 - unpadded % 64) % 64, ' ');
  dictionary += '\n';
  std::string header(magic);
  header += '\x01';
  header += '\x00';
  header += static_cast<char>(dictionary.size() & 0xFFU);
  header += static_cast<char>(dictionary.size() >> 8U);
  return header + dictionary;
}

NpyTable::NpyTable(std::string_view bytes, std::uint64_t file_size,
                   std::span<const std::string_view> types, std::string_view needed)
    : header_(parse_npy_header(bytes)) {
  const std::string_view dtype = header_.dtype;
  const bool has_order = dtype.starts_with('<') || dtype.starts_with('>') ||
                         (dtype.starts_with('|') && dtype.ends_with('1'));
  if (!has_order || std::ranges::find(types, type()) == types.end()) {
    throw BadValue("dtype " + in_quotes(dtype) + " where " + std::string(needed) + " is needed");
  }
  if (header_.shape.size() != 2) {
    throw BadValue("shape " + shape() + " where two dimensions are needed");
  }
  if (dtype[0] == '>') order_ = std::endian::big;
  data_ = bytes.data() + header_.data_offset;
  check_size(file_size - header_.data_offset);
}

NpyTable NpyTable::piece(std::string_view bytes, std::size_t num_rows) const {
  NpyTable piece = *this;
  piece.header_.shape[0] = num_rows;
  piece.data_ = bytes.data();
  return piece;
}

// Throws BadValue if the shape does not match the size of the file, before anything is allocated.
void NpyTable::check_size(std::uint64_t num_bytes) const {
  std::uint64_t needed = 0;
  if (!system::multiply_checked(header_.shape[0], header_.shape[1], needed) ||
      !system::multiply_checked(needed, item_size(), needed)) {
    throw BadValue("shape " + shape() + " is too large");
  }
  if (needed != num_bytes) {
    throw BadValue("shape " + shape() + " needs " + std::to_string(needed) +
                   " bytes, the file has " + std::to_string(num_bytes));
  }
}

}  // namespace rondel::io
