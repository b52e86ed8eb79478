// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/arrow_export.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

#include "rondel/error.h"
#include "system/row_assembly.h"

namespace rondel::formats {
namespace {

// What an exported array owns, with one buffer of values for each level.
struct OwnedLevel {
  std::string metadata;
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

// The metadata of the type: the number of pairs, and each text after its length.
std::string extension_metadata(const std::string& type, PolygonEdges edges) {
  std::string metadata;
  const auto append_number = [&](std::size_t value) {
    const auto number = static_cast<std::int32_t>(value);
    std::array<char, sizeof number> bytes{};
    std::memcpy(bytes.data(), &number, sizeof number);
    metadata.append(bytes.data(), bytes.size());
  };
  const std::string facts = std::string(R"({"crs":"OGC:CRS84","crs_type":"authority_code")") +
                            (edges == PolygonEdges::geodesic ? R"(,"edges":"spherical"})" : "}");
  const std::array<std::pair<std::string_view, std::string_view>, 2> pairs = {
      {{"ARROW:extension:name", type}, {"ARROW:extension:metadata", facts}}};
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

std::vector<std::int32_t> arrow_offsets(std::span<const std::uint64_t> offsets,
                                        std::size_t num_elements) {
  if (!system::are_offsets(offsets, num_elements)) {
    throw InvalidInput("the offsets of the geometries do not fit");
  }
  if (num_elements > std::size_t{std::numeric_limits<std::int32_t>::max()}) {
    throw InvalidInput("an array of Arrow has at most 2147483647 positions");
  }
  return {offsets.begin(), offsets.end()};
}

void export_lists(const std::string& type, PolygonEdges edges, std::vector<ArrowLists> lists,
                  const char* name_of_positions, std::span<const LonLat> positions,
                  ArrowSchema& schema, ArrowArray& array) {
  auto levels = std::make_shared<Levels>();
  const auto add = [&](const char* format, const char* name, std::size_t length) -> OwnedLevel& {
    OwnedLevel& level = *levels->emplace_back(std::make_unique<OwnedLevel>());
    level.schema.format = format;
    level.schema.name = name;
    level.array.length = static_cast<std::int64_t>(length);
    return level;
  };
  for (ArrowLists& level : lists) {
    add("+l", level.name, level.offsets.size() - 1).offsets = std::move(level.offsets);
  }
  add("+w:2", name_of_positions, positions.size());
  std::vector<double>& values = add("g", "xy", 2 * positions.size()).values;
  values.reserve(2 * positions.size());
  for (const LonLat& p : positions) values.insert(values.end(), {p.lon_deg, p.lat_deg});
  for (std::size_t k = levels->size(); k-- > 0;) {
    OwnedLevel& level = *(*levels)[k];
    level.array.buffers = level.buffers.data();
    const bool is_list = !level.offsets.empty();
    level.array.n_buffers = is_list || k + 1 == levels->size() ? 2 : 1;
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
  OwnedLevel& outermost = *levels->front();
  outermost.metadata = extension_metadata(type, edges);
  schema = outermost.schema;
  schema.metadata = outermost.metadata.data();
  constexpr std::int64_t nullable = 2;
  schema.flags = nullable;
  array = outermost.array;
  own(schema, levels);
  own(array, levels);
}

}  // namespace rondel::formats
