// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Grids of OASIS: several in one file, told apart by the first parts of variable names (OASIS3-MCT
// user guide, section 5.1). Grid torc has the corners torc.clo and torc.cla, which may be (corners,
// ny, nx), the centers torc.lon and torc.lat, and the mask torc.msk, where 1 is masked.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "formats/cf_reader.h"
#include "formats/netcdf_cells.h"
#include "io/bad_value.h"
#include "io/number.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using io::NetcdfReader;

// Returns the names of the grids that have corners: "bt42" for variables bt42.clo and bt42.cla.
std::vector<std::string> oasis_grids(const NetcdfReader& file) {
  std::vector<std::string> names;
  for (const io::VariableInFile& variable : file.variables()) {
    if (!variable.name.ends_with(".clo")) continue;
    const std::string name = variable.name.substr(0, variable.name.size() - 4);
    if (file.find(name + ".cla") != nullptr) names.push_back(name);
  }
  return names;
}

// Returns which dimension counts the corners of a cell: the one that the centers do not have, or
// else the last one.
std::size_t corner_dimension(const io::VariableInFile& corners, const io::VariableInFile* centers) {
  for (std::size_t d = 0; centers != nullptr && d < corners.dimensions.size(); ++d) {
    if (std::ranges::count(centers->dimensions, corners.dimensions[d]) == 0) return d;
  }
  return corners.dimensions.size() - 1;
}

// Returns positions with the corners of each cell one after the other. `corner` is the dimension
// that counts corners.
std::vector<LonLat> corners_last(const io::VariableInFile& variable, std::size_t corner,
                                 const std::vector<double>& lon, const std::vector<double>& lat) {
  std::vector<std::size_t> order;
  for (std::size_t d = 0; d < variable.shape.size(); ++d) {
    if (d != corner) order.push_back(d);
  }
  order.push_back(corner);
  const std::vector<double> lons = transposed(variable.shape, order, lon);
  const std::vector<double> lats = transposed(variable.shape, order, lat);
  std::vector<LonLat> positions(lons.size());
  for (std::size_t i = 0; i < lons.size(); ++i) positions[i] = {lons[i], lats[i]};
  return positions;
}

}  // namespace

std::optional<MeshContent> read_oasis(const NetcdfReader& file, const std::string& name) {
  const std::vector<std::string> grids = oasis_grids(file);
  if (grids.empty()) return std::nullopt;
  // A name is that of a grid, or of a variable that begins with it and a dot.
  const auto chosen = std::ranges::find_if(grids, [&](const std::string& grid) {
    return name.empty() || name == grid || name.starts_with(grid + '.');
  });
  if (chosen == grids.end()) return std::nullopt;
  MeshContent mesh;
  mesh.convention = "OASIS";
  if (name.empty() && grids.size() > 1) {
    std::string others;
    for (const std::string& grid : grids) {
      if (grid != *chosen) others += (others.empty() ? "" : ", ") + grid;
    }
    mesh.remarks.push_back("the file has several grids; " + *chosen + " is read, not " + others +
                           "; FILE.nc:NAME names one");
  }
  const io::VariableInFile& lon = file.require(*chosen + ".clo");
  const io::VariableInFile& lat = file.require(*chosen + ".cla");
  const MeshCoordinates centers = {file.find(*chosen + ".lon"), file.find(*chosen + ".lat")};
  if (lon.shape.size() < 2 || lon.shape != lat.shape || lon.num_values >= no_index) {
    throw BadValue("variables " + io::in_quotes(lon.name) + " and " + io::in_quotes(lat.name) +
                   " are no corners of cells");
  }
  const std::size_t corner = corner_dimension(lon, centers.lon);
  const auto [lons, lats] = degrees_of_both(file, {&lon, &lat}, centers, UsualUnits::degrees);
  mesh.nodes = corners_last(lon, corner, lons, lats);
  mesh.names = io::in_quotes(lon.name) + " and " + io::in_quotes(lat.name);
  mesh.is_single = lon.type == io::NetcdfType::float32;
  if (mesh.nodes.empty()) throw BadValue("grid " + *chosen + " has no cells");
  // Cells of the shape (n, corners) are a list, which has no shape.
  for (std::size_t d = 0; d < lon.shape.size() && lon.shape.size() > 2; ++d) {
    if (d != corner) mesh.shape.push_back(lon.shape[d]);
  }
  end_cells_of_nodes(lon.shape[corner], !has_rows(mesh.shape), mesh);
  take_mask(file, *chosen + ".msk", mesh.cells.num_cells(), MaskedBy::others, mesh);
  take_centers(file, centers, {&lon, &lat}, UsualUnits::degrees, mesh);
  return mesh;
}

}  // namespace rondel::formats
