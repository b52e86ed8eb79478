// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Archives that the test makes itself, field by field, after PKWARE's APPNOTE 6.3.9.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/bad_value.h"
#include "io/zip_file.h"
#include "io/zip_reader.h"
#include "unit/io/support.h"

namespace rondel::test {
namespace {

using namespace std::string_view_literals;

constexpr std::uint64_t in_extra_field = 0xffff'ffff;

// Little-endian fields of 2, 4 and 8 bytes.
std::string number(std::uint64_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xffU);
  return bytes;
}
std::string u16(std::uint64_t value) { return number(value, 2); }
std::string u32(std::uint64_t value) { return number(value, 4); }
std::string u64(std::uint64_t value) { return number(value, 8); }

std::uint32_t checksum(std::string_view text) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

std::string deflated(std::string_view text) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, text.size()), '\0');
  std::string input(text);
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  return packed;
}

struct Part {
  std::string name;
  std::string text;
  std::uint64_t method = 0;  // 0: stored, 8: deflated
  std::string comment{};
  std::string extra{};                  // fields of the directory before that of zip64
  bool has_wide_fields = false;         // the sizes and the place are in the field of zip64
  std::optional<std::string> packed{};  // instead of what the method makes of the text
  std::optional<std::uint64_t> size{};  // instead of that of the text
};

struct Archive {
  std::vector<Part> parts;
  std::string comment{};
  bool has_wide_end = false;  // the directory's place and length are in the records of zip64
};

std::string bytes_of_archive(const Archive& archive) {
  std::string bytes;
  std::string directory;
  for (const Part& part : archive.parts) {
    const std::string packed =
        part.packed.value_or(part.method == 8 ? deflated(part.text) : part.text);
    const std::uint64_t size = part.size.value_or(part.text.size());
    const std::string wide = u64(size) + u64(packed.size()) + u64(bytes.size());
    const std::string extra =
        part.extra + (part.has_wide_fields ? u16(1) + u16(wide.size()) + wide : "");
    const auto narrow = [&](std::uint64_t value) {
      return u32(part.has_wide_fields ? in_extra_field : value);
    };
    directory += u32(0x02014b50) + u16(45) + u16(45) + u16(0) + u16(part.method) + u16(0) +
                 u16(0x21) + u32(checksum(part.text)) + narrow(packed.size()) + narrow(size) +
                 u16(part.name.size()) + u16(extra.size()) + u16(part.comment.size()) + u16(0) +
                 u16(0) + u32(0) + narrow(bytes.size()) + part.name + extra + part.comment;
    // The field of this header is longer than that of the directory.
    const std::string local_extra = u16(0x5455) + u16(5) + "\x01time";
    bytes += u32(0x04034b50) + u16(45) + u16(0) + u16(part.method) + u16(0) + u16(0x21) +
             u32(checksum(part.text)) + narrow(packed.size()) + narrow(size) +
             u16(part.name.size()) + u16(local_extra.size()) + part.name + local_extra + packed;
  }
  const std::uint64_t place = bytes.size();
  const std::uint64_t count = archive.parts.size();
  bytes += directory;
  if (archive.has_wide_end) {
    const std::uint64_t end = bytes.size();
    bytes += u32(0x06064b50) + u64(44) + u16(45) + u16(45) + u32(0) + u32(0) + u64(count) +
             u64(count) + u64(directory.size()) + u64(place);
    bytes += u32(0x07064b50) + u32(0) + u64(end) + u32(1);
  }
  const bool is_wide = archive.has_wide_end;
  return bytes + u32(0x06054b50) + u16(0) + u16(0) + u16(is_wide ? 0xffff : count) +
         u16(is_wide ? 0xffff : count) + u32(is_wide ? in_extra_field : directory.size()) +
         u32(is_wide ? in_extra_field : place) + u16(archive.comment.size()) + archive.comment;
}

// The text of a member, or the message of the BadValue.
std::string member(const std::string& bytes, std::string_view name) {
  try {
    return io::zip_member(bytes, name);
  } catch (const io::BadValue& error) {
    return std::string("! ") + error.what();
  }
}

std::string pattern(std::size_t length) {
  std::string text;
  for (std::size_t i = 0; i < length; ++i) text += static_cast<char>(i * i % 251);
  return text;
}

TEST(zip_reader, has_the_members_of_archives_of_every_kind) {
  const std::string extra = u16(0x7875) + u16(3) + "abc" + u16(9) + u16(0);
  for (const bool is_wide : {false, true}) {
    for (const bool has_wide_end : {false, true}) {
      const Archive archive = {{{"empty.npy", "", 0, "", extra, is_wide},
                                {"stored.npy", pattern(700), 0, "a comment", extra, is_wide},
                                {"packed.npy", pattern(9000), 8, "another", "", is_wide},
                                {"nothing.npy", "", 8, "", "", is_wide}},
                               "of the archive",
                               has_wide_end};
      const std::string bytes = bytes_of_archive(archive);
      for (const Part& part : archive.parts) {
        EXPECT_EQ(member(bytes, part.name), part.text) << part.name;
        EXPECT_TRUE(io::has_zip_member(bytes, part.name));
      }
      EXPECT_FALSE(io::has_zip_member(bytes, "stored"));
      EXPECT_EQ(member(bytes, "stored"), "! no \"stored\" in the archive");
    }
  }
}

TEST(zip_reader, finds_the_directory_before_the_longest_comment) {
  const std::string bytes = bytes_of_archive({{{"a", "text"}}, std::string(0xffff, 'c')});
  EXPECT_EQ(member(bytes, "a"), "text");
  EXPECT_EQ(member(bytes + "c", "a"), "! the zip archive has no directory");
}

TEST(zip_reader, inflates_no_more_than_the_size_says) {
  const std::string text = pattern(5000);
  const std::string packed = deflated(text);
  const auto read = [](Part part) { return member(bytes_of_archive({{std::move(part)}}), "a"); };
  const std::string damaged = "! the zip archive is damaged";
  EXPECT_EQ(read({"a", text, 8}), text);
  EXPECT_EQ(read({"a", text, 8, "", "", false, packed, text.size() - 1}), damaged);
  EXPECT_EQ(read({"a", text, 8, "", "", false, packed, text.size() + 1}), damaged);
  EXPECT_EQ(read({"a", text, 8, "", "", false, packed, std::uint64_t{1} << 30U}), damaged);
  EXPECT_EQ(read({"a", text, 8, "", "", false, packed.substr(0, packed.size() - 1)}), damaged);
  EXPECT_EQ(read({"a", text, 8, "", "", false, ""}), damaged);
  EXPECT_EQ(read({"a", text, 8, "", "", false, text}), damaged);
  // A stream may end before what the archive keeps for it.
  EXPECT_EQ(read({"a", text, 8, "", "", false, packed + "rest"}), text);
  EXPECT_EQ(read({"a", text, 0, "", "", false, text, text.size() + 1}),
            "! a checksum of the zip archive is wrong");
  EXPECT_EQ(read({"a", text, 9}), "! a member of the zip archive is neither stored nor deflated");
}

TEST(zip_reader, says_that_what_is_no_archive_is_none) {
  EXPECT_EQ(member("", "a"), "! not a zip archive");
  EXPECT_EQ(member(std::string(21, 'x'), "a"), "! not a zip archive");
  EXPECT_EQ(member(std::string(22, 'x'), "a"), "! the zip archive has no directory");
  EXPECT_EQ(member(bytes_of_archive({}), "a"), "! no \"a\" in the archive");
}

// Whatever a byte of the archive becomes, a member has its text or is refused.
TEST(zip_reader, refuses_damage_or_is_not_misled_by_it) {
  for (const bool is_wide : {false, true}) {
    const Archive archive = {
        {{"stored", pattern(40), 0, "c", "", is_wide}, {"packed", pattern(40), 8, "", "", is_wide}},
        "comment",
        is_wide};
    const std::string good = bytes_of_archive(archive);
    for (std::size_t i = 0; i < good.size(); ++i) {
      for (const int change : {1, 0x80, 0xff}) {
        std::string bytes = good;
        bytes[i] = static_cast<char>(bytes[i] ^ change);
        for (const Part& part : archive.parts) {
          const std::string text = member(bytes, part.name);
          EXPECT_TRUE(text == part.text || text.starts_with("! ")) << part.name << ' ' << i;
        }
      }
      const bool is_comment_cut = i >= good.size() - archive.comment.size();
      EXPECT_EQ(member(good.substr(0, i), "packed").starts_with("! "), !is_comment_cut) << i;
    }
  }
}

TEST(zip_writer, writes_what_the_format_says) {
  const std::string path = temporary_path("written.zip");
  io::AtomicFile file(path);
  io::ZipWriter writer(file);
  writer.add("a.npy", "head", "body");
  writer.add("long name.npy", "", pattern(300));
  writer.add("none", "", "");
  writer.finish();
  file.commit();
  const auto local = [](const std::string& name, const std::string& text) {
    return u32(0x04034b50) + u16(45) + u16(0) + u16(0) + u16(0) + u16(0x21) + u32(checksum(text)) +
           u32(text.size()) + u32(text.size()) + u16(name.size()) + u16(0) + name + text;
  };
  const auto entry = [](const std::string& name, const std::string& text, std::size_t place) {
    return u32(0x02014b50) + u16(45) + u16(45) + u16(0) + u16(0) + u16(0) + u16(0x21) +
           u32(checksum(text)) + u32(text.size()) + u32(text.size()) + u16(name.size()) + u16(0) +
           u16(0) + u16(0) + u16(0) + u32(0) + u32(place) + name;
  };
  const std::string first = local("a.npy", "headbody");
  const std::string second = local("long name.npy", pattern(300));
  const std::string third = local("none", "");
  const std::string directory = entry("a.npy", "headbody", 0) +
                                entry("long name.npy", pattern(300), first.size()) +
                                entry("none", "", first.size() + second.size());
  const std::string members = first + second + third;
  EXPECT_EQ(read_all(path), members + directory + u32(0x06054b50) + u16(0) + u16(0) + u16(3) +
                                u16(3) + u32(directory.size()) + u32(members.size()) + u16(0));
}

}  // namespace
}  // namespace rondel::test
