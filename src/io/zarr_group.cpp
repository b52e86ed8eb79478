// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/zarr_group.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <span>

#include "io/file_bytes.h"
#include "rondel/error.h"
#include "system/descriptor.h"

namespace rondel::io {
namespace {

constexpr const char* description_name = "zarr.json";
constexpr const char* maker = "made by rondel ";

bool is_decimal(char c) { return c >= '0' && c <= '9'; }

// The arrays of all groups that were ever made here (zarr_mesh.h).
constexpr std::array<std::string_view, 9> array_names = {"areas",       "duplicates", "faces",
                                                         "ghost_faces", "mesh",       "neighbors",
                                                         "node_lat",    "node_lon",   "sites"};

bool is_array(std::string_view name) {
  return std::ranges::find(array_names, name) != array_names.end();
}

// "c", "c.0", "c.17.0".
bool is_chunk(std::string_view name) {
  return name == "c" ||
         (name.starts_with("c.") && is_decimal(name.back()) &&
          name.find("..") == std::string_view::npos &&
          std::ranges::all_of(name.substr(2), [](char c) { return c == '.' || is_decimal(c); }));
}

bool is_known_name(std::string_view name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string_view::npos) return name == description_name || is_array(name);
  const std::string_view inner = name.substr(slash + 1);
  return is_array(name.substr(0, slash)) && (inner == description_name || is_chunk(inner));
}

std::string objection_to(const std::string& path) {
  constexpr const char* objection = "it was not made by rondel";
  try {
    FileBytes description(path + "/" + description_name);
    return description.text().find(maker) == std::string_view::npos ? objection : "";
  } catch (const FileError&) {
    return objection;
  }
}

constexpr FolderKind zarr_kind = {&is_known_name, &objection_to};

std::string list(const std::vector<std::string>& items) {
  std::string text = "[";
  for (const std::string& item : items) {
    if (text.size() > 1) text += ", ";
    text += item;
  }
  return text + "]";
}

std::string list(std::span<const std::uint64_t> numbers) {
  std::vector<std::string> items;
  for (const std::uint64_t number : numbers) items.push_back(std::to_string(number));
  return list(items);
}

// An object whose members are on lines of their own.
std::string object(const ZarrAttributes& members, const std::string& indent) {
  if (members.empty()) return "{}";
  std::string text = "{";
  for (const auto& [name, value] : members) {
    if (text.size() > 1) text += ",";
    text.append("\n").append(indent).append("  ").append(zarr_text(name));
    text.append(": ").append(value);
  }
  return text.append("\n").append(indent).append("}");
}

std::string named(const std::string& name, const std::string& configuration) {
  return R"({"name": ")" + name + R"(", "configuration": {)" + configuration + "}}";
}

std::vector<std::uint64_t> chunk_shape(const ZarrHead& head) {
  std::vector<std::uint64_t> shape = head.shape;
  if (!shape.empty()) shape[0] = zarr_chunk_rows(shape[0]);
  return shape;
}

std::string description(const ZarrHead& head, const std::string& indent) {
  std::vector<std::string> dimensions;
  for (const std::string& name : head.dimensions) dimensions.push_back(zarr_text(name));
  const std::string chunks = R"("chunk_shape": )" + list(chunk_shape(head));
  return object({{"zarr_format", "3"},
                 {"node_type", zarr_text("array")},
                 {"shape", list(head.shape)},
                 {"data_type", zarr_text(head.type)},
                 {"chunk_grid", named("regular", chunks)},
                 {"chunk_key_encoding", named("default", R"("separator": ".")")},
                 {"fill_value", head.type == "float64" ? "0.0" : "0"},
                 {"codecs", "[" + named("bytes", R"("endian": "little")") + "]"},
                 {"attributes", object(head.attributes, indent + "  ")},
                 {"dimension_names", list(dimensions)}},
                indent);
}

std::uint64_t product(std::span<const std::uint64_t> numbers) {
  std::uint64_t result = 1;
  for (const std::uint64_t number : numbers) result *= number;
  return result;
}

}  // namespace

std::string zarr_text(std::string_view text) { return '"' + std::string(text) + '"'; }

// Chunks are files of their full size, also the last one.
std::uint64_t zarr_chunk_rows(std::uint64_t num_rows) {
  constexpr std::uint64_t most_rows = std::uint64_t{1} << 20U;
  const std::uint64_t num_chunks = num_rows / most_rows + (num_rows % most_rows != 0 ? 1 : 0);
  if (num_chunks == 0) return 1;
  return num_rows / num_chunks + (num_rows % num_chunks != 0 ? 1 : 0);
}

ZarrGroup::ZarrGroup(const std::string& path) : folder_(path, zarr_kind) {}

void ZarrGroup::add(const ZarrHead& head) {
  folder_.make_folder(head.name);
  folder_.write_file(head.name + "/" + description_name, description(head, "") + "\n");
  arrays_.emplace_back(head.name, description(head, "      "));
}

void ZarrGroup::commit(const ZarrAttributes& attributes) {
  std::ranges::sort(arrays_);
  const std::string all = object({{"kind", zarr_text("inline")},
                                  {"must_understand", "false"},
                                  {"metadata", object(arrays_, "    ")}},
                                 "  ");
  folder_.write_file(description_name, object({{"zarr_format", "3"},
                                               {"node_type", zarr_text("group")},
                                               {"attributes", object(attributes, "  ")},
                                               {"consolidated_metadata", all}},
                                              "") +
                                           "\n");
  folder_.commit();
}

ZarrArray::ZarrArray(ZarrGroup& group, const ZarrHead& head)
    : group_(group),
      name_(head.name),
      tail_(head.shape.size() == 2 ? ".0" : ""),
      chunk_bytes_(product(chunk_shape(head)) * (head.type.ends_with("64") ? 8 : 4)) {
  group.add(head);
}

ZarrArray::~ZarrArray() {
  if (descriptor_ >= 0) system::close(descriptor_);
}

void ZarrArray::open_chunk() {
  group_.folder_.release(chunk_bytes_);
  descriptor_ = group_.folder_.make_file(name_ + "/c." + std::to_string(num_chunks_++) + tail_);
  left_ = chunk_bytes_;
}

void ZarrArray::close_chunk() {
  const int descriptor = std::exchange(descriptor_, -1);
  if (system::close(descriptor) != 0) group_.folder_.fail(errno);
}

void ZarrArray::write(std::string_view bytes) {
  while (!bytes.empty()) {
    if (descriptor_ < 0) open_chunk();
    const std::string_view piece = bytes.substr(0, left_);
    group_.folder_.write(descriptor_, piece);
    bytes.remove_prefix(piece.size());
    left_ -= piece.size();
    if (left_ == 0) close_chunk();
  }
}

// The rest of the last chunk is zeros.
void ZarrArray::finish() {
  if (descriptor_ < 0) return;
  if (system::resize(descriptor_, chunk_bytes_) != 0) group_.folder_.fail(errno);
  close_chunk();
}

}  // namespace rondel::io
