// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/zip_reader.h"

#include <zlib.h>

#include <cstdint>
#include <limits>
#include <optional>

#include "io/bad_value.h"
#include "io/binary.h"
#include "io/number.h"

namespace rondel::io {
namespace {

constexpr std::uint32_t local_magic = 0x04034b50;
constexpr std::uint32_t entry_magic = 0x02014b50;
constexpr std::uint32_t end_magic = 0x06054b50;
constexpr std::uint32_t wide_locator_magic = 0x07064b50;
constexpr std::uint32_t wide_end_magic = 0x06064b50;
constexpr std::size_t end_size = 22;
constexpr std::uint64_t is_wide = 0xffff'ffff;  // the value is in an extra field
// Deflate expands a byte to at most 1032 bytes.
constexpr std::uint64_t max_per_byte = 1032;

// Returns a number at any position of the archive.
template <typename T>
T field(std::string_view bytes, std::uint64_t place) {
  if (place > bytes.size() || bytes.size() - place < sizeof(T)) {
    throw BadValue("the zip archive is cut off");
  }
  return load<T>(bytes.data() + place);
}

std::string_view part(std::string_view bytes, std::uint64_t place, std::uint64_t size) {
  if (place > bytes.size() || bytes.size() - place < size) {
    throw BadValue("the zip archive is cut off");
  }
  return bytes.substr(place, size);
}

// An entry of the directory.
struct ZipEntry {
  std::string_view name;
  unsigned method = 0;
  std::uint32_t checksum = 0;
  std::uint64_t packed_size = 0;
  std::uint64_t size = 0;
  std::uint64_t offset = 0;
};

// Reads the values that do not fit 32 bits, which are in an extra field in this order.
void read_wide_fields(std::string_view extra, ZipEntry& entry) {
  while (extra.size() >= 4) {
    const std::string_view body = part(extra, 4, field<std::uint16_t>(extra, 2));
    if (field<std::uint16_t>(extra, 0) == 1) {
      std::uint64_t place = 0;
      for (std::uint64_t* value : {&entry.size, &entry.packed_size, &entry.offset}) {
        if (*value != is_wide) continue;
        *value = field<std::uint64_t>(body, place);
        place += 8;
      }
    }
    extra.remove_prefix(4 + body.size());
  }
}

// The offset and the number of entries of the directory.
struct Directory {
  std::uint64_t offset = 0;
  std::uint64_t count = 0;
};

Directory directory_of(std::string_view bytes) {
  if (bytes.size() < end_size) throw BadValue("not a zip archive");
  // A comment of at most 65535 bytes may follow the end record.
  const std::size_t last = bytes.size() - end_size;
  const std::size_t stop = last > 0xffff ? last - 0xffff : 0;
  for (std::size_t at = last + 1; at-- > stop;) {
    if (field<std::uint32_t>(bytes, at) != end_magic) continue;
    Directory found = {field<std::uint32_t>(bytes, at + 16), field<std::uint16_t>(bytes, at + 10)};
    if (at >= 20 && field<std::uint32_t>(bytes, at - 20) == wide_locator_magic) {
      const auto wide = field<std::uint64_t>(bytes, at - 12);
      if (field<std::uint32_t>(bytes, wide) != wide_end_magic) break;
      found = {field<std::uint64_t>(bytes, wide + 48), field<std::uint64_t>(bytes, wide + 32)};
    }
    return found;
  }
  throw BadValue("the zip archive has no directory");
}

std::optional<ZipEntry> find_entry(std::string_view bytes, std::string_view name) {
  const Directory directory = directory_of(bytes);
  std::uint64_t at = directory.offset;
  for (std::uint64_t i = 0; i < directory.count; ++i) {
    if (field<std::uint32_t>(bytes, at) != entry_magic) {
      throw BadValue("the directory of the zip archive is damaged");
    }
    const std::uint64_t name_size = field<std::uint16_t>(bytes, at + 28);
    const std::uint64_t extra_size = field<std::uint16_t>(bytes, at + 30);
    const std::uint64_t comment_size = field<std::uint16_t>(bytes, at + 32);
    ZipEntry entry = {part(bytes, at + 46, name_size),      field<std::uint16_t>(bytes, at + 10),
                      field<std::uint32_t>(bytes, at + 16), field<std::uint32_t>(bytes, at + 20),
                      field<std::uint32_t>(bytes, at + 24), field<std::uint32_t>(bytes, at + 42)};
    read_wide_fields(part(bytes, at + 46 + name_size, extra_size), entry);
    if (entry.name == name) return entry;
    at += 46 + name_size + extra_size + comment_size;
  }
  return std::nullopt;
}

// Returns the inflated stream, which may take several calls since zlib counts in 32 bits.
std::string inflated(std::string_view packed, std::uint64_t size) {
  if (size / max_per_byte > packed.size()) throw BadValue("the zip archive is damaged");
  std::string text(size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  constexpr std::uint64_t most = std::numeric_limits<uInt>::max();
  std::uint64_t taken = 0;
  std::uint64_t made = 0;
  int state = Z_OK;
  while (state == Z_OK) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): zlib does not write there
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + taken));
    stream.next_out = reinterpret_cast<Bytef*>(text.data() + made);
    const uInt in = stream.avail_in = static_cast<uInt>(std::min(most, packed.size() - taken));
    const uInt out = stream.avail_out = static_cast<uInt>(std::min(most, size - made));
    state = inflate(&stream, Z_NO_FLUSH);
    taken += in - stream.avail_in;
    made += out - stream.avail_out;
    if (stream.avail_in == in && stream.avail_out == out && state == Z_OK) break;
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END || made != size) throw BadValue("the zip archive is damaged");
  return text;
}

}  // namespace

bool has_zip_member(std::string_view bytes, std::string_view name) {
  return find_entry(bytes, name).has_value();
}

std::string zip_member(std::string_view bytes, std::string_view name) {
  const std::optional<ZipEntry> entry = find_entry(bytes, name);
  if (!entry) throw BadValue("no " + in_quotes(name) + " in the archive");
  if (field<std::uint32_t>(bytes, entry->offset) != local_magic) {
    throw BadValue("the zip archive is damaged");
  }
  const std::uint64_t start = entry->offset + 30 + field<std::uint16_t>(bytes, entry->offset + 26) +
                              field<std::uint16_t>(bytes, entry->offset + 28);
  const std::string_view packed = part(bytes, start, entry->packed_size);
  if (entry->method != 0 && entry->method != 8) {
    throw BadValue("a member of the zip archive is neither stored nor deflated");
  }
  std::string text = entry->method == 0 ? std::string(packed) : inflated(packed, entry->size);
  const auto* data = reinterpret_cast<const Bytef*>(text.data());
  if (crc32_z(0, data, text.size()) != entry->checksum || text.size() != entry->size) {
    throw BadValue("a checksum of the zip archive is wrong");
  }
  return text;
}

}  // namespace rondel::io
