// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/ply_header.h"

#include <array>
#include <span>
#include <utility>

#include "io/number.h"
#include "io/text_lines.h"

namespace rondel::io {
namespace {

using Words = std::span<const std::string_view>;

// Returns the type of this name. Throws BadValue for other names.
PlyType type_of(std::string_view name) {
  // Every type has an old and a new name.
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> types = {
      {{"char", PlyType::int8},
       {"int8", PlyType::int8},
       {"uchar", PlyType::uint8},
       {"uint8", PlyType::uint8},
       {"short", PlyType::int16},
       {"int16", PlyType::int16},
       {"ushort", PlyType::uint16},
       {"uint16", PlyType::uint16},
       {"int", PlyType::int32},
       {"int32", PlyType::int32},
       {"uint", PlyType::uint32},
       {"uint32", PlyType::uint32},
       {"float", PlyType::float32},
       {"float32", PlyType::float32},
       {"double", PlyType::float64},
       {"float64", PlyType::float64}}};
  for (const auto& [known, type] : types) {
    if (known == name) return type;
  }
  throw BadValue("unknown type " + in_quotes(name) + " in the header");
}

// Returns the encoding of this name. Throws BadValue for other names.
PlyEncoding encoding_of(std::string_view name) {
  if (name == "ascii") return PlyEncoding::ascii;
  if (name == "binary_little_endian") return PlyEncoding::little_endian;
  if (name == "binary_big_endian") return PlyEncoding::big_endian;
  throw BadValue("unknown format " + in_quotes(name));
}

// Reads the line of a property.
PlyProperty property_of(Words words) {
  PlyProperty property;
  property.is_list = words.size() == 5 && words[1] == "list";
  if (!property.is_list && words.size() != 3) throw BadValue("a damaged property in the header");
  if (property.is_list) property.size_type = type_of(words[2]);
  property.type = type_of(words[words.size() - 2]);
  property.name = words.back();
  return property;
}

// Parses a line of the header; returns false at its end.
bool parse_line(Words words, PlyHeader& header, bool& has_format) {
  if (words[0] == "end_header") return false;
  if (words[0] == "format" && words.size() >= 2) {
    header.encoding = encoding_of(words[1]);
    has_format = true;
  } else if (words[0] == "element" && words.size() == 3) {
    const std::int64_t count = parse_integer(words[2], "the number of elements");
    if (count < 0) throw BadValue("a negative number of elements");
    header.elements.push_back({std::string(words[1]), static_cast<std::uint64_t>(count), {}});
  } else if (words[0] == "property" && !header.elements.empty()) {
    header.elements.back().properties.push_back(property_of(words));
  } else if (words[0] != "comment" && words[0] != "obj_info") {
    throw BadValue("unknown line " + in_quotes(words[0]) + " in the header");
  }
  return true;
}

}  // namespace

PlyHeader parse_ply_header(std::string_view bytes) {
  TextLines lines(bytes);
  if (!lines.next() || lines.words()[0] != "ply") throw BadValue("not a .ply file");
  PlyHeader header;
  bool has_format = false;
  while (lines.next() && parse_line(lines.words(), header, has_format)) {
  }
  if (lines.words().empty()) throw BadValue("the header does not end");
  if (!has_format) throw BadValue("the header has no format");
  header.data_offset = lines.position();
  return header;
}

}  // namespace rondel::io
