// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/zip_file.h"

#include <zlib.h>

#include <algorithm>
#include <cstddef>

namespace rondel::io {
namespace {

constexpr std::uint64_t see_zip64 = 0xffff'ffff;  // stands for a value in the zip64 field; also the
                                                  // largest value of a 32-bit field
constexpr unsigned needed_version = 45;           // zip64 was introduced in 4.5
constexpr unsigned first_of_1980 = 0x21;

// Little-endian fields, one after the other.
class Record {
 public:
  Record& u16(std::uint64_t value) { return add(value, 2); }
  Record& u32(std::uint64_t value) { return add(value, 4); }
  Record& u64(std::uint64_t value) { return add(value, 8); }
  Record& text(std::string_view value) {
    bytes_ += value;
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  Record& add(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xffU);
    return *this;
  }

  std::string bytes_;
};

std::uint64_t clipped(std::uint64_t value) { return std::min(value, see_zip64); }

// Returns the zip64 extra field, with sizes in 64 bits.
Record zip64_extra(std::uint64_t size) { return Record().u16(1).u16(16).u64(size).u64(size); }

}  // namespace

void ZipWriter::write(std::string_view bytes) {
  file_.write(bytes);
  position_ += bytes.size();
}

void ZipWriter::add(const std::string& name, std::string_view head, std::string_view body) {
  // A null pointer would reset the checksum in crc32_z.
  const auto bytes = [](std::string_view text) {
    return reinterpret_cast<const Bytef*>(text.empty() ? "" : text.data());
  };
  const uLong head_checksum = crc32_z(0, bytes(head), head.size());
  const auto checksum =
      static_cast<std::uint32_t>(crc32_z(head_checksum, bytes(body), body.size()));
  const std::uint64_t size = std::uint64_t{head.size()} + body.size();
  members_.push_back({name, checksum, size, position_});
  const bool is_large = size >= see_zip64;
  Record record;
  record.u32(0x04034b50).u16(needed_version).u16(0).u16(0).u16(0).u16(first_of_1980);
  record.u32(checksum).u32(clipped(size)).u32(clipped(size)).u16(name.size());
  record.u16(is_large ? zip64_extra(size).bytes().size() : 0).text(name);
  if (is_large) record.text(zip64_extra(size).bytes());
  write(record.bytes());
  write(head);
  write(body);
}

void ZipWriter::finish() {
  const std::uint64_t start = position_;
  for (const Member& member : members_) {
    Record wide;
    if (member.size >= see_zip64) wide.u64(member.size).u64(member.size);
    if (member.offset >= see_zip64) wide.u64(member.offset);
    Record extra;
    if (!wide.bytes().empty()) extra.u16(1).u16(wide.bytes().size()).text(wide.bytes());
    Record record;
    record.u32(0x02014b50).u16(needed_version).u16(needed_version);
    record.u16(0).u16(0).u16(0).u16(first_of_1980);
    record.u32(member.checksum).u32(clipped(member.size)).u32(clipped(member.size));
    record.u16(member.name.size()).u16(extra.bytes().size());
    record.u16(0).u16(0).u16(0).u32(0).u32(clipped(member.offset));
    write(record.text(member.name).text(extra.bytes()).bytes());
  }
  const std::uint64_t end = position_;
  const std::uint64_t count = members_.size();
  Record record;
  if (end >= see_zip64) {
    record.u32(0x06064b50).u64(44).u16(needed_version).u16(needed_version).u32(0).u32(0);
    record.u64(count).u64(count).u64(end - start).u64(start);
    record.u32(0x07064b50).u32(0).u64(end).u32(1);
  }
  record.u32(0x06054b50).u16(0).u16(0).u16(count).u16(count);
  record.u32(clipped(end - start)).u32(clipped(start)).u16(0);
  write(record.bytes());
}

}  // namespace rondel::io
