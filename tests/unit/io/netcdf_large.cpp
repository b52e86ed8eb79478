// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes a netCDF file of more than 4 GiB (netcdf_large FILE [--whole]): "many", a variable of 2^29 + 2
// doubles whose value i is i, between "few" before and "last" after it, which have the values 0.5 and 1.5.
//
// The header is the writer's. Without --whole all but the last two of "many" are a hole in the file, which
// takes neither time nor disk: the other values are put where the writer writes them, one variable right
// after the other.
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "io/netcdf_writer.h"

namespace {

using rondel::io::AtomicFile;
using rondel::io::NetcdfType;
using rondel::io::NetcdfWriter;

constexpr std::uint64_t count = (std::uint64_t{1} << 29) + 2;

void put(std::ostream& file, std::uint64_t offset, double value) {
  std::array<char, 8> bytes;
  rondel::io::store(value, bytes.data(), std::endian::big);
  file.seekp(static_cast<std::streamoff>(offset));
  file.write(bytes.data(), bytes.size());
}

void write(const std::string& path, bool is_whole) {
  AtomicFile file(path);
  NetcdfWriter out(file);
  const std::size_t one = out.add_dimension("one", 1);
  const std::size_t n = out.add_dimension("n", count);
  out.add_variable({"few", NetcdfType::float64, {one}, {}});
  out.add_variable({"many", NetcdfType::float64, {n}, {}});
  out.add_variable({"last", NetcdfType::float64, {one}, {}});
  out.begin();
  if (is_whole) {
    out.write_values<double>(1, [](std::size_t) { return 0.5; });
    out.write_values<double>(count, [](std::size_t i) { return static_cast<double>(i); });
    out.write_values<double>(1, [](std::size_t) { return 1.5; });
    out.finish();
  }
  file.commit();
  if (is_whole) return;
  const std::uint64_t header = std::filesystem::file_size(path);
  std::fstream values(path, std::ios::in | std::ios::out | std::ios::binary);
  put(values, header, 0.5);
  put(values, header + 8 * (count - 1), static_cast<double>(count - 2));
  put(values, header + 8 * count, static_cast<double>(count - 1));
  put(values, header + 8 * (count + 1), 1.5);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 1;
  write(argv[1], argc > 2 && std::string_view(argv[2]) == "--whole");
  return 0;
}
