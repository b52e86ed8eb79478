// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>

#include "io/binary.h"
#include "io/number.h"
#include "io/ply_header.h"
#include "io/text_lines.h"
#include "io/triangle_formats.h"

namespace rondel::io {
namespace {

// Reads the numbers of the body one after the other. A double represents each of PLY's types
// exactly.
class PlyNumbers {
 public:
  PlyNumbers(std::string_view body, PlyEncoding encoding)
      : body_(body),
        order_(encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little),
        is_ascii_(encoding == PlyEncoding::ascii),
        lines_(body) {}

  // Returns the next number, which has this type in a binary file.
  double next(PlyType type) {
    if (is_ascii_) return next_word();
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return static_cast<double>(take<float>());
      case PlyType::float64:
        break;
    }
    return take<double>();
  }

  // Returns the next number, which must be an integer.
  std::int64_t next_integer(PlyType type) {
    const double value = next(type);
    if (!(std::abs(value) < 0x1p62) || value != std::floor(value)) {
      throw BadValue("a number that is not an integer where one is needed");
    }
    return static_cast<std::int64_t>(value);
  }

 private:
  template <typename T>
  T take() {
    if (body_.size() < sizeof(T)) throw BadValue("the file is cut off");
    const T value = load<T>(body_.data(), order_);
    body_.remove_prefix(sizeof(T));
    return value;
  }

  double next_word() {
    if (word_ == lines_.words().size()) {
      if (!lines_.next()) throw BadValue("the file is cut off");
      word_ = 0;
    }
    return parse_number(lines_.words()[word_++], "value");
  }

  std::string_view body_;
  std::endian order_;
  bool is_ascii_;
  TextLines lines_;
  std::size_t word_ = 0;
};

// Skips a property of an element.
void skip(PlyNumbers& numbers, const PlyProperty& property) {
  const std::int64_t size = property.is_list ? numbers.next_integer(property.size_type) : 1;
  for (std::int64_t i = 0; i < size; ++i) numbers.next(property.type);
}

// True if the property is the list of a face's corners.
bool has_corners(const PlyProperty& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

// Reads the corners of a face, which must be a triangle.
Triple read_corners(PlyNumbers& numbers, const PlyProperty& property) {
  const std::int64_t size = numbers.next_integer(property.size_type);
  if (size != 3) {
    throw BadValue("a face with " + std::to_string(size) + " corners where a triangle is needed");
  }
  Triple corners{};
  for (Index& corner : corners) corner = checked_index(numbers.next_integer(property.type));
  return corners;
}

// Reads the elements up to the faces, and returns these.
std::vector<Triple> read_body(std::string_view bytes, const PlyHeader& header) {
  PlyNumbers numbers(bytes.substr(header.data_offset), header.encoding);
  for (const PlyElement& element : header.elements) {
    const bool is_face = element.name == "face";
    if (is_face && std::ranges::none_of(element.properties, has_corners)) break;
    if (element.properties.empty()) continue;
    std::vector<Triple> triangles;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      at_item(element.name, i, [&] {
        for (const PlyProperty& property : element.properties) {
          if (is_face && has_corners(property)) {
            triangles.push_back(read_corners(numbers, property));
          } else {
            skip(numbers, property);
          }
        }
      });
    }
    if (is_face) return triangles;
  }
  throw BadValue("no faces with vertex_indices");
}

}  // namespace

std::vector<Triple> read_ply(std::string_view bytes) {
  return read_body(bytes, parse_ply_header(bytes));
}

}  // namespace rondel::io
