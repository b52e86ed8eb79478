// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Parses the header of a Stanford .ply file: a list of elements, each with a list of properties.
//
// in    the bytes of a file
// out   elements and properties in the order in which the body has them
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rondel::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

// A number that each member of an element has, or a list of numbers.
struct PlyProperty {
  std::string name;
  PlyType type{};
  bool is_list = false;
  PlyType size_type{};  // type of the length of a list
};

// A kind of members, such as "vertex" or "face".
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding{};
  std::vector<PlyElement> elements;
  std::size_t data_offset = 0;
};

// Throws BadValue if the header is not valid.
PlyHeader parse_ply_header(std::string_view bytes);

}  // namespace rondel::io
