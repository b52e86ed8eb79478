// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Grid files of the ICON grid generator: triangles (`vertex_of_cell`, which counts from 1 and has
// the cells last) with their vertices (`vlon`, `vlat`) and centers (`clon`, `clat`) in radians.
#include <string>
#include <utility>

#include "formats/netcdf_cells.h"

namespace rondel::formats {
namespace {

using io::NetcdfReader;

}  // namespace

std::optional<MeshContent> read_icon(const NetcdfReader& file, const std::string& name) {
  const io::VariableInFile* const vertices = file.find("vertex_of_cell");
  const io::VariableInFile* const lon = file.find("vlon");
  const io::VariableInFile* const lat = file.find("vlat");
  if (vertices == nullptr || lon == nullptr || lat == nullptr || !is_meant(file, name, *vertices)) {
    return std::nullopt;
  }
  MeshContent mesh;
  mesh.convention = "ICON";
  const MeshCoordinates centers = {file.find("clon"), file.find("clat")};
  take_nodes(file, {lon, lat}, centers, UsualUnits::radians, mesh);
  require_rank(*vertices, 2);
  // The shape is (3, cells), so the rows are transposed.
  take_connectivity(file, {*vertices, vertices->shape[1], vertices->shape[0], true, 1, 1}, {},
                    mesh);
  take_centers(file, centers, {lon, lat}, UsualUnits::radians, mesh);
  return mesh;
}

}  // namespace rondel::formats
