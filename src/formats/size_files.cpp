// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads spacings, densities and heights of files, at places in any order, as functions on the sphere:
// read_spacings(), read_density() and read_heights().
//
// The places of a table are its sites; those of a netCDF field are its longitudes and latitudes, or
// the cells of a mesh. The values are interpolated linearly, between the nodes of a mesh of triangles
// in these, and else on the triangulation of the places.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

#include "exact/vector.h"
#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/field_columns.h"
#include "formats/netcdf_cells.h"
#include "formats/place_values.h"
#include "formats/sea_floor.h"
#include "formats/sites_gdal.h"
#include "formats/unplaced_rows.h"
#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "io/number.h"
#include "meshing/size_raster.h"
#include "rondel/conventions.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/mesh_size_files.h"
#include "rondel/read_cells.h"
#include "rondel/triangle_files.h"
#include "system/message_text.h"

namespace rondel::mesh {
namespace {

// Spacings, or densities, or heights, at places.
struct Spacings {
  std::vector<Point> places;
  std::vector<double> values;
  std::vector<Triple> triangles;     // of a mesh, whose nodes are the places; or none
  std::vector<std::size_t> numbers;  // positions in the file
  std::string variable;              // of netCDF
  std::string units;                 // as the file says, or empty
  std::string positive;              // the same
  std::string standard_name;         // the same
  SiteTable table;                   // says where places are in the file; without name for netCDF
};

// Returns where a value is: "sites.csv:7: density 0 of 'h'", and for netCDF "f.nc: density 0 at
// place 5".
std::string text_of_value(const FileName& file, const std::string& column, const Spacings& spacings,
                          std::size_t i, const std::string& what) {
  const std::string value = what + " " + system::shortest_text(spacings.values[i]);
  const std::size_t place = spacings.numbers[i];
  if (spacings.table.name.empty()) {
    return file.path + ": " + value + " at place " + std::to_string(place);
  }
  return spacings.table.where(place) + ": " + value + " of " + io::in_quotes(column);
}

// Bounds far beyond those of any mesh, within which roots of quotients are finite.
constexpr double min_density = 1e-100;
constexpr double largest_density = 1e100;

// Returns the places of the cells of a mesh: the centers that its file has, or else the directions
// of the sums of their corners.
std::vector<Point> places_of_cells(const CellTable& table) {
  const std::vector<LonLat> centers = table.facts.given_centers();
  if (!centers.empty()) return unit_vectors(centers);
  const CellRings& cells = table.cells;
  std::vector<Point> places;
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    exact::Vector3<double> sum = {0, 0, 0};
    for (std::uint64_t k = cells.rings[cells.cells[i]]; k < cells.rings[cells.cells[i + 1]]; ++k) {
      sum = sum + exact::to_vector(cells.points[cells.corners[k]]);
    }
    // A cell without corners has no place, and then no cell is a place for values.
    if (!(norm(sum) > 0)) return {};
    places.push_back(exact::to_point(normalized(sum)));
  }
  return places;
}

// The fields of a netCDF file that may be meant.
struct NetcdfFields {
  std::vector<std::string> names;
  bool is_mesh = false;  // cells whose coordinates no attribute of a field may name
};

// Finds the fields of that name, or all fields without one.
NetcdfFields netcdf_fields(const FileName& file, const std::string& name) {
  io::FileBytes bytes(file, true);
  return io::in_file(bytes.name(), [&] {
    const io::NetcdfReader reader(bytes);
    NetcdfFields found;
    const std::vector<VariableHeader> headers = formats::headers_of(reader);
    found.is_mesh = has_mesh(headers);
    if (!name.empty()) {
      found.names.push_back(name);
      return found;
    }
    const std::vector<bool> is_part = parts_of_grids(headers);
    for (std::size_t v = 0; v < is_part.size(); ++v) {
      const io::VariableInFile& variable = reader.variables()[v];
      const std::string units = io::netcdf_text(variable.attributes, "units");
      const bool is_axis = variable.shape.size() == 1 &&
                           reader.dimensions()[variable.dimensions[0]].name == variable.name;
      const bool is_field = !variable.shape.empty() && variable.type != io::NetcdfType::text &&
                            variable.num_values > 0;
      const bool is_angle = units.starts_with("degree") || units.starts_with("rad");
      if (is_field && !is_axis && !is_angle && !is_part[v]) found.names.push_back(variable.name);
    }
    return found;
  });
}

// Returns the field at `num_points` places; with 0, at those of its own longitudes and latitudes.
// The set is empty if the variable is not one field at known places. Throws FileError.
FieldSet one_field(const FileName& file, const std::string& name, std::size_t num_points) {
  FieldSet fields = read_fields(file, {&name, 1}, num_points);
  if (fields.arrays.size() != 1 || fields.arrays.front().num_fields() != 1) return {};
  return fields;
}

// Returns the places of the field, by its coordinates or as the cells of the mesh, and its values;
// no places if nothing says where it is. An error in the file counts only if the user named the
// field.
Spacings spacings_of_field(const FileName& file, const std::string& name,
                           const std::vector<Point>& cells, bool is_named) {
  FieldSet fields;
  try {
    fields = one_field(file, name, 0);
  } catch (const FileError&) {
    if (cells.empty() && is_named) throw;
  }
  if (fields.points.empty() && !cells.empty()) {
    try {
      fields = one_field(file, name, cells.size());
    } catch (const FileError&) {
      if (is_named) throw;
    }
    fields.points = cells;
  }
  Spacings result;
  result.variable = name;
  if (fields.arrays.empty() || fields.points.size() != fields.num_points) return result;
  result.places = std::move(fields.points);
  for (const auto& [attribute, text] : fields.arrays.front().attributes) {
    if (attribute == "units") result.units = text;
    if (attribute == "positive") result.positive = text;
    if (attribute == "standard_name") result.standard_name = text;
  }
  result.values = std::move(fields.arrays.front().values);
  return result;
}

// Gives values at the nodes of a mesh of UGRID its triangles.
void add_triangles(const FileName& file, Spacings& spacings) {
  if (!is_ugrid_of_triangles(file)) return;
  try {
    TriangleMesh mesh = read_triangle_mesh(file);
    if (mesh.points == spacings.places) spacings.triangles = std::move(mesh.triangles);
  } catch (const FileError&) {
    // Values have places all the same.
  }
}

// Reads spacings from a netCDF file: of a field with coordinates, or of the cells of a mesh. Throws
// FileError unless exactly one field fits.
Spacings spacings_of_netcdf(const FileName& file, const std::string& name) {
  const NetcdfFields known = netcdf_fields(file, name);
  const std::vector<Point> cells =
      known.is_mesh ? places_of_cells(read_cells(file)) : std::vector<Point>{};
  std::vector<Spacings> found;
  for (const std::string& field : known.names) {
    Spacings one = spacings_of_field(file, field, cells, !name.empty());
    if (!one.places.empty()) found.push_back(std::move(one));
    if (found.size() > 1)
      throw FileError(file.path + ": it has several fields of numbers: name one");
  }
  if (found.size() == 1) {
    add_triangles(file, found.front());
    return std::move(found.front());
  }
  if (name.empty()) throw FileError(file.path + ": it has no field with longitudes and latitudes");
  throw FileError(file.path + ": variable \"" + name +
                  "\" is not one number at each of the places that the file has: longitudes and "
                  "latitudes of points, of a grid, or the cells of a mesh");
}

// Returns the numbers of a property of features, one for each site.
std::vector<double> numbers_of_property(const SiteTable& table, const std::string& name) {
  const auto column = std::ranges::find(table.columns, name, &Column::name);
  if (column == table.columns.end()) {
    throw FileError(table.name + ": no feature has the property " + io::in_quotes(name));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < column->ends.size(); ++i) {
    try {
      values.push_back(formats::number_in_cell(column->cell(i), name));
    } catch (const io::BadValue& bad) {
      throw FileError(table.where(i) + ": " + bad.what());
    }
  }
  return values;
}

// Reads spacings from netCDF, or from sites with a column or property of that name.
Spacings spacings_of(const FileName& file, const std::string& name, const Execution& execution) {
  if (is_netcdf_file(file)) {
    return spacings_of_netcdf(file, name);
  }
  if (is_triangle_mesh_file(file)) {
    throw FileError(file.path +
                    ": a mesh of triangles has depths alone: other numbers are read from "
                    "FILE.nc[:NAME], FILE.csv:COLUMN or FILE.geojson:PROPERTY");
  }
  const bool has_properties = io::is_geojson(file) || formats::is_read_by_gdal(file);
  ReadOptions read;
  read.keep_columns = has_properties;
  SiteTable table = read_sites(file, read, execution);
  if (name.empty()) {
    throw FileError(table.name + ": which " + (has_properties ? "property" : "column") +
                    " is meant is not said");
  }
  Spacings result;
  if (has_properties) {
    result.values = numbers_of_property(table, name);
  } else {
    formats::require_places_of_rows(table);
    FieldSet fields = read_fields(file, {&name, 1}, table.sites.size());
    result.values = std::move(fields.arrays.front().values);
  }
  result.places = std::move(table.sites);
  result.table = std::move(table);
  return result;
}

// Returns the depths of a mesh of triangles, positive down. Throws FileError if it has none, or other
// numbers are wanted.
Spacings depths_of_mesh(const FileName& file, const std::string& name, Positive wanted,
                        const Execution& execution) {
  if (wanted == Positive::up) {
    throw FileError(file.path +
                    ": a mesh of triangles has depths, where heights are wanted: --depth reads it");
  }
  TriangleMesh mesh = read_triangle_mesh(file, execution);
  if (!name.empty() && name != "depth") {
    throw FileError(file.path + ": a mesh of triangles has depths, and no " + io::in_quotes(name));
  }
  if (mesh.depths.empty()) throw FileError(file.path + ": the mesh has no depths");
  Spacings result;
  result.places = std::move(mesh.points);
  if (mesh.positions.empty()) {  // x, y, z of any length
    for (Point& node : result.places) node = normalized(node);
  }
  result.values = std::move(mesh.depths);
  result.triangles = std::move(mesh.triangles);
  return result;
}

// Adds "3 of 60 places are ...", for a number that is not 0.
void remark_on(std::size_t number, std::size_t of_all, const char* one, const char* many,
               const std::string& what, std::vector<std::string>* remarks) {
  if (number == 0 || remarks == nullptr) return;
  remarks->push_back(std::to_string(number) + " of " + std::to_string(of_all) +
                     (of_all == 1 ? " place " : " places ") + (number == 1 ? one : many) + what);
}

// Leaves out missing values; `numbers` keeps the positions of those that are left.
void drop_missing(const FileName& file, Spacings& spacings, std::vector<std::string>* remarks) {
  const std::size_t num_given = spacings.values.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < spacings.values.size(); ++i) {
    if (std::isnan(spacings.values[i])) continue;
    spacings.places[kept] = spacings.places[i];
    spacings.values[kept++] = spacings.values[i];
    spacings.numbers.push_back(i);
  }
  if (kept == 0) throw FileError(file.path + ": all of its values are missing");
  remark_on(num_given - kept, num_given, "has", "have",
            " no value: it is interpolated between the others", remarks);
  spacings.places.resize(kept);
  spacings.values.resize(kept);
  if (kept != num_given) spacings.triangles.clear();  // some of them have corners without values
}

// Returns the kilometers in one unit of length; `without_units` if there is none. Throws FileError
// for other units.
double kilometers_of(const FileName& file, const std::string& units, double without_units,
                     const char* what) {
  if (formats::without_blanks(units).empty()) return without_units;
  if (const auto kilometers = formats::kilometers_of_units(units)) return *kilometers;
  throw FileError(file.path + ": the " + what + " have the units '" + units +
                  "', which are neither kilometers nor meters");
}

// Throws FileError if the attributes of heights, or depths, say that they are the other way round.
void require_positive(const FileName& file, const Spacings& heights, Positive wanted) {
  const auto given = formats::vertical_sense_of(heights.positive, heights.standard_name);
  if (!given || given->positive == wanted) return;
  const auto text_of = [](Positive positive) {
    return positive == Positive::up ? "heights, positive up" : "depths, positive down";
  };
  throw FileError(
      file.path + ": variable " + io::in_quotes(heights.variable) + " has " +
      text_of(given->positive) + " (" + given->evidence + "), where " + text_of(wanted) +
      ", are wanted: " + (wanted == Positive::down ? "--elevation reads it" : "--depth reads it"));
}

// Says which part of the sphere has places, if the mesh goes beyond it.
void remark_on_reach(const formats::PlaceValues& values, std::span<const Point> corners,
                     std::vector<std::string>* remarks) {
  if (remarks == nullptr) return;
  const double share = values.share_of_sphere();
  if (share == 1) return;
  std::size_t num_outside = 0;
  (void)values.at(corners, &num_outside);
  if (!corners.empty() && num_outside == 0) return;
  std::array<char, 160> text{};
  std::snprintf(
      text.data(), text.size(),
      "places with values surround %.2g %% of the sphere, and the mesh goes beyond: there "
      "the value of the nearest place counts",
      100 * share);
  remarks->emplace_back(text.data());
}

// Returns true for places that count: those in the region, or all.
std::vector<bool> are_in_region(std::span<const Point> places,
                                const std::optional<SizeRegion>& region) {
  std::vector<bool> are(places.size(), true);
  if (!region) return are;
  const PlaneRaster plane(*region, 1);
  for (std::size_t i = 0; i < places.size(); ++i) are[i] = plane.contains(places[i]);
  return are;
}

// Returns the number of places that count whose value a function has not, by more than a fifth of it.
std::size_t num_lost(std::span<const Point> places, std::span<const double> values,
                     const std::vector<bool>& count, const SizeFunction& size) {
  std::size_t number = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!count[i]) continue;
    number += std::abs(size.spacing(places[i]) - values[i]) > values[i] / 5 ? 1U : 0U;
  }
  return number;
}

// Returns a raster of the region whose steps are as long as the distance of places is where they are
// closest: in a part of 1/64 of its width and height. At least it has the steps that are given.
SizeRaster raster_of_places(std::span<const Point> places, const SizeRaster& least) {
  constexpr std::size_t parts = 64;
  const SizeRegion& region = *least.region;
  const PlaneRaster plane(region, 1);
  std::vector<std::size_t> numbers(parts * parts, 0);
  const auto part_of = [&](double at, double half) {
    const double part = (at / half + 1) / 2 * static_cast<double>(parts);
    return std::min(static_cast<std::size_t>(std::max(part, 0.0)), parts - 1);
  };
  for (const Point& place : places) {
    if (!plane.contains(place)) continue;
    const auto [x, y] = plane.on_plane(place);
    ++numbers[part_of(y, plane.half(1)) * parts + part_of(x, plane.half(0))];
  }
  const auto most = static_cast<double>(std::ranges::max(numbers));
  const double area = 4 * plane.half(0) * plane.half(1) / (parts * parts);
  const double distance = std::sqrt(area / std::max(most, 1.0));
  return {region, std::max(least.steps, SizeRaster::with_step(region, distance).steps)};
}

// Returns the length of the longest step, as remarks say it: "7 km".
std::string text_of_step(const SizeRaster& raster) {
  const double km = kilometers_per_radian * raster.longest_step();
  // Steps of a face of the cube are kilometers long, and up to that.
  if (!raster.region) return std::to_string(static_cast<int>(std::ceil(km))) + " km";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g km", km);
  return text.data();
}

// Returns values at places as a function on a raster.
SizeFunction function_of(const Spacings& spacings, SizeRaster raster, const Execution& execution,
                         std::vector<std::string>* remarks, const SpacingsWanted& wanted) {
  const formats::PlaceValues values(spacings.places, spacings.values, spacings.triangles, execution,
                                    remarks);
  remark_on_reach(values, wanted.corners, remarks);
  const auto made = [&] {
    return SizeFunction::from_function(
        [&](std::span<const Point> places, std::span<double> out) {
          std::ranges::copy(values.at(places), out.begin());
        },
        raster);
  };
  if (wanted.most_steps == 0) return made();
  const std::size_t most = std::min(wanted.most_steps, raster.most_steps());
  if (raster.region) {
    raster = raster_of_places(spacings.places, raster);
    raster.steps = std::min(raster.steps, most);
  }
  SizeFunction size = made();
  // The first value counts at places that are repeated.
  const std::vector<double> given = values.at(spacings.places);
  const std::vector<bool> are_inside = are_in_region(spacings.places, raster.region);
  std::size_t lost = num_lost(spacings.places, given, are_inside, size);
  while (lost > 0 && raster.steps < most) {
    raster.steps = std::min(2 * raster.steps, most);
    size = made();
    lost = num_lost(spacings.places, given, are_inside, size);
  }
  remark_on(lost, spacings.values.size(), "has", "have",
            " another spacing by more than a fifth, since spacings are kept on a raster with steps "
            "of up to " +
                text_of_step(raster),
            remarks);
  return size;
}

}  // namespace

SizeFunction read_spacings(const FileName& file, const std::string& name, double unit,
                           const SizeRaster& raster, const Execution& execution,
                           std::vector<std::string>* remarks, const SpacingsWanted& wanted) {
  Spacings spacings = spacings_of(file, name, execution);
  drop_missing(file, spacings, remarks);
  // Meters become kilometers, which `unit` turns into radians.
  unit *= kilometers_of(file, spacings.units, 1, "spacings");
  for (std::size_t i = 0; i < spacings.values.size(); ++i) {
    double& value = spacings.values[i];
    // A spacing is an angle in radians here; no mesh has one of nearly half a circle.
    if (!(value * unit > 0 && value * unit < 3)) {
      throw FileError(text_of_value(file, name, spacings, i, "spacing") +
                      " is not positive, or too large");
    }
    value *= unit;
  }
  return function_of(spacings, raster, execution, remarks, wanted);
}

SizeFunction read_density(const FileName& file, const std::string& name, const SizeRaster& raster,
                          const Execution& execution, std::vector<std::string>* remarks,
                          const SpacingsWanted& wanted) {
  Spacings densities = spacings_of(file, name, execution);
  drop_missing(file, densities, remarks);
  for (std::size_t i = 0; i < densities.values.size(); ++i) {
    const double value = densities.values[i];
    if (value >= min_density && value <= largest_density) continue;
    throw FileError(text_of_value(file, name, densities, i, "density") +
                    " is not positive, or of no size that a mesh can have");
  }
  const double least = *std::ranges::min_element(densities.values);
  // Spacing goes with the density to the power of -1/4; the smallest density has spacing 1.
  for (double& value : densities.values) value = std::sqrt(std::sqrt(least / value));
  return function_of(densities, raster, execution, remarks, wanted);
}

std::vector<double> read_heights(const FileName& file, const std::string& name, Positive positive,
                                 std::span<const Point> nodes, const Execution& execution,
                                 std::vector<std::string>* remarks) {
  const bool is_mesh = is_triangle_mesh_file(file) && !is_netcdf_file(file);
  Spacings heights = is_mesh ? depths_of_mesh(file, name, positive, execution)
                             : spacings_of(file, name, execution);
  require_positive(file, heights, positive);
  drop_missing(file, heights, remarks);
  const double metres = 1000 * kilometers_of(file, heights.units, 1e-3, "heights");
  const formats::PlaceValues values(heights.places, heights.values, heights.triangles, execution,
                                    remarks);
  std::size_t n = 0;
  std::vector<double> result = values.at(nodes, remarks == nullptr ? nullptr : &n);
  if (n > 0) {
    remarks->push_back(std::to_string(n) + " of " + std::to_string(nodes.size()) +
                       (n == 1 ? " nodes is" : " nodes are") +
                       " outside of the places with values: the value of the nearest place counts");
  }
  for (double& height : result) height *= metres;
  return result;
}

}  // namespace rondel::mesh
