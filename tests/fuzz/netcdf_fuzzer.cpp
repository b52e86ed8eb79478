// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The reader of netCDF on any bytes: values of all variables, or a message of one line. What is read is
// written, and is the same when it is read again.
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "io/bad_value.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_writer.h"

namespace rondel::fuzz {
namespace {

using io::NetcdfReader;
using io::NetcdfType;

// So many values are written again: a small file may have a thousand variables that are the same bytes.
constexpr std::size_t max_values = 1 << 16;

void require_numbers(const io::VariableInFile& variable, const std::vector<double>& values) {
  std::uint64_t size = 1;
  for (const std::uint64_t length : variable.shape) size *= length;
  require(values.size() == size, "a variable has the values of its shape");
}

void test_round_trip(const std::string& path, const io::VariableInFile& variable,
                     const std::vector<double>& values) {
  io::AtomicFile file(path);
  io::NetcdfWriter writer(file);
  std::vector<std::size_t> dimensions;
  for (const std::uint64_t length : variable.shape) {
    dimensions.push_back(writer.add_dimension("d" + std::to_string(dimensions.size()), length));
  }
  writer.add_variable({variable.name, NetcdfType::float64, dimensions, {}});
  writer.begin();
  writer.write<double>(values);
  writer.finish();
  file.commit();
  const std::string bytes = content(path);
  const NetcdfReader back(bytes);
  const std::vector<double> same = back.numbers(back.require(variable.name));
  require(same.size() == values.size(), "as many values are read as were written");
  for (std::size_t i = 0; i < values.size(); ++i) {
    require(std::bit_cast<std::uint64_t>(values[i]) == std::bit_cast<std::uint64_t>(same[i]),
            "values survive");
  }
}

void test(const std::string& path, std::string_view bytes) {
  const NetcdfReader reader(bytes);
  std::size_t num_values = 0;
  for (const io::VariableInFile& variable : reader.variables()) {
    if (variable.type == NetcdfType::text) continue;
    num_values += variable.num_values;
    if (num_values > max_values) return;
    const std::vector<double> values = reader.numbers(variable);
    require_numbers(variable, values);
    if (num_values == variable.num_values) test_round_trip(path, variable, values);
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const rondel::fuzz::ScratchFolder folder;
  try {
    rondel::fuzz::test(folder.file("again.nc"), {reinterpret_cast<const char*>(data), size});
  } catch (const rondel::io::BadValue& bad) {
    const std::string what = bad.what();
    rondel::fuzz::require(!what.empty() && what.find('\n') == std::string::npos,
                          "a message is one line: " + what);
  }
  return 0;
}
