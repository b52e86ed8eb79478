// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The bytes of files, the formats that their names tell, and the headers of NumPy's arrays.
#include <array>
#include <bit>
#include <cstdint>

#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/npy_header.h"
#include "unit/io/support.h"

namespace rondel::test::of_files {
namespace {

using Shape = std::vector<std::uint64_t>;

std::string some_bytes(std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>('a' + (i * 7 + i / 300) % 26);
  return bytes;
}

TEST(file_bytes, are_read_in_two_steps) {
  constexpr std::size_t head_size = 131'072;
  const TemporaryDirectory directory;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, head_size - 1, head_size,
                                 head_size + 1, std::size_t{700'000}}) {
    const std::string bytes = some_bytes(size);
    const std::string path = directory.with("a", bytes);
    io::FileBytes file(path);
    EXPECT_EQ(file.name(), path);
    EXPECT_TRUE(file.has_path());
    EXPECT_EQ(file.claimed_size(), size);
    EXPECT_EQ(file.head(), bytes.substr(0, head_size));
    EXPECT_EQ(file.longer_head(10), bytes.substr(0, head_size));
    EXPECT_EQ(file.longer_head(head_size + 5), bytes.substr(0, head_size + 5));
    EXPECT_TRUE(file.text() == bytes);
    EXPECT_TRUE(file.text() == bytes);
    EXPECT_TRUE(file.longer_head(2 * size) == bytes);
    std::string piece(std::min<std::size_t>(size, 1000), '?');
    for (const std::size_t place :
         {std::size_t{0}, (size - piece.size()) / 2, size - piece.size()}) {
      file.read_at(place, piece.data(), piece.size());
      EXPECT_TRUE(piece == bytes.substr(place, piece.size()));
    }
    EXPECT_EQ(message_of([&] {
                std::string beyond(2, '?');
                file.read_at(size - std::min<std::size_t>(size, 1), beyond.data(), 2);
              }),
              path + ": cut off while it was read");
  }
  // A file that claims to be empty, as those of the kernel do.
  if (std::filesystem::exists("/proc/self/status")) {
    io::FileBytes file("/proc/self/status");
    EXPECT_EQ(file.claimed_size(), 0U);
    EXPECT_NE(file.text().find("Pid:"), std::string_view::npos);
  }
}

TEST(file_bytes, that_are_compressed_are_refused) {
  const TemporaryDirectory directory;
  const auto said = [&](const std::string& bytes, bool may_be_zip = false) {
    const std::string path = directory.with("a", bytes);
    const std::string message = message_of([&] { const io::FileBytes file(path, may_be_zip); });
    return message.substr(std::min(message.size(), path.size()));
  };
  EXPECT_EQ(said("\x1F\x8B"), ": compressed (gzip); unpack it first");
  EXPECT_EQ(said("PK\x03\x04x"), ": compressed (zip); unpack it first");
  EXPECT_EQ(said("PK\x03\x04x", true), "");
  EXPECT_EQ(said("\x1F\x8B", true), ": compressed (gzip); unpack it first");
  EXPECT_EQ(said(std::string("\xFD") + "7zXZ"), ": compressed (xz); unpack it first");
  EXPECT_EQ(said("\x28\xB5\x2F\xFD"), ": compressed (zstd); unpack it first");
  EXPECT_EQ(said("\x1F"), "");
  EXPECT_EQ(message_of([&] { const io::FileBytes file(directory.file("none")); }),
            directory.file("none") + ": No such file or directory");
  EXPECT_NE(message_of([&] { const io::FileBytes file(directory.file("")); }), "");
}

TEST(ending, is_of_the_format_or_of_the_path) {
  const auto of = [](const std::string& path, const std::string& format = "") {
    return io::ending(FileName{path, format});
  };
  EXPECT_EQ(of("data/Stations.CSV"), ".csv");
  EXPECT_EQ(of("a.b.nc"), ".nc");
  EXPECT_EQ(of("a.b/c"), "");
  EXPECT_EQ(of("a"), "");
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("a."), "");
  EXPECT_EQ(of("/"), "");
  EXPECT_EQ(of("a/b.npy//"), ".npy");
  EXPECT_EQ(of(".csv"), ".csv");
  EXPECT_EQ(of("a.AZ@[`"), ".az@[`");
  EXPECT_EQ(of("a.csv", "NPY"), ".npy");
  EXPECT_EQ(of("a.csv", ".Npy"), ".npy");
  for (const char* const end : {".nc", ".nc4", ".cdf", ".ncf", ".ug", ".exo", ".e", ".g", ".h5"}) {
    EXPECT_TRUE(io::has_netcdf_ending(FileName{"a" + std::string(end), ""})) << end;
    EXPECT_FALSE(io::has_netcdf_ending(FileName{"a" + std::string(end), "csv"})) << end;
  }
  EXPECT_FALSE(io::has_netcdf_ending(FileName{"a.n", ""}));
}

TEST(ending, is_the_format_of_a_file) {
  EXPECT_EQ(format_of("data/Stations.CSV"), "csv");
  EXPECT_EQ(format_of({"a.csv", ".Npy"}), "npy");
  EXPECT_EQ(format_of("cells.zarr/"), "zarr");
  EXPECT_EQ(format_of("-"), "");
}

TEST(ending, tells_a_file_from_a_variable) {
  const TemporaryDirectory directory;
  const auto parts = [](const std::string& path) {
    const auto [file, variable] = file_and_variable(path);
    return file.path + "|" + variable;
  };
  EXPECT_EQ(parts("a.nc:b"), "a.nc|b");
  EXPECT_EQ(parts("a.nc:b:c"), "a.nc|b:c");
  EXPECT_EQ(parts("a.csv:b"), "a.csv:b|");
  EXPECT_EQ(parts("C:\\a.nc"), "C:\\a.nc|");
  const std::string path = directory.with("a.nc:b", "");
  EXPECT_EQ(parts(path), path + "|");
  EXPECT_EQ(parts(path + ":c"), directory.file("a.nc") + "|b:c");
}

TEST(ending, says_which_netcdf_is_written) {
  const auto kind = [](const std::string& path, const std::string& format,
                       NetcdfKind asked = NetcdfKind::by_name) {
    return io::with_kind(NetcdfOptions{.kind = asked}, FileName{path, format}).kind;
  };
  EXPECT_EQ(kind("a.nc", ""), NetcdfKind::by_name);
  EXPECT_EQ(kind("a.nc4", ""), NetcdfKind::netcdf4);
  EXPECT_EQ(kind("a.nc4", "mpas"), NetcdfKind::netcdf4);
  EXPECT_EQ(kind("a.nc", "nc4"), NetcdfKind::netcdf4);
  EXPECT_EQ(kind("a.nc4", "", NetcdfKind::cdf2), NetcdfKind::cdf2);
}

struct Format {
  std::string_view ending;
  int number;
};

TEST(ending, finds_its_format) {
  constexpr std::array<Format, 2> formats = {{{".a", 1}, {".bc", 2}}};
  const std::span<const Format> table = formats;
  EXPECT_EQ(io::find_format(table, FileName{"x.BC", ""})->number, 2);
  EXPECT_EQ(io::find_format(table, FileName{"x.b", ""}), nullptr);
  EXPECT_EQ(io::require_format(table, FileName{"x.b", "a"}, "y").number, 1);
  const auto said = [&](const FileName& file) {
    return message_of([&] { (void)io::require_format(table, file, "cells are written as"); });
  };
  EXPECT_EQ(said({"x.b", ""}), "x.b: unknown ending \".b\"; cells are written as .a .bc");
  EXPECT_EQ(said({"x", ""}), "x: the name has no ending; cells are written as .a .bc");
  EXPECT_EQ(said({"x.a", "d"}), "x.a: unknown format \"d\"; cells are written as .a .bc");
}

// A file with this dictionary as its header.
std::string npy(const std::string& dictionary, int version = 1) {
  const std::size_t size = dictionary.size();
  std::string bytes = "\x93NUMPY" + std::string(1, static_cast<char>(version)) + '\0';
  bytes += static_cast<char>(size & 0xFFU);
  bytes += static_cast<char>(size >> 8U & 0xFFU);
  if (version != 1) bytes += std::string(2, '\0');
  return bytes + dictionary;
}

TEST(npy_header, is_a_dictionary_in_any_order) {
  for (const int version : {1, 2, 3}) {
    for (const char* const text :
         {"{'descr': '<f8', 'fortran_order': True, 'shape': (10, 3), }\n",
          R"({'shape':(10,3),'fortran_order':True,"descr":"<f8"})",
          " {\t'fortran_order' : True , 'shape' : ( 10 , 3 , ) , 'descr' : '<f8' , } "}) {
      const std::string bytes = npy(text, version);
      const io::NpyHeader header = io::parse_npy_header(bytes + "data");
      EXPECT_EQ(header.dtype, "<f8");
      EXPECT_TRUE(header.is_fortran_order);
      EXPECT_EQ(header.shape, (Shape{10, 3}));
      EXPECT_EQ(header.data_offset, bytes.size());
      EXPECT_EQ(refused([&] { (void)io::parse_npy_header(bytes.substr(0, bytes.size() - 1)); }),
                "the .npy header is cut off");
    }
  }
  const auto shape = [](const std::string& text) {
    return io::parse_npy_header(
               npy("{'descr': '|u1', 'fortran_order': False, 'shape': " + text + "}"))
        .shape;
  };
  EXPECT_EQ(shape("()"), Shape{});
  EXPECT_EQ(shape("(7,)"), Shape{7});
  EXPECT_EQ(shape("(18446744073709551615, 0)"), (Shape{~std::uint64_t{0}, 0}));
  EXPECT_FALSE(io::parse_npy_header(npy("{'descr': 'a', 'fortran_order': False, 'shape': ()}"))
                   .is_fortran_order);
}

TEST(npy_header, is_refused_with_what_is_wrong) {
  const auto said = [](const std::string& bytes) {
    return refused([&] { (void)io::parse_npy_header(bytes); });
  };
  EXPECT_EQ(said("NUMPY"), "not a .npy file");
  EXPECT_EQ(said(std::string("\x93NUMPY\1\0\0\0\0", 11)), "the .npy header is cut off");
  EXPECT_EQ(said(npy("{}", 4)), ".npy version 4 is not supported");
  EXPECT_EQ(said(npy("{}", 0)), ".npy version 0 is not supported");
  EXPECT_EQ(said(npy("{}")), "the .npy header is incomplete");
  const std::string damaged = "the .npy header is damaged";
  for (const char* const text : {"", "x", "{", "{'descr'", "{'descr' '<f8'}", "{'descr': <f8}",
                                 "{'descr': '<f8}", "{'fortran_order': true}", "{'shape': 3}",
                                 "{'shape': (3 4)}", "{'descr': '<f8' 'shape': ()}"}) {
    EXPECT_EQ(said(npy(std::string(text) + "   ")), damaged) << text;
  }
  EXPECT_EQ(said(npy("{'shape': (-3)}")), "the shape in the .npy header is damaged");
  EXPECT_EQ(said(npy("{'shape': (18446744073709551616)}")),
            "the shape in the .npy header is damaged");
  EXPECT_EQ(said(npy("{'descr': [('x', '<f8')]}")),
            "a structured dtype where plain numbers are needed");
  EXPECT_EQ(said(npy("{'other': 3}")), "unknown key \"other\" in the .npy header");
  const std::vector<std::string> members = {"'descr': 'a'", "'fortran_order': True", "'shape': ()"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(said(npy("{" + members[i] + ", " + members[(i + 1) % 3] + "}")),
              "the .npy header is incomplete");
    EXPECT_EQ(said(npy("{" + members[i] + "}")), "the .npy header is incomplete");
  }
}

TEST(npy_header, is_written_so_that_numbers_are_aligned) {
  for (const Shape& shape : {Shape{}, Shape{5}, Shape{1, 2, 3}, Shape{123'456'789, 3},
                             Shape(5, 10'000'000), Shape(40, 999)}) {
    const std::string bytes = io::make_npy_header("<f4", shape);
    EXPECT_EQ(bytes.size() % 64, 0U);
    EXPECT_EQ(bytes.back(), '\n');
    const io::NpyHeader header = io::parse_npy_header(bytes);
    EXPECT_EQ(header.data_offset, bytes.size());
    EXPECT_EQ(header.shape, shape);
    EXPECT_EQ(header.dtype, "<f4");
    const std::size_t used = bytes.find('}') + 2;  // with the end of the line
    EXPECT_LT(bytes.size() - used, 64U);
  }
  EXPECT_EQ(io::shape_text(Shape{}), "()");
  EXPECT_EQ(io::shape_text(Shape{5}), "(5,)");
  EXPECT_EQ(io::shape_text(Shape{5, 6}), "(5, 6)");
}

TEST(npy_table, has_numbers_of_known_types) {
  constexpr std::array<std::string_view, 2> types = {"u2", "u1"};
  const auto table = [&](const std::string& dtype, const std::string& shape, const char* order,
                         const std::string& data, std::uint64_t more = 0) {
    const std::string bytes =
        npy("{'descr': '" + dtype + "', 'fortran_order': " + order + ", 'shape': " + shape + "}") +
        data;
    const io::NpyTable found(bytes, bytes.size() + more, types, "naturals");
    std::string text = std::string(found.type()) + " " + std::to_string(found.num_rows()) + " " +
                       std::to_string(found.num_columns()) + ":";
    for (std::size_t row = 0; row < found.num_rows(); ++row) {
      for (std::size_t column = 0; column < found.num_columns(); ++column) {
        const unsigned number = found.type() == "u1" ? found.at<std::uint8_t>(row, column)
                                                     : found.at<std::uint16_t>(row, column);
        text += " " + std::to_string(number);
        const std::uint64_t place = found.place(row, column);
        const std::uint64_t lowest = dtype[0] == '>' ? place + 1 : place;  // of two bytes
        EXPECT_EQ(static_cast<unsigned char>(bytes[lowest]), number & 0xFFU);
      }
    }
    EXPECT_EQ(found.row_bytes(), found.num_columns() * (found.type() == "u1" ? 1 : 2));
    EXPECT_EQ(found.is_by_columns(), order == std::string("True"));
    EXPECT_EQ(found.has_native_rows(), !found.is_by_columns() && dtype[0] != '>');
    return text;
  };
  if (std::endian::native != std::endian::little) GTEST_SKIP() << "native rows are others";
  const std::string six("\1\0\2\0\3\0\4\1\5\0\6\0", 12);
  EXPECT_EQ(table("<u2", "(2, 3)", "False", six), "u2 2 3: 1 2 3 260 5 6");
  EXPECT_EQ(table("<u2", "(2, 3)", "True", six), "u2 2 3: 1 3 5 2 260 6");
  EXPECT_EQ(table(">u2", "(3, 2)", "False", six), "u2 3 2: 256 512 768 1025 1280 1536");
  EXPECT_EQ(table("|u1", "(1, 3)", "False", "\1\2\3"), "u1 1 3: 1 2 3");
  const auto said = [&](const std::string& dtype, const std::string& shape, std::size_t size,
                        std::uint64_t more = 0) {
    return refused([&] { (void)table(dtype, shape, "False", std::string(size, '\0'), more); });
  };
  EXPECT_EQ(said("|u2", "(1, 1)", 2), "dtype \"|u2\" where naturals is needed");
  EXPECT_EQ(said("u1", "(1, 1)", 1), "dtype \"u1\" where naturals is needed");
  EXPECT_EQ(said("<f8", "(1, 1)", 8), "dtype \"<f8\" where naturals is needed");
  EXPECT_EQ(said("<u2", "(4,)", 8), "shape (4,) where two dimensions are needed");
  EXPECT_EQ(said("<u2", "(1, 2, 2)", 8), "shape (1, 2, 2) where two dimensions are needed");
  EXPECT_EQ(said("<u2", "(2, 2)", 7), "shape (2, 2) needs 8 bytes, the file has 7");
  EXPECT_EQ(said("<u2", "(2, 2)", 9), "shape (2, 2) needs 8 bytes, the file has 9");
  EXPECT_EQ(said("<u2", "(2, 2)", 8, 1), "shape (2, 2) needs 8 bytes, the file has 9");
  EXPECT_EQ(said("<u2", "(4294967296, 4294967296)", 0),
            "shape (4294967296, 4294967296) is too large");
  EXPECT_EQ(said("<u2", "(9223372036854775808, 1)", 0),
            "shape (9223372036854775808, 1) is too large");
}

}  // namespace
}  // namespace rondel::test::of_files
