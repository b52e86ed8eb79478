// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/grid_of_file.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <system_error>

#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "rondel/error.h"
#include "rondel/named_grids.h"

namespace rondel::formats {
namespace {

// Returns what attributes say of a grid.
GridMapping mapping_of(std::span<const io::NetcdfAttribute> attributes) {
  GridMapping mapping;
  for (const io::NetcdfAttribute& attribute : attributes) {
    if (!attribute.text.empty()) mapping.texts.emplace_back(attribute.name, attribute.text);
    if (attribute.numbers.empty()) continue;
    mapping.numbers.emplace_back(attribute.name, attribute.numbers.front());
  }
  return mapping;
}

// True if the file has the dimensions of the grid. A file may also have some of its points, with their
// longitudes and latitudes.
bool has_dimensions_of(const io::NetcdfReader& reader, const std::string& name) {
  const auto has = [&](std::uint64_t length) {
    return std::ranges::count(reader.dimensions(), length, &io::NetcdfDimension::size) != 0;
  };
  try {
    const NamedGrid grid(name);
    return has(grid.num_cells()) || std::ranges::all_of(grid.shape(), has);
  } catch (const InvalidInput& error) {
    throw io::BadValue(error.what());
  }
}

}  // namespace

// A pipe and standard input can be read once, which is left to the reader of their content.
std::string grid_named_by_file(const FileName& file) {
  std::error_code error;
  const bool is_pipe = std::filesystem::exists(file.path, error) &&
                       !std::filesystem::is_regular_file(file.path, error);
  if (file.bytes == nullptr && (is_pipe || file.path == "-")) return {};
  io::FileBytes bytes(file_and_variable(file).first, true);
  if (!io::is_netcdf(bytes.head())) return {};
  return io::in_file(bytes.name(), [&] {
    const io::NetcdfReader reader(bytes);
    std::string name = grid_named_by(mapping_of(reader.attributes()));
    if (!name.empty() && has_dimensions_of(reader, name)) return name;
    for (const io::VariableInFile& variable : reader.variables()) {
      name = grid_named_by(mapping_of(variable.attributes));
      if (!name.empty() && has_dimensions_of(reader, name)) return name;
    }
    return std::string();
  });
}

}  // namespace rondel::formats
