// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/arrow_levels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

#include "io/json_tree.h"
#include "rondel/error.h"
#include "system/row_assembly.h"

namespace rondel::formats {

void refuse_arrow(const std::string& what) { throw InvalidInput("the array of Arrow " + what); }

namespace {

// Returns a value of the metadata of a field: pairs of texts, each after its length.
std::string_view metadata_of(const char* metadata, std::string_view wanted) {
  if (metadata == nullptr) return {};
  const auto number = [&] {
    std::int32_t value = 0;
    std::memcpy(&value, metadata, sizeof value);
    metadata += sizeof value;
    return value;
  };
  const auto text = [&] {
    const auto size = static_cast<std::size_t>(number());
    const std::string_view found(metadata, size);
    metadata += size;
    return found;
  };
  for (std::int32_t pairs = number(); pairs > 0; --pairs) {
    const std::string_view key = text();
    const std::string_view value = text();
    if (key == wanted) return value;
  }
  return {};
}

// Refuses an array whose metadata of GeoArrow name other coordinates than longitudes and latitudes.
void require_lonlat(const std::string& metadata) {
  if (metadata.empty()) return;
  io::JsonTreeBuilder builder({[](auto&&...) {}, [](auto&&...) { return false; }});
  try {
    nlohmann::json::sax_parse(metadata, &builder);
  } catch (const io::BadValue& error) {
    refuse_arrow(std::string("has metadata of its type that cannot be read: ") + error.what());
  }
  const io::JsonTree& crs = builder.root().member("crs");
  if (crs.is_null()) return;
  // The definition of a CRS (PROJJSON) has the identifier that a name consists of.
  const io::JsonTree& id = crs.member("id");
  const std::string name =
      crs.is_string() ? crs.string() : id.member("authority").text() + id.member("code").text();
  constexpr std::array known = {"OGC:CRS84", "EPSG:4326", R"("OGC""CRS84")", R"("EPSG"4326)"};
  if (std::ranges::find(known, name) == known.end()) {
    refuse_arrow("has another CRS than OGC:CRS84 or EPSG:4326");
  }
}

// Refuses a struct that was released, or that its owner has moved elsewhere: what it points to is no
// longer there.
template <class Struct>
const Struct* live(const Struct* given) {
  if (given->release == nullptr) refuse_arrow("was released");
  return given;
}

// Returns the format of a field.
std::string_view field_format(const ArrowSchema& schema) {
  if (schema.format == nullptr) refuse_arrow("has no format");
  return schema.format;
}

// The lists of one level: list i has the elements offsets[i] ... offsets[i + 1] - 1 of the next one.
struct ListLevel {
  std::vector<std::uint64_t> offsets = {0};
  std::uint64_t first = 0;  // the first element that a list has
};

const void* buffer_of(const ArrowArray& array, std::int64_t buffer) {
  if (array.n_buffers <= buffer || array.buffers == nullptr) refuse_arrow("lacks a buffer");
  return array.buffers[buffer];
}

bool is_null_at(const ArrowArray& array, std::int64_t element) {
  if (array.null_count == 0) return false;
  const auto* const bits = static_cast<const std::uint8_t*>(buffer_of(array, 0));
  return bits != nullptr && (bits[element / 8] >> (element % 8) & 1) == 0;
}

// Returns the lists `begin` ... `end` - 1 of an array, counted from its own offset. Lists that are null
// are empty.
template <class Offset>
ListLevel lists_of(const ArrowArray& array, std::uint64_t begin, std::uint64_t end) {
  const auto* const offsets = static_cast<const Offset*>(buffer_of(array, 1));
  ListLevel level;
  if (begin == end) return level;
  if (offsets == nullptr) refuse_arrow("lacks offsets");
  const auto at = [&](std::uint64_t i) {
    return offsets[static_cast<std::uint64_t>(array.offset) + i];
  };
  if (at(begin) < 0) refuse_arrow("has offsets that do not fit");
  level.first = static_cast<std::uint64_t>(at(begin));
  level.offsets = system::offsets_of(end - begin, [&](std::size_t k) {
    const Offset size = at(begin + k + 1) - at(begin + k);
    if (size < 0) refuse_arrow("has offsets that do not fit");
    return static_cast<std::uint64_t>(size);
  });
  return level;
}

}  // namespace

std::string_view geoarrow_type(const ArrowSchema& schema) {
  const std::string_view type = metadata_of(live(&schema)->metadata, "ARROW:extension:name");
  if (type.empty()) refuse_arrow("has no type of GeoArrow");
  require_lonlat(std::string(metadata_of(schema.metadata, "ARROW:extension:metadata")));
  return type;
}

ArrowLevels::ArrowLevels(const ArrowSchema& schema, const ArrowArray& array)
    : schema_(live(&schema)), array_(live(&array)) {
  if (array.length < 0 || array.offset < 0) refuse_arrow("has a negative length");
  end_ = static_cast<std::uint64_t>(array.length);
}

bool ArrowLevels::is_null(std::uint64_t element) const {
  return is_null_at(*array_, array_->offset + static_cast<std::int64_t>(begin_ + element));
}

std::vector<std::uint64_t> ArrowLevels::next() {
  const std::string_view format = field_format(*schema_);
  ListLevel level;
  if (format == "+l") {
    level = lists_of<std::int32_t>(*array_, begin_, end_);
  } else if (format == "+L") {
    level = lists_of<std::int64_t>(*array_, begin_, end_);
  } else {
    refuse_arrow("has the format '" + std::string(format) + "' where a list is needed");
  }
  for (std::uint64_t k = 0; k < size(); ++k) {
    if (level.offsets[k] < level.offsets[k + 1] && is_null(k)) {
      refuse_arrow("has a null that is a list of something");
    }
  }
  begin_ = level.first;
  end_ = level.first + level.offsets.back();
  go_to_child(0);
  if (end_ > static_cast<std::uint64_t>(array_->length))
    refuse_arrow("has offsets that do not fit");
  return std::move(level.offsets);
}

std::vector<LonLat> ArrowLevels::positions() const {
  if (begin_ == end_) return {};
  const std::string_view format = field_format(*schema_);
  std::vector<LonLat> found(end_ - begin_);
  const auto offset = static_cast<std::uint64_t>(array_->offset);
  if (format.starts_with("+w:")) {
    const std::size_t size = std::stoul(std::string(format.substr(3)));
    if (size < 2 || schema_->n_children != 1) refuse_arrow("has positions of one number");
    const double* const values = numbers(0, (offset + end_) * size);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::size_t place = (offset + begin_ + i) * size;
      found[i] = {values[place], values[place + 1]};
    }
  } else if (format == "+s" && schema_->n_children >= 2) {
    const std::size_t begin = offset + begin_;
    const double* const x = numbers(0, offset + end_);
    const double* const y = numbers(1, offset + end_);
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = {x[begin + i], y[begin + i]};
  } else {
    refuse_arrow("has the format '" + std::string(format) + "' where a position is needed");
  }
  return found;
}

void ArrowLevels::go_to_child(std::int64_t child) {
  if (schema_->n_children <= child || array_->n_children <= child)
    refuse_arrow("lacks its elements");
  schema_ = live(schema_->children[child]);
  array_ = live(array_->children[child]);
}

const double* ArrowLevels::numbers(std::int64_t child, std::uint64_t size) const {
  if (array_->n_children <= child) refuse_arrow("lacks its elements");
  const ArrowArray& array = *live(array_->children[child]);
  if (field_format(*live(schema_->children[child])) != "g") {
    refuse_arrow("has coordinates that are no doubles");
  }
  const auto* const values = static_cast<const double*>(buffer_of(array, 1));
  if (array.length < 0 || array.offset < 0 || static_cast<std::uint64_t>(array.length) < size ||
      (size > 0 && values == nullptr)) {
    refuse_arrow("lacks coordinates");
  }
  return size == 0 ? nullptr : values + array.offset;
}

}  // namespace rondel::formats
