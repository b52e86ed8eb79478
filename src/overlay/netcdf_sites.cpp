// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites of netCDF: centers of cells, or places of values.
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/number.h"
#include "overlay/mesh_formats.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/mesh_files.h"
#include "system/job.h"

namespace rondel {
namespace {

// Nothing where the file has no cells with centers.
std::optional<NetcdfSites> centers_of_cells(const FileName& file) {
  try {
    CellTable cells = read_cells(file);
    if (cells.centers.empty() || cells.centers.size() != cells.num_cells()) return std::nullopt;
    NetcdfSites sites;
    sites.table.positions = std::move(cells.centers);
    sites.shape = std::move(cells.shape);
    return sites;
  } catch (const FileError&) {
    return std::nullopt;  // fields need no cells
  }
}

Column column_of(const FieldArray& array) {
  Column column;
  column.name = array.name;
  column.is_numeric = true;
  for (const double value : array.values) {
    if (!std::isnan(value)) io::append_number(column.text, value);
    column.ends.push_back(column.text.size());
  }
  return column;
}

void add_columns(const FieldFile& file, SiteTable& table) {
  const FieldSet& fields = file.fields();
  for (std::size_t a = 0; a < fields.arrays.size(); ++a) {
    FieldArray array = fields.arrays[a];
    if (array.num_fields() != 1) continue;
    array.values.resize(fields.num_points);
    file.read(a, 0, array.values);
    table.columns.push_back(column_of(array));
  }
}

}  // namespace

NetcdfSites read_netcdf_sites(const FileName& file, std::span<const std::string> names,
                              bool keep_columns) {
  const system::ArithmeticScope arithmetic;
  NetcdfSites sites;
  if (std::optional<NetcdfSites> centers = centers_of_cells(file)) sites = std::move(*centers);
  const std::size_t num_centers = sites.table.positions.size();
  if (num_centers == 0 || keep_columns) {
    try {
      const FieldFile fields(file, names, num_centers);
      if (num_centers == 0) {
        sites.table.positions = fields.fields().positions;
        sites.shape = fields.fields().shape;
      }
      if (keep_columns) add_columns(fields, sites.table);
    } catch (const FileError&) {
      if (num_centers == 0 || !names.empty()) throw;  // a mesh may have no fields
    }
  }
  sites.table.name = file.path;
  sites.table.first_line = 0;
  sites.table.sites = unit_vectors(sites.table.positions);
  return sites;
}

}  // namespace rondel
