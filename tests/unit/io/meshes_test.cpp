// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Readers of triangles, with files that the test writes byte by byte, and what they say of damaged ones.
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "io/bad_value.h"
#include "io/ply_header.h"
#include "io/text_lines.h"
#include "io/triangle_formats.h"
#include "unit/io/support.h"

namespace rondel::test::of_meshes {
namespace {

using Read = std::vector<Triple> (*)(std::string_view);
using Triples = std::vector<Triple>;

// The message of the BadValue, with its line where it has one; empty if there is none.
std::string refused(Read read, std::string_view bytes) {
  try {
    (void)read(bytes);
  } catch (const io::BadValue& bad) {
    return (bad.line() == 0 ? "" : std::to_string(bad.line()) + ": ") + bad.what();
  }
  return {};
}

template <typename T>
std::string stored(T value, std::endian order) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  return order == std::endian::native ? std::string(bytes.begin(), bytes.end())
                                      : std::string(bytes.rbegin(), bytes.rend());
}

TEST(text_lines, have_words_between_blanks) {
  io::TextLines lines("\xEF\xBB\xBF# a\n\n a\tbb \vc\f#d e\r\n\t\r\r\nlast");
  EXPECT_TRUE(lines.next());
  EXPECT_EQ(lines.line(), 3U);
  EXPECT_EQ(lines.words(), (std::vector<std::string_view>{"a", "bb", "c"}));
  EXPECT_EQ(lines.position(), 23U);
  EXPECT_EQ(lines.size(), 31U);
  EXPECT_TRUE(lines.next());
  EXPECT_EQ(lines.line(), 5U);
  EXPECT_EQ(lines.words(), (std::vector<std::string_view>{"last"}));
  EXPECT_EQ(lines.position(), lines.size());
  EXPECT_FALSE(lines.next());
  EXPECT_TRUE(lines.words().empty());
  io::TextLines bad("a\rb\n");
  EXPECT_THROW(bad.next(), io::BadValue);
}

TEST(obj, corners_are_counted_from_1_or_from_the_end) {
  EXPECT_EQ(io::read_obj("v 0 0 1\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1 2 3\nf 3/5 2//7 1/1/1\n"
                         "f -1 -2 -3\nv 5 5 5\nf -1 1 4294967296\ng x\n"),
            (Triples{{0, 1, 2}, {2, 1, 0}, {2, 1, 0}, {3, 0, 4294967295}}));
  EXPECT_TRUE(io::read_obj("").empty());
  EXPECT_EQ(refused(io::read_obj, "v 0 0 1\nf 1 2\n"),
            "2: a face with 2 corners where a triangle is needed");
  EXPECT_EQ(refused(io::read_obj, "f 1 2 3 4\n"),
            "1: a face with 4 corners where a triangle is needed");
  EXPECT_EQ(refused(io::read_obj, "f 1 0 3\n"), "1: index 0 where indices count from 1");
  EXPECT_EQ(refused(io::read_obj, "v 1 1 1\n\nf 1 -2 1\n"), "3: negative index -1");
  EXPECT_EQ(refused(io::read_obj, "f 1 2 4294967297\n"), "1: index 4294967296 is too large");
  EXPECT_EQ(refused(io::read_obj, "f 1 x 3\n"), "1: index \"x\" is not an integer");
}

TEST(off, has_its_counts_behind_the_word_or_below) {
  const Triples expected = {{0, 1, 2}, {2, 1, 0}};
  EXPECT_EQ(io::read_off("OFF\n3 2 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 2 1 0\n"), expected);
  EXPECT_EQ(io::read_off("OFF 3 2\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2 255 0 0\n3 2 1 0\nmore\n"),
            expected);
  EXPECT_EQ(io::read_off("# a\nOFF # b\n\n0 0 0"), Triples{});
  EXPECT_EQ(refused(io::read_off, ""), "not an OFF file");
  EXPECT_EQ(refused(io::read_off, "COFF 0 0\n"), "1: not an OFF file");
  EXPECT_EQ(refused(io::read_off, "OFF\n"), "1: the file ends after 0 of 1 lines of counts");
  EXPECT_EQ(refused(io::read_off, "OFF\n3\n"), "2: no numbers of vertices and faces");
  EXPECT_EQ(refused(io::read_off, "OFF 3\n"), "1: no numbers of vertices and faces");
  EXPECT_EQ(refused(io::read_off, "OFF 0 -1\n"), "1: negative number of faces");
  EXPECT_EQ(refused(io::read_off, "OFF -1 0\n"), "1: negative number of vertices");
  EXPECT_EQ(refused(io::read_off, "OFF 3 1\n1 0 0\n0 1 0\n"),
            "3: the file ends after 2 of 3 vertices");
  EXPECT_EQ(refused(io::read_off, "OFF 1 2\n1 0 0\n3 0 0 0\n"),
            "3: the file ends after 1 of 2 faces");
  EXPECT_EQ(refused(io::read_off, "OFF 1 1\n1 0 0\n4 0 0 0 0\n"),
            "3: a face with 4 corners where a triangle is needed");
  EXPECT_EQ(refused(io::read_off, "OFF 0 1\n3 0 0\n"), "2: a face without its three indices");
  EXPECT_EQ(refused(io::read_off, "OFF 0 1\n3 0 0 -1\n"), "2: negative index -1");
}

const std::string ply_start = "ply\nformat ascii 1.0\n";

TEST(ply_header, has_elements_with_properties_of_all_types) {
  using io::PlyType;
  const std::vector<std::pair<std::string, PlyType>> types = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  std::string text = ply_start + "comment a b\nobj_info c\nelement vertex 12\n";
  for (const auto& [name, type] : types) text += "property " + name + " p" + name + "\n";
  text += "element face 3\nproperty list uchar int vertex_index\n";
  const io::PlyHeader header = io::parse_ply_header(text + "end_header\n1 2");
  EXPECT_EQ(header.encoding, io::PlyEncoding::ascii);
  EXPECT_EQ(header.data_offset, text.size() + 11);
  ASSERT_EQ(header.elements.size(), 2U);
  EXPECT_EQ(header.elements[0].name, "vertex");
  EXPECT_EQ(header.elements[0].count, 12U);
  ASSERT_EQ(header.elements[0].properties.size(), types.size());
  for (std::size_t i = 0; i < types.size(); ++i) {
    EXPECT_EQ(header.elements[0].properties[i].type, types[i].second);
    EXPECT_EQ(header.elements[0].properties[i].name, "p" + types[i].first);
    EXPECT_FALSE(header.elements[0].properties[i].is_list);
  }
  const io::PlyProperty& list = header.elements[1].properties.at(0);
  EXPECT_TRUE(list.is_list);
  EXPECT_EQ(list.size_type, PlyType::uint8);
  EXPECT_EQ(list.type, PlyType::int32);
  EXPECT_EQ(list.name, "vertex_index");
  const auto encoding = [](const std::string& name) {
    return io::parse_ply_header("ply\nformat " + name + " 1.0\nend_header\n").encoding;
  };
  EXPECT_EQ(encoding("binary_little_endian"), io::PlyEncoding::little_endian);
  EXPECT_EQ(encoding("binary_big_endian"), io::PlyEncoding::big_endian);
}

TEST(ply_header, is_refused_with_what_is_wrong) {
  const auto said = [](const std::string& lines) {
    return refused(io::read_ply, ply_start + lines + "end_header\n");
  };
  EXPECT_EQ(refused(io::read_ply, ""), "not a .ply file");
  EXPECT_EQ(refused(io::read_ply, "plx\n"), "not a .ply file");
  EXPECT_EQ(refused(io::read_ply, ply_start), "the header does not end");
  EXPECT_EQ(refused(io::read_ply, "ply\nend_header\n"), "the header has no format");
  EXPECT_EQ(refused(io::read_ply, "ply\nformat\nend_header\n"),
            "unknown line \"format\" in the header");
  EXPECT_EQ(refused(io::read_ply, "ply\nformat utf 1.0\nend_header\n"), "unknown format \"utf\"");
  EXPECT_EQ(said("element face -1\n"), "a negative number of elements");
  EXPECT_EQ(said("element face\n"), "unknown line \"element\" in the header");
  EXPECT_EQ(said("element face 1 2\n"), "unknown line \"element\" in the header");
  EXPECT_EQ(said("property int a\n"), "unknown line \"property\" in the header");
  EXPECT_EQ(said("element a 0\nproperty int\n"), "a damaged property in the header");
  EXPECT_EQ(said("element a 0\nproperty list int int\n"), "a damaged property in the header");
  EXPECT_EQ(said("element a 0\nproperty lisp int int b\n"), "a damaged property in the header");
  EXPECT_EQ(said("element a 0\nproperty long b\n"), "unknown type \"long\" in the header");
  EXPECT_EQ(said("other\n"), "unknown line \"other\" in the header");
  EXPECT_EQ(said("element vertex 0\n"), "no faces with vertex_indices");
  EXPECT_EQ(said("element face 0\nproperty list uchar int corners\n"),
            "no faces with vertex_indices");
  EXPECT_EQ(said("element face 0\nproperty int vertex_indices\n"), "no faces with vertex_indices");
  EXPECT_EQ(said("element face 0\nproperty list uchar int vertex_indices\n"), "");
}

// Numbers of all types stand before the corners, between them, and behind them.
TEST(ply, is_read_in_both_orders_of_bytes) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const auto put = [order](auto... values) { return (stored(values, order) + ...); };
    std::string bytes = std::string("ply\nformat binary_") +
                        (order == std::endian::big ? "big" : "little") +
                        "_endian 1.0\nelement vertex 2\nproperty double x\nproperty float y\n"
                        "property char a\nproperty short b\nproperty int c\n"
                        "element empty 5\n"
                        "element face 2\nproperty list ushort uchar marks\n"
                        "property list uint short vertex_indices\nproperty uint d\nend_header\n";
    for (int i = 0; i < 2; ++i) {
      bytes += put(1.5, 2.5F, std::int8_t{1}, std::int16_t{2}, std::int32_t{3});
    }
    bytes += put(std::uint16_t{2}, std::uint8_t{1}, std::uint8_t{2}, std::uint32_t{3},
                 std::int16_t{0}, std::int16_t{1}, std::int16_t{258}, std::uint32_t{9});
    const std::string second = put(std::uint16_t{0}, std::uint32_t{3}, std::int16_t{7},
                                   std::int16_t{8}, std::int16_t{9}, std::uint32_t{9});
    EXPECT_EQ(io::read_ply(bytes + second), (Triples{{0, 1, 258}, {7, 8, 9}}));
    for (std::size_t size = 0; size < second.size(); ++size) {
      EXPECT_EQ(refused(io::read_ply, bytes + second.substr(0, size)),
                "face 1: the file is cut off");
    }
    EXPECT_EQ(refused(io::read_ply, bytes + put(std::uint16_t{0}, std::uint32_t{4})),
              "face 1: a face with 4 corners where a triangle is needed");
    EXPECT_EQ(
        refused(io::read_ply, bytes + put(std::uint16_t{0}, std::uint32_t{3}, std::int16_t{-2})),
        "face 1: negative index -2");
  }
}

TEST(ply, is_read_as_text) {
  const std::string head = ply_start +
                           "element vertex 1\nproperty float x\n"
                           "element face 2\nproperty list uchar int vertex_index\nend_header\n";
  EXPECT_EQ(io::read_ply(head + "0.5\n3 0 1 2\n3\n4 5\n6\n"), (Triples{{0, 1, 2}, {4, 5, 6}}));
  EXPECT_EQ(refused(io::read_ply, head + "0.5\n3 0 1 2\n3 4 5\n"), "face 1: the file is cut off");
  EXPECT_EQ(refused(io::read_ply, head + "0.5\n3 0 1.5 2\n"),
            "face 0: a number that is not an integer where one is needed");
  EXPECT_EQ(refused(io::read_ply, head + "0.5\n3 0 1e19 2\n"),
            "face 0: a number that is not an integer where one is needed");
  EXPECT_EQ(refused(io::read_ply, head + "x\n"), "vertex 0: value \"x\" is not a number");
}

// A .vtp file of triangles with 4 arrays, of which the last two are those of the polygons.
struct VtpFile {
  std::endian order = std::endian::little;
  std::string type = "Int64";
  bool has_long_header = true;
  std::vector<std::int64_t> corners = {0, 1, 2, 2, 1, 3};
  std::vector<std::int64_t> ends = {3, 6};
  std::string more;  // attributes of the file
  std::string encoding = "raw";
  std::string format = "appended";
  std::string behind;  // behind the piece

  [[nodiscard]] std::string array(const std::vector<std::int64_t>& values) const {
    std::string bytes;
    for (const std::int64_t value : values) {
      bytes += type.ends_with("64") ? stored(value, order)
                                    : stored(static_cast<std::int32_t>(value), order);
    }
    const std::uint64_t size = bytes.size();
    return (has_long_header ? stored(size, order)
                            : stored(static_cast<std::uint32_t>(size), order)) +
           bytes;
  }
  [[nodiscard]] std::string bytes() const {
    const std::string first = array({5, 6, 7});
    const std::string connectivity = array(corners);
    const auto tag = [&](const std::string& name, std::size_t offset) {
      return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"" + format +
             "\" offset=\"" + std::to_string(offset) + "\"/>\n";
    };
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" byte_order=\"" +
           std::string(order == std::endian::big ? "BigEndian" : "LittleEndian") + "\"" +
           (has_long_header ? " header_type=\"UInt64\"" : "") + more +
           ">\n<PolyData><Piece>\n<Verts>" + tag("connectivity", 0) + "</Verts>\n<Polys>\n" +
           tag("connectivity", first.size()) + tag("offsets", first.size() + connectivity.size()) +
           "</Polys></Piece>" + behind + "\n</PolyData>\n<AppendedData encoding=\"" + encoding +
           "\">\n _" + first + connectivity + array(ends);
  }
};

TEST(vtp, is_read_with_integers_of_any_width_and_order) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    for (const char* const type : {"Int32", "UInt32", "Int64", "UInt64"}) {
      for (const bool has_long_header : {false, true}) {
        VtpFile file;
        file.order = order;
        file.type = type;
        file.has_long_header = has_long_header;
        const std::string bytes = file.bytes();
        EXPECT_EQ(io::read_vtp(bytes), (Triples{{0, 1, 2}, {2, 1, 3}}));
        EXPECT_EQ(io::read_vtp(bytes + "\n</AppendedData><Piece>").size(), 2U);
        EXPECT_EQ(refused(io::read_vtp, bytes.substr(0, bytes.size() - 1)), "the file is cut off");
        const std::size_t size = type[std::string_view(type).size() - 1] == '4' ? 8 : 4;
        const std::size_t whole = 2 * size + (has_long_header ? 8 : 4);  // the array of ends
        EXPECT_EQ(refused(io::read_vtp, bytes.substr(0, bytes.size() - whole)),
                  "the file is cut off");
        EXPECT_EQ(refused(io::read_vtp, bytes.substr(0, bytes.size() - whole + 1)),
                  "the file is cut off");
      }
    }
  }
}

TEST(vtp, is_refused_with_what_is_wrong) {
  const auto said = [](const auto& change) {
    VtpFile file;
    change(file);
    return refused(io::read_vtp, file.bytes());
  };
  EXPECT_EQ(refused(io::read_vtp, "<VTKFile type=\"Other\">"), "not a .vtp file");
  EXPECT_EQ(refused(io::read_vtp, "<a>"), "not a .vtp file");
  EXPECT_EQ(refused(io::read_vtp, "<VTKFile type=\"PolyData\">"), "data that is not appended raw");
  EXPECT_EQ(said([](VtpFile& f) { f.more = " compressor=\"z\""; }), "compressed data is not read");
  EXPECT_EQ(said([](VtpFile& f) { f.encoding = "base64"; }), "data that is not appended raw");
  EXPECT_EQ(said([](VtpFile& f) { f.format = "ascii"; }), "data that is not appended raw");
  EXPECT_EQ(said([](VtpFile& f) { f.type = "Float64"; }), "indices of type \"Float64\"");
  EXPECT_EQ(said([](VtpFile& f) { f.behind = "<Piece>"; }), "more than one piece");
  EXPECT_EQ(said([](VtpFile& f) { f.ends = {3, 7}; }), "polygon 1 is not a triangle");
  EXPECT_EQ(said([](VtpFile& f) { f.ends = {4, 6}; }), "polygon 0 is not a triangle");
  EXPECT_EQ(said([](VtpFile& f) { f.corners.pop_back(); }), "polygons without corners");
  EXPECT_EQ(said([](VtpFile& f) { f.corners[4] = -3; }), "negative index -3");
  EXPECT_EQ(said([](VtpFile& f) { f.ends = {3}; }), "");
  EXPECT_EQ(said([](VtpFile& f) { f.ends = {}; }), "");
  const auto without = [](const std::string& text) {
    std::string bytes = VtpFile().bytes();
    return refused(io::read_vtp, bytes.replace(bytes.find(text), text.size(), "x"));
  };
  EXPECT_EQ(without("<Polys>"), "no polygons");
  EXPECT_EQ(without("\"offsets\""), "polygons without their arrays");
  EXPECT_EQ(without("offset=\"32\""), "offset \"\" is not an integer");
  std::string bytes = VtpFile().bytes();
  EXPECT_EQ(refused(io::read_vtp, bytes.replace(bytes.find("\"32\""), 4, "\"-1\"")),
            "the file is cut off");
}

}  // namespace
}  // namespace rondel::test::of_meshes
