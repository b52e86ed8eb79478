// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files of netCDF-4 and of the classic formats, of any shapes: what is written is read, as a whole, in slices and in boxes with the
// dimensions in any order, from a path and from bytes; a file that is cut is refused in one line. Other damage is not tried: HDF5
// does not survive all bytes. Without netCDF-C only the classic formats are.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "io/bad_value.h"
#include "io/netcdf_boxes.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_writer.h"

namespace rondel::fuzz {
namespace {

using io::NetcdfReader;
using io::NetcdfType;
using Values = std::vector<double>;

constexpr NetcdfKind kinds[] = {NetcdfKind::cdf2, NetcdfKind::cdf5, NetcdfKind::netcdf4};
constexpr NetcdfType types[] = {NetcdfType::float64, NetcdfType::float32, NetcdfType::int32};

struct WrittenArray {
  NetcdfOptions options;
  NetcdfType type = NetcdfType::float64;
  std::vector<std::uint64_t> shape;
  Values values;
};

WrittenArray next_array(ByteSource& source) {
  WrittenArray array;
  array.options = {kinds[source.below(3)], static_cast<int>(source.below(10))};
  array.type = types[source.below(3)];
  std::uint64_t size = 1;
  for (std::size_t rank = source.below(5); rank > 0; --rank) {
    array.shape.push_back(1 + source.below(source.below(4) == 0 ? 60 : 5));
    size *= array.shape.back();
  }
  const bool is_double = array.type == NetcdfType::float64;
  while (array.values.size() < size) {
    array.values.push_back(is_double && !source.is_empty() ? source.any_double() : source.small());
  }
  return array;
}

// False where netCDF-C is wanted and not there.
bool write_array(const std::string& path, const WrittenArray& array) {
  io::AtomicFile file(path);
  io::NetcdfWriter out(file);
  std::vector<std::size_t> dimensions;
  for (const std::uint64_t length : array.shape) {
    dimensions.push_back(out.add_dimension("d" + std::to_string(dimensions.size()), length));
  }
  out.add_variable({"v", array.type, dimensions, {}});
  try {
    out.begin(array.options);
  } catch (const io::BadValue&) {
    return false;
  }
  const auto value = [&](std::size_t i) { return array.values[i]; };
  if (array.type == NetcdfType::float64) {
    out.write_values<double>(array.values.size(), value);
  } else if (array.type == NetcdfType::float32) {
    out.write_values<float>(array.values.size(), value);
  } else {
    out.write_values<std::int32_t>(array.values.size(), value);
  }
  out.finish();
  file.commit();
  return true;
}

void require_same(const Values& found, const Values& wanted, const char* what) {
  require(found.size() == wanted.size(), what);
  for (std::size_t i = 0; i < found.size(); ++i) {
    require(std::bit_cast<std::uint64_t>(found[i]) == std::bit_cast<std::uint64_t>(wanted[i]),
            what);
  }
}

void test_box(ByteSource& source, const NetcdfReader& file, const WrittenArray& array) {
  const std::size_t rank = array.shape.size();
  io::NetcdfBox box;
  std::vector<std::size_t> order(rank);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::size_t size = 1;
  for (std::size_t d = 0; d < rank; ++d) {
    box.start.push_back(source.below(array.shape[d]));
    box.count.push_back(1 + source.below(array.shape[d] - box.start[d]));
    size *= box.count[d];
    std::swap(order[d], order[source.below(d + 1)]);
  }
  Values wanted;
  for (std::size_t i = 0; i < size; ++i) {
    std::vector<std::size_t> place(rank);
    std::size_t rest = i;
    for (std::size_t w = rank; w-- > 0;) {
      const std::size_t d = order[w];
      place[d] = box.start[d] + rest % box.count[d];
      rest /= box.count[d];
    }
    std::size_t at = 0;
    for (std::size_t d = 0; d < rank; ++d) at = at * array.shape[d] + place[d];
    wanted.push_back(array.values[at]);
  }
  Values found(size);
  io::read_in_order(file, file.require("v"), box, order, found, 1, 1 + source.byte());
  require_same(found, wanted, "a box has its values, in its order");
}

void test_reader(ByteSource& source, const NetcdfReader& file, const WrittenArray& array) {
  const io::VariableInFile& variable = file.require("v");
  require(variable.shape == array.shape && variable.type == array.type, "a variable has its form");
  require_same(file.numbers(variable), array.values, "values survive");
  const std::size_t begin = source.below(array.values.size());
  Values slice(1 + source.below(array.values.size() - begin));
  file.read_numbers(variable, begin, slice);
  const auto first = array.values.begin() + static_cast<std::ptrdiff_t>(begin);
  require_same(slice, Values(first, first + static_cast<std::ptrdiff_t>(slice.size())),
               "a slice has the values of the whole");
  test_box(source, file, array);
}

void test_cut(ByteSource& source, const std::string& bytes) {
  const std::size_t size = (source.byte() * std::size_t{256} + source.byte()) % bytes.size();
  try {
    const std::string cut = bytes.substr(0, size);
    const NetcdfReader reader(cut);
    static_cast<void>(reader.numbers(reader.require("v")));
  } catch (const io::BadValue& bad) {
    const std::string what = bad.what();
    require(!what.empty() && what.find('\n') == std::string::npos,
            "a message is one line: " + what);
    return;
  }
  require(false, "a file that is cut is refused");
}

void test(const std::string& path, ByteSource& source) {
  const WrittenArray array = next_array(source);
  if (!write_array(path, array)) return;
  const std::string bytes = content(path);
  test_reader(source, NetcdfReader(bytes), array);
  io::FileBytes file(path);
  test_reader(source, NetcdfReader(file), array);
  test_cut(source, bytes);
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // Before the folder that forbids it: the library of the system.
  static const int is_allowed = ::setenv("RONDEL_NETCDF", "", 0);
  static const rondel::fuzz::ScratchFolder folder;
  static_cast<void>(is_allowed);
  rondel::fuzz::ByteSource source(data, size);
  rondel::fuzz::test(folder.file("array.nc"), source);
  return 0;
}
