// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_file, FilesTogether::commit, write_indices, write_numbers, read_sites, read_triangles,
// SiteTable::where, SiteTable::selection, Column::cell, Column::add, Column::empty_copy,
// Column::has_wide_integers, value_columns, free_names on files of any bytes and any ending: what a
// file holds, and messages of one line that begin with its name.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "rondel/error.h"

namespace rondel::fuzz {
namespace {

constexpr std::array endings = {".csv", ".tsv", ".xyz", ".txt", ".npy", ".geojson", ".NPY",
                                ".off", ".ply", ".obj", ".vtp", ".stl", ".dat",     ""};

void require_message(const FileError& error, const std::string& path) {
  const std::string what = error.what();
  require(what.starts_with(path + ":"), "a message starts with the file: " + what);
  require(what.find('\n') == std::string::npos, "a message is one line: " + what);
}

// Cells of a column are the text, names differ, and a selection has the cells that are kept.
void test_columns(const std::string& path) {
  try {
    ReadOptions options;
    options.keep_columns = true;
    const SiteTable table = read_sites(path, options);
    std::vector<std::string> names;
    for (const Column& column : table.columns) {
      names.push_back(column.name);
      Column copy = column.empty_copy();
      std::string text;
      for (std::size_t i = 0; i < column.ends.size(); ++i) {
        text += column.cell(i);
        copy.add(column, i);
      }
      require(column.ends.size() == table.sites.size() && text == column.text,
              "cells are the text");
      require(copy.text == text && copy.ends == column.ends && copy.is_json == column.is_json &&
                  copy.has_wide_integers() == column.has_wide_integers(),
              "a column is copied");
    }
    for (const std::string& name : value_columns(table, options)) {
      require(std::ranges::count(names, name) > 0, "a column of values is a column");
    }
    names = free_names(names, {"area"}, true);
    std::ranges::sort(names);
    require(std::ranges::adjacent_find(names) == names.end(), "names differ");
  } catch (const FileError& error) {
    require_message(error, path);
  }
}

void test_sites(const std::string& path) {
  try {
    const SiteTable table = read_sites(path);
    require(table.name == path, "a table has the file's name");
    require(table.is_lonlat() == !table.positions.empty(), "positions are those of the file");
    for (const Point& p : table.sites) {
      require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "sites are finite");
    }
    for (std::size_t i = 0; i < table.sites.size(); ++i) {
      require(table.where(i).starts_with(path + ":"), "a site is somewhere");
    }
    std::vector<bool> is_odd;
    for (std::size_t i = 0; i < table.sites.size(); ++i) is_odd.push_back(i % 2 == 1);
    const SiteTable odd = table.selection(is_odd);
    require(odd.sites.size() == table.sites.size() / 2, "a selection has the sites that are kept");
    for (std::size_t i = 0; i < odd.sites.size(); ++i) {
      require(odd.sites[i] == table.sites[2 * i + 1] && odd.where(i) == table.where(2 * i + 1),
              "a selection keeps the order and the places");
    }
  } catch (const FileError& error) {
    require_message(error, path);
  }
}

void test_triangles(const std::string& path) {
  try {
    static_cast<void>(read_triangles(path));
  } catch (const FileError& error) {
    require_message(error, path);
  }
}

// Rows of three are read back as triangles.
void test_indices(const std::string& path, const std::string& bytes) {
  std::vector<Index> values;
  for (const char byte : bytes) {
    values.push_back(static_cast<Index>(static_cast<unsigned char>(byte)) * 16'843'009U);
  }
  values.resize(values.size() - values.size() % 3);
  write_indices(path, values, std::array<std::uint64_t, 2>{values.size() / 3, 3});
  if (values.empty() || std::ranges::find(values, no_index) != values.end()) return;
  std::vector<Index> back;
  for (const Triple& row : read_triangles(path)) back.insert(back.end(), row.begin(), row.end());
  require(back == values, "indices survive");
}

// Numbers are those of the bytes, behind the header.
void test_numbers(const std::string& path, const std::string& bytes) {
  std::vector<double> values(bytes.size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
  const std::array<std::uint64_t, 2> shape = {1, values.size()};
  write_numbers(path, values, std::span(shape).first(values.size() % 2 == 0 ? 0 : shape.size()));
  const std::string written = content(path);
  const std::string expected = bytes.substr(0, values.size() * sizeof(double));
  require(written.ends_with("\n" + expected), "numbers survive");
  std::string in_memory;
  write_numbers(FileName::in_memory(in_memory, "npy"), values,
                std::span(shape).first(values.size() % 2 == 0 ? 0 : shape.size()));
  require(in_memory == written, "a string is like a file");
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  static const fuzz::ScratchFolder folder;
  if (size == 0) return 0;
  const std::string ending = fuzz::endings[data[0] % fuzz::endings.size()];
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string path = folder.file("bytes" + ending);
  FilesTogether files;
  write_file(path, bytes);
  files.commit();
  fuzz::require(fuzz::content(path) == bytes, "a file holds what was written");
  fuzz::test_sites(path);
  fuzz::test_columns(path);
  fuzz::test_triangles(path);
  fuzz::test_indices(folder.file("indices.npy"), bytes);
  fuzz::test_numbers(folder.file("numbers.npy"), bytes);
  return 0;
}
