// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/grid_of_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "formats/cf_reader.h"
#include "formats/cf_values.h"
#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/number.h"
#include "rondel/conventions.h"
#include "rondel/error.h"
#include "rondel/named_grids.h"
#include "system/message_text.h"

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

constexpr double max_apart_deg = 1e-4;  // of coordinates in single precision

// True if axes have the same places, in the same order.
bool are_axes_of(const io::NetcdfReader& reader, const io::VariableInFile& lon,
                 const io::VariableInFile& lat, const LonLatAxes& axes) {
  const std::vector<double> lon_deg = degrees_of(reader, lon, UsualUnits::of_name, {nullptr, &lat});
  const std::vector<double> lat_deg = degrees_of(reader, lat, UsualUnits::of_name, {nullptr, &lon});
  const auto is_same = [&](const LonLat& a, const LonLat& b) {
    return is_same_place(a, b, max_apart_deg);
  };
  for (std::size_t i = 0; i < lon_deg.size(); ++i) {
    if (!is_same({lon_deg[i], 0}, {axes.lon_deg[i], 0})) return false;
  }
  for (std::size_t i = 0; i < lat_deg.size(); ++i) {
    if (!is_same({0, lat_deg[i]}, {0, axes.lat_deg[i]})) return false;
  }
  return true;
}

// Compares some of the places of a file with those of a grid, a few next to each other at a time.
class PlaceSamples {
 public:
  PlaceSamples(const io::NetcdfReader& reader, const std::vector<VariableHeader>& headers,
               const CoordinatePair& pair)
      : reader_(reader), lon_(reader.variables()[pair.lon]), lat_(reader.variables()[pair.lat]) {
    const VariableHeader* const lat[] = {&headers[pair.lat]};
    const VariableHeader* const lon[] = {&headers[pair.lon]};
    units_ = {degrees_per_unit(headers[pair.lon], lat), degrees_per_unit(headers[pair.lat], lon)};
  }

  [[nodiscard]] bool are_those_of(const PlacesOfGrid& grid) const {
    constexpr std::uint64_t windows = 16;
    constexpr std::uint64_t most = 64;  // places of a window
    const std::uint64_t size = std::min(most, grid.num_places);
    for (std::uint64_t k = 0; k < windows; ++k) {
      const std::uint64_t begin = (grid.num_places - size) / (windows - 1) * k;
      if (!are_same(grid, k + 1 == windows ? grid.num_places - size : begin, size)) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] bool are_same(const PlacesOfGrid& grid, std::uint64_t begin,
                              std::uint64_t size) const {
    const std::vector<double> lon = part_of(lon_, units_[0], begin, size);
    const std::vector<double> lat = part_of(lat_, units_[1], begin, size);
    for (std::size_t i = 0; i < size; ++i) {
      if (!is_same_place({lon[i], lat[i]}, grid.place(begin + i), max_apart_deg)) return false;
    }
    return true;
  }
  [[nodiscard]] std::vector<double> part_of(const io::VariableInFile& variable, double unit,
                                            std::uint64_t begin, std::uint64_t size) const {
    std::vector<double> values(size);
    reader_.read_numbers(variable, begin, values);
    ValueRules(variable).apply(values);
    for (double& value : values) value *= unit;
    return values;
  }

  const io::NetcdfReader& reader_;
  const io::VariableInFile& lon_;
  const io::VariableInFile& lat_;
  std::array<double, 2> units_{};
};

// Returns the numbers of pixels that the file has, or nothing. Throws InvalidInput for others.
std::optional<NumberedPixels> pixels_of(const io::NetcdfReader& reader, const NamedGrid& grid,
                                        const std::string& mapping) {
  const auto read = [&](std::size_t variable, std::uint64_t begin, std::span<double> out) {
    reader.read_numbers(reader.variables()[variable], begin, out);
    ValueRules(reader.variables()[variable]).apply(out);
  };
  return numbered_pixels(headers_of(reader), {grid.name(), grid.num_cells(), mapping, read});
}

// Returns the cells whose centers are the places of a file without bounds, or no name.
GridOfFile cells_at_places(const io::NetcdfReader& reader, const NamedGrid& grid) {
  const std::vector<VariableHeader> headers = headers_of(reader);
  const std::vector<CoordinatePair> pairs = find_coordinates(headers);
  if (pairs.empty()) return {};
  const CoordinatePair& pair = pairs.front();
  if (pair.are_axes || pair.lon_bounds != CoordinatePair::none) return {};
  const PlaceArrays found =
      places_of(reader, reader.variables()[pair.lon], reader.variables()[pair.lat]);
  std::vector<LonLat> places;
  for (std::size_t i = 0; i < found.lon.size(); ++i) places.push_back({found.lon[i], found.lat[i]});
  std::vector<Index> numbers = grid.numbers_at(places, max_apart_deg);
  if (numbers.empty()) return {};
  return {grid.name(),
          std::move(numbers),
          found.shape.size() > 1 ? found.shape : std::vector<std::uint64_t>(),
          {}};
}

// Returns the grid that attributes name, if the file has cells of it, or else one without a name. The
// attributes are those of the variable `owner`, or of the file. Longitudes and latitudes of other
// places count before attributes, which a program may have copied.
GridOfFile grid_by(const io::NetcdfReader& reader, const GridMapping& attributes,
                   const std::string& owner, bool needs_cells) {
  const std::string name = grid_named_by(attributes);
  if (name.empty()) return {};
  const auto has = [&](std::uint64_t length) {
    return std::ranges::count(reader.dimensions(), length, &io::NetcdfDimension::size) != 0;
  };
  GridOfFile passed_over{
      .name = {},
      .why_not =
          (owner.empty() ? "its attributes name"
                         : "the attributes of " + io::in_quotes(owner) + " name") +
          " the grid " + name +
          ", but not all of its longitudes and latitudes are places of that grid, each once"};
  try {
    const NamedGrid grid(name);
    if (name.starts_with("healpix:")) {
      if (auto pixels = pixels_of(reader, grid, owner)) {
        const std::vector<Index>& numbers = pixels->numbers;
        const bool are_all = numbers.empty();
        const auto center = [&](std::size_t i) { return grid.center(are_all ? i : numbers[i]); };
        const std::uint64_t count = are_all ? grid.num_cells() : numbers.size();
        if (!may_be_at(reader, {count, nullptr, center})) return passed_over;
        return {name, numbers, {}};
      }
    }
    const auto center = [&](std::size_t i) { return grid.center(i); };
    // A file may also have some of the grid's points, with their longitudes and latitudes.
    if ((has(grid.num_cells()) || std::ranges::all_of(grid.shape(), has)) &&
        may_be_at(reader, {grid.num_cells(), grid.axes(), center})) {
      return {name, {}, {}};
    }
    GridOfFile some = needs_cells ? cells_at_places(reader, grid) : GridOfFile();
    return some.name.empty() ? passed_over : some;
  } catch (const InvalidInput& error) {
    throw io::BadValue(error.what());
  }
}

// Throws BadValue for a file with a grid mapping of HEALPix that has neither these pixels nor
// longitudes and latitudes.
void require_pixels(const io::NetcdfReader& reader) {
  for (const io::VariableInFile& variable : reader.variables()) {
    const GridMapping mapping = mapping_of(variable.attributes);
    const std::string lack = lack_of_mapping(mapping);
    const std::string name = grid_named_by(mapping);
    if ((lack.empty() && !name.starts_with("healpix:")) ||
        !find_coordinates(headers_of(reader)).empty()) {
      continue;
    }
    std::string said = "variable " + io::in_quotes(variable.name) + " is the grid mapping of ";
    if (!lack.empty()) throw io::BadValue(said.append("HEALPix, but has no ").append(lack));
    said.append(io::in_quotes(name)).append(" with ");
    said.append(std::to_string(NamedGrid(name).num_cells()));
    throw io::BadValue(
        said.append(" pixels, but no dimension is as long, and no variable has the numbers of some "
                    "of them, as a variable with the standard_name healpix_index"));
  }
}

}  // namespace

bool may_be_at(const io::NetcdfReader& reader, const PlacesOfGrid& grid) {
  const std::vector<VariableHeader> headers = headers_of(reader);
  bool has_others = false;
  for (const CoordinatePair& pair : find_coordinates(headers)) {
    const io::VariableInFile& lon = reader.variables()[pair.lon];
    const io::VariableInFile& lat = reader.variables()[pair.lat];
    bool is_there = false;
    if (pair.are_axes) {
      if (grid.axes == nullptr || lon.num_values != grid.axes->lon_deg.size() ||
          lat.num_values != grid.axes->lat_deg.size()) {
        continue;
      }
      is_there = are_axes_of(reader, lon, lat, *grid.axes);
    } else {
      if (lon.num_values != grid.num_places || lat.num_values != grid.num_places) continue;
      is_there = PlaceSamples(reader, headers, pair).are_those_of(grid);
    }
    if (is_there) return true;
    has_others = true;
  }
  return !has_others;
}

void require_named_places(const io::NetcdfReader& reader, const PlacesOfGrid& grid) {
  constexpr std::uint64_t num_compared = 1000;
  if (grid.num_places == 0 || !find_coordinates(headers_of(reader)).empty()) return;
  const auto compare = [&](std::span<const io::NetcdfAttribute> attributes,
                           const std::string& owner) {
    const std::string name = grid_named_by(mapping_of(attributes));
    if (name.empty()) return;
    const NamedGrid named(name);
    std::vector<Index> numbers;
    if (name.starts_with("healpix:")) {
      if (auto pixels = pixels_of(reader, named, owner)) numbers = std::move(pixels->numbers);
    }
    const std::uint64_t count = numbers.empty() ? named.num_cells() : numbers.size();
    if (count != grid.num_places) return;
    const std::uint64_t step = std::max<std::uint64_t>(1, count / num_compared);
    for (std::uint64_t i = 0; i < count; i += step) {
      const LonLat wanted = grid.place(i);
      const LonLat there = named.center(numbers.empty() ? i : numbers[i]);
      if (std::isnan(wanted.lon_deg) || is_same_place(wanted, there, max_apart_deg)) continue;
      throw io::BadValue("its attributes name the grid " + name +
                         ", whose places are others than those that are wanted");
    }
  };
  const auto compare_grids = [&](std::span<const io::NetcdfAttribute> attributes,
                                 const std::string& owner) {
    try {
      compare(attributes, owner);
    } catch (const InvalidInput&) {
      return;  // they name no grid
    }
  };
  compare_grids(reader.attributes(), {});
  for (const io::VariableInFile& variable : reader.variables()) {
    compare_grids(variable.attributes, variable.name);
  }
}

GridOfFile listed_pixels(const io::NetcdfReader& reader) {
  const auto listed_by = [&](std::span<const io::NetcdfAttribute> attributes,
                             const std::string& owner) -> GridOfFile {
    try {
      const std::string name = grid_named_by(mapping_of(attributes));
      if (!name.starts_with("healpix:")) return {};
      std::optional<NumberedPixels> pixels = pixels_of(reader, NamedGrid(name), owner);
      if (!pixels) return {};
      return {name, std::move(pixels->numbers), {}, reader.variables()[pixels->variable].name};
    } catch (const InvalidInput&) {
      return {};
    }
  };
  GridOfFile found = listed_by(reader.attributes(), "");
  for (const io::VariableInFile& variable : reader.variables()) {
    if (!found.name.empty()) break;
    found = listed_by(variable.attributes, variable.name);
  }
  return found;
}

bool is_read_once(const FileName& file) {
  std::error_code error;
  const bool is_pipe = std::filesystem::exists(file.path, error) &&
                       !std::filesystem::is_regular_file(file.path, error);
  return file.bytes == nullptr && (is_pipe || file.path == "-");
}

// What can be read once is left to the reader of its content.
GridOfFile grid_of_file(const FileName& file, bool needs_cells) {
  if (is_read_once(file)) return {};
  io::FileBytes bytes(file_and_variable(file).first, true);
  if (!io::is_netcdf(bytes.head())) return {};
  return io::in_file(bytes.name(), [&] {
    const io::NetcdfReader reader(bytes);
    GridOfFile grid = grid_by(reader, mapping_of(reader.attributes()), {}, needs_cells);
    for (const io::VariableInFile& variable : reader.variables()) {
      if (!grid.name.empty()) return grid;
      std::string why_not = std::move(grid.why_not);
      grid = grid_by(reader, mapping_of(variable.attributes), variable.name, needs_cells);
      if (grid.why_not.empty()) grid.why_not = std::move(why_not);
    }
    if (grid.name.empty()) require_pixels(reader);
    return grid;
  });
}

}  // namespace rondel::formats
