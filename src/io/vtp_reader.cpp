// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the triangles of a .vtp file whose arrays are appended raw and not compressed, as Rondel
// writes them and VTK can. The arrays of the polygons are found by their tags; the rest of the XML
// is ignored.
#include <bit>
#include <functional>
#include <optional>

#include "io/binary.h"
#include "io/number.h"
#include "io/triangle_formats.h"

namespace rondel::io {
namespace {

// Goes through the tags of an XML text.
class Tags {
 public:
  explicit Tags(std::string_view text) : rest_(text) {}

  // Returns the next tag that starts with `name`, without the angle brackets.
  std::optional<std::string_view> next(std::string_view name) {
    while (true) {
      const std::size_t open = rest_.find('<');
      if (open == std::string_view::npos) return std::nullopt;
      rest_.remove_prefix(open + 1);
      if (!rest_.starts_with(name)) continue;
      const std::size_t close = rest_.find('>');
      if (close == std::string_view::npos) return std::nullopt;
      const std::string_view tag = rest_.substr(0, close);
      rest_.remove_prefix(close + 1);
      return tag;
    }
  }

  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

// Returns the value of an attribute of a tag; an empty text if it has none.
std::string_view attribute(std::string_view tag, std::string_view name) {
  std::string key(1, ' ');
  (key += name) += "=\"";
  const std::size_t start = tag.find(key);
  if (start == std::string_view::npos) return {};
  tag.remove_prefix(start + key.size());
  return tag.substr(0, tag.find('"'));
}

// An array of integers of any width.
struct Integers {
  std::size_t size = 0;
  std::function<Index(std::size_t)> at;
};

// The arrays that are appended to the XML.
class AppendedData {
 public:
  AppendedData(std::string_view bytes, std::string_view file_tag)
      : bytes_(bytes),
        order_(attribute(file_tag, "byte_order") == "BigEndian" ? std::endian::big
                                                                : std::endian::little),
        has_long_header_(attribute(file_tag, "header_type") == "UInt64") {}

  // Returns the array that a DataArray tag describes.
  [[nodiscard]] Integers array(std::string_view tag) const {
    const std::string_view type = attribute(tag, "type");
    if (attribute(tag, "format") != "appended") throw BadValue("data that is not appended raw");
    const std::string_view data = block(parse_integer(attribute(tag, "offset"), "offset"));
    if (type == "Int32") return values<std::int32_t>(data);
    if (type == "UInt32") return values<std::uint32_t>(data);
    if (type == "Int64") return values<std::int64_t>(data);
    if (type == "UInt64") return values<std::uint64_t>(data);
    throw BadValue("indices of type " + in_quotes(type));
  }

 private:
  // Returns the bytes behind the length that is stored at `offset`.
  [[nodiscard]] std::string_view block(std::int64_t offset) const {
    const std::size_t head = has_long_header_ ? 8 : 4;
    if (offset < 0 || bytes_.size() < head ||
        static_cast<std::uint64_t>(offset) > bytes_.size() - head) {
      throw BadValue("the file is cut off");
    }
    const char* const p = bytes_.data() + offset;
    const std::uint64_t length =
        has_long_header_ ? load<std::uint64_t>(p, order_) : load<std::uint32_t>(p, order_);
    const std::size_t start = static_cast<std::size_t>(offset) + head;
    if (length > bytes_.size() - start) throw BadValue("the file is cut off");
    return bytes_.substr(start, length);
  }

  template <typename Integer>
  [[nodiscard]] Integers values(std::string_view data) const {
    return {data.size() / sizeof(Integer), [data, order = order_](std::size_t i) {
              return checked_index(load<Integer>(data.data() + i * sizeof(Integer), order));
            }};
  }

  std::string_view bytes_;
  std::endian order_;
  bool has_long_header_;
};

// Returns the polygons, which must be triangles.
std::vector<Triple> triangles_of(const Integers& connectivity, const Integers& offsets) {
  std::vector<Triple> triangles;
  triangles.reserve(offsets.size);
  for (std::size_t i = 0; i < offsets.size; ++i) {
    if (offsets.at(i) != 3 * (i + 1)) {
      throw BadValue("polygon " + std::to_string(i) + " is not a triangle");
    }
    if (3 * i + 2 >= connectivity.size) throw BadValue("polygons without corners");
    triangles.push_back(
        {connectivity.at(3 * i), connectivity.at(3 * i + 1), connectivity.at(3 * i + 2)});
  }
  return triangles;
}

}  // namespace

std::vector<Triple> read_vtp(std::string_view bytes) {
  Tags tags(bytes);
  const auto file_tag = tags.next("VTKFile");
  if (!file_tag || attribute(*file_tag, "type") != "PolyData") throw BadValue("not a .vtp file");
  if (!attribute(*file_tag, "compressor").empty()) throw BadValue("compressed data is not read");
  Tags search = tags;
  const auto appended = search.next("AppendedData");
  const std::size_t underscore = search.rest().find('_');
  if (!appended || attribute(*appended, "encoding") != "raw" ||
      underscore == std::string_view::npos) {
    throw BadValue("data that is not appended raw");
  }
  const AppendedData data(search.rest().substr(underscore + 1), *file_tag);
  if (!tags.next("Polys")) throw BadValue("no polygons");
  std::optional<Integers> connectivity;
  std::optional<Integers> offsets;
  while (!(connectivity && offsets)) {
    const auto tag = tags.next("DataArray");
    if (!tag || tag->data() > appended->data()) throw BadValue("polygons without their arrays");
    const std::string_view name = attribute(*tag, "Name");
    if (name == "connectivity") connectivity = data.array(*tag);
    if (name == "offsets") offsets = data.array(*tag);
  }
  const auto second_piece = tags.next("Piece");
  if (second_piece && second_piece->data() < appended->data()) {
    throw BadValue("more than one piece");
  }
  return triangles_of(*connectivity, *offsets);
}

}  // namespace rondel::io
