// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// An array of GeoArrow is lists of lists: multipolygons have polygons, these have rings, and rings have
// positions. The levels of Arrow are read from the outermost to the positions; each may begin at an
// offset of its own.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/json_tree.h"
#include "rondel/arrow.h"
#include "rondel/error.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

constexpr std::int64_t max_positions = std::numeric_limits<std::int32_t>::max();

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("the array of Arrow " + what);
}

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
    refuse(std::string("has metadata of its type that cannot be read: ") + error.what());
  }
  const io::JsonTree& crs = builder.root().member("crs");
  if (crs.is_null()) return;
  // The definition of a CRS (PROJJSON) has the identifier that a name consists of.
  const io::JsonTree& id = crs.member("id");
  const std::string name =
      crs.is_string() ? crs.string() : id.member("authority").text() + id.member("code").text();
  constexpr std::array known = {"OGC:CRS84", "EPSG:4326", R"("OGC""CRS84")", R"("EPSG"4326)"};
  if (std::ranges::find(known, name) == known.end()) {
    refuse("has another CRS than OGC:CRS84 or EPSG:4326");
  }
}

// The lists of one level: list i has the elements offsets[i] ... offsets[i + 1] - 1 of the next one.
struct ListLevel {
  std::vector<std::uint64_t> offsets = {0};
  std::uint64_t first = 0;  // the first element that a list has
};

const void* buffer_of(const ArrowArray& array, std::int64_t buffer) {
  if (array.n_buffers <= buffer || array.buffers == nullptr) refuse("lacks a buffer");
  return array.buffers[buffer];
}

bool is_null(const ArrowArray& array, std::int64_t element) {
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
  if (offsets == nullptr) refuse("lacks offsets");
  const auto at = [&](std::uint64_t i) {
    return offsets[static_cast<std::uint64_t>(array.offset) + i];
  };
  if (at(begin) < 0) refuse("has offsets that do not fit");
  level.first = static_cast<std::uint64_t>(at(begin));
  level.offsets = system::offsets_of(end - begin, [&](std::size_t k) {
    const Offset size = at(begin + k + 1) - at(begin + k);
    if (size < 0) refuse("has offsets that do not fit");
    return static_cast<std::uint64_t>(size);
  });
  return level;
}

// Reads the levels of an array one after the other.
class ArrowLevels {
 public:
  ArrowLevels(const ArrowSchema& schema, const ArrowArray& array)
      : schema_(&schema), array_(&array) {
    if (array.length < 0 || array.offset < 0) refuse("has a negative length");
    end_ = static_cast<std::uint64_t>(array.length);
  }

  // Returns the offsets of the lists, and goes on to their elements.
  std::vector<std::uint64_t> next() {
    const std::string_view format(schema_->format);
    ListLevel level;
    if (format == "+l") {
      level = lists_of<std::int32_t>(*array_, begin_, end_);
    } else if (format == "+L") {
      level = lists_of<std::int64_t>(*array_, begin_, end_);
    } else {
      refuse("has the format '" + std::string(format) + "' where a list is needed");
    }
    for (std::uint64_t i = begin_; i < end_; ++i) {
      const std::uint64_t k = i - begin_;
      if (level.offsets[k] < level.offsets[k + 1] &&
          is_null(*array_, array_->offset + static_cast<std::int64_t>(i))) {
        refuse("has a null that is a list of something");
      }
    }
    begin_ = level.first;
    end_ = level.first + level.offsets.back();
    go_to_child(0);
    if (end_ > static_cast<std::uint64_t>(array_->length)) refuse("has offsets that do not fit");
    return std::move(level.offsets);
  }

  // Returns the positions.
  [[nodiscard]] std::vector<LonLat> positions() const {
    if (begin_ == end_) return {};
    const std::string_view format(schema_->format);
    std::vector<LonLat> found(end_ - begin_);
    const auto offset = static_cast<std::uint64_t>(array_->offset);
    if (format.starts_with("+w:")) {
      const std::size_t size = std::stoul(std::string(format.substr(3)));
      if (size < 2 || schema_->n_children != 1) refuse("has positions of one number");
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
      refuse("has the format '" + std::string(format) + "' where a position is needed");
    }
    return found;
  }

 private:
  void go_to_child(std::int64_t child) {
    if (schema_->n_children <= child || array_->n_children <= child) refuse("lacks its elements");
    schema_ = schema_->children[child];
    array_ = array_->children[child];
  }
  // Returns the doubles of a child, of which there must be so many.
  [[nodiscard]] const double* numbers(std::int64_t child, std::uint64_t size) const {
    if (array_->n_children <= child) refuse("lacks its elements");
    const ArrowArray& array = *array_->children[child];
    if (std::string_view(schema_->children[child]->format) != "g") {
      refuse("has coordinates that are no doubles");
    }
    const auto* const values = static_cast<const double*>(buffer_of(array, 1));
    if (array.length < 0 || array.offset < 0 || static_cast<std::uint64_t>(array.length) < size ||
        (size > 0 && values == nullptr)) {
      refuse("lacks coordinates");
    }
    return size == 0 ? nullptr : values + array.offset;
  }

  const ArrowSchema* schema_;
  const ArrowArray* array_;
  std::uint64_t begin_ = 0;
  std::uint64_t end_ = 0;
};

// What an exported array owns, with one buffer of values for each level.
struct OwnedLevel {
  std::vector<std::int32_t> offsets;
  std::vector<double> values;
  std::array<const void*, 2> buffers = {};
  ArrowArray array = {};
  ArrowSchema schema = {};
  ArrowArray* child_array = nullptr;
  ArrowSchema* child_schema = nullptr;
};
using Levels = std::vector<std::unique_ptr<OwnedLevel>>;

// Both structs share their levels, and are released one by one.
using SharedLevels = std::shared_ptr<Levels>;

// A library may move a child out of its parent, which it marks by a null `release`. So each struct
// keeps all levels alive, and a child may be within the memory that is freed with it.
template <class Struct>
void release(Struct* released) {
  const std::unique_ptr<SharedLevels> levels(static_cast<SharedLevels*>(released->private_data));
  for (std::int64_t k = 0; k < released->n_children; ++k) {
    Struct* const child = released->children[k];
    if (child->release != nullptr) child->release(child);
  }
  released->private_data = nullptr;
  released->release = nullptr;
}

template <class Struct>
void own(Struct& made, const SharedLevels& levels) {
  made.private_data = new SharedLevels(levels);
  made.release = release<Struct>;
}

std::vector<std::int32_t> short_offsets(const std::vector<std::uint64_t>& offsets,
                                        std::size_t num_elements) {
  if (!system::are_offsets(offsets, num_elements)) {
    throw InvalidInput("the offsets of the polygons do not fit");
  }
  if (num_elements > static_cast<std::size_t>(max_positions)) {
    throw InvalidInput("an array of Arrow has at most 2147483647 positions");
  }
  return {offsets.begin(), offsets.end()};
}

// The metadata of the type: the number of pairs, and each text after its length.
std::string extension_metadata(PolygonEdges edges) {
  std::string metadata;
  const auto append_number = [&](std::size_t value) {
    const auto number = static_cast<std::int32_t>(value);
    std::array<char, sizeof number> bytes{};
    std::memcpy(bytes.data(), &number, sizeof number);
    metadata.append(bytes.data(), bytes.size());
  };
  const std::string type = std::string(R"({"crs":"OGC:CRS84","crs_type":"authority_code")") +
                           (edges == PolygonEdges::geodesic ? R"(,"edges":"spherical"})" : "}");
  const std::array<std::pair<std::string_view, std::string_view>, 2> pairs = {
      {{"ARROW:extension:name", "geoarrow.multipolygon"}, {"ARROW:extension:metadata", type}}};
  append_number(pairs.size());
  for (const auto& [key, value] : pairs) {
    for (const std::string_view text : {key, value}) {
      append_number(text.size());
      metadata += text;
    }
  }
  return metadata;
}

}  // namespace

LonLatMultiPolygons import_arrow(const ArrowSchema& schema, const ArrowArray& array) {
  const std::string_view type = metadata_of(schema.metadata, "ARROW:extension:name");
  const bool is_multi = type == "geoarrow.multipolygon";
  if (!is_multi && type != "geoarrow.polygon") {
    refuse(type.empty() ? "has no type of GeoArrow"
                        : "has the type " + std::string(type) +
                              ", not geoarrow.polygon or geoarrow.multipolygon");
  }
  require_lonlat(std::string(metadata_of(schema.metadata, "ARROW:extension:metadata")));
  ArrowLevels levels(schema, array);
  LonLatMultiPolygons features;
  if (is_multi) {
    features.offsets = levels.next();
    features.rows.offsets = levels.next();
  } else {
    features.rows.offsets = levels.next();
    features.offsets = system::offsets_of(features.rows.size(), [](std::size_t) { return 1U; });
  }
  features.rows.rows.offsets = levels.next();
  features.rows.rows.values = levels.positions();
  return features;
}

void export_arrow(const LonLatMultiPolygons& features, PolygonEdges edges, ArrowSchema& schema,
                  ArrowArray& array) {
  const auto& polygons = features.rows;
  const auto& rings = polygons.rows;
  auto levels = std::make_shared<Levels>();
  const auto add = [&](const char* format, const char* name, std::size_t length) -> OwnedLevel& {
    OwnedLevel& level = *levels->emplace_back(std::make_unique<OwnedLevel>());
    level.schema.format = format;
    level.schema.name = name;
    level.array.length = static_cast<std::int64_t>(length);
    return level;
  };
  add("+l", "", features.size()).offsets = short_offsets(features.offsets, polygons.size());
  add("+l", "polygons", polygons.size()).offsets = short_offsets(polygons.offsets, rings.size());
  add("+l", "rings", rings.size()).offsets = short_offsets(rings.offsets, rings.values.size());
  add("+w:2", "vertices", rings.values.size());
  std::vector<double>& values = add("g", "xy", 2 * rings.values.size()).values;
  values.reserve(2 * rings.values.size());
  for (const LonLat& p : rings.values) values.insert(values.end(), {p.lon_deg, p.lat_deg});
  for (std::size_t k = levels->size(); k-- > 0;) {
    OwnedLevel& level = *(*levels)[k];
    level.array.buffers = level.buffers.data();
    const bool is_list = !level.offsets.empty();
    level.array.n_buffers = is_list || !level.values.empty() || k + 1 == levels->size() ? 2 : 1;
    level.buffers[1] =
        is_list ? static_cast<const void*>(level.offsets.data()) : level.values.data();
    if (k > 0) {
      own(level.array, levels);
      own(level.schema, levels);
    }
    if (k + 1 == levels->size()) continue;
    level.child_array = &(*levels)[k + 1]->array;
    level.child_schema = &(*levels)[k + 1]->schema;
    level.array.children = &level.child_array;
    level.schema.children = &level.child_schema;
    level.array.n_children = level.schema.n_children = 1;
  }
  static const std::array<std::string, 2> metadata = {extension_metadata(PolygonEdges::lonlat),
                                                      extension_metadata(PolygonEdges::geodesic)};
  schema = levels->front()->schema;
  schema.metadata = metadata[edges == PolygonEdges::geodesic ? 1 : 0].data();
  constexpr std::int64_t nullable = 2;
  schema.flags = nullable;
  array = levels->front()->array;
  own(schema, levels);
  own(array, levels);
}

}  // namespace rondel
