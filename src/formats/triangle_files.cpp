// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// read_triangle_mesh() and write_triangle_mesh() pick the format of a mesh of triangles.
#include "rondel/triangle_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "formats/ocean_lines.h"
#include "io/atomic_file.h"
#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "meshing/flat_triangles.h"
#include "meshing/sound_positions.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel::mesh {
namespace {

// A format of text, by an ending or a name.
struct OceanFormat {
  std::string_view ending;
  void (*write)(io::AtomicFile&, const formats::MeshOfFile&);
  void (*read)(std::string_view, formats::MeshInFile&);
};
constexpr std::array<OceanFormat, 10> ocean_formats = {
    {{".msh", &formats::write_gmsh4, &formats::read_gmsh},
     {".14", &formats::write_gr3, &formats::read_gr3},
     {".gr3", &formats::write_gr3, &formats::read_gr3},
     {".ll", &formats::write_gr3, &formats::read_gr3},
     {".2dm", &formats::write_2dm, &formats::read_2dm},
     {".gmsh", &formats::write_gmsh4, &formats::read_gmsh},
     {".gmsh2", &formats::write_gmsh2, &formats::read_gmsh},
     {".adcirc", &formats::write_gr3, &formats::read_gr3},
     {".schism", &formats::write_gr3, &formats::read_gr3},
     {".sms", &formats::write_2dm, &formats::read_2dm}}};

const OceanFormat* ocean_format(const FileName& file) {
  return io::find_format<OceanFormat>(ocean_formats, file);
}

// True if a file has x, y and z of its nodes; others have longitudes and latitudes.
bool is_gmsh(const FileName& file) {
  const OceanFormat* const format = ocean_format(file);
  return format != nullptr && format->read == &formats::read_gmsh;
}

constexpr std::string_view fesom_nodes = "nod2d.out";

// True if a file is a folder of FESOM, or its file of nodes.
bool is_fesom(const FileName& file) {
  if (!file.format.empty()) return io::ending(file) == ".fesom";
  if (file.bytes != nullptr) return false;
  const std::filesystem::path path(file.path);
  std::error_code error;
  return path.filename() == fesom_nodes || std::filesystem::exists(path / fesom_nodes, error);
}

// Returns the beginning of the names of the files of FESOM: "mesh/", or nothing.
std::string fesom_folder(const FileName& file) {
  if (file.bytes != nullptr || file.path == "-") {
    throw FileError(file.path + ": a mesh of FESOM is a folder");
  }
  const std::string_view path = file.path;
  const std::size_t name = path.rfind('/') + 1;
  if (path.substr(name) == fesom_nodes) return std::string(path.substr(0, name));
  return file.path + (path.ends_with('/') ? "" : "/");
}

// True if a file is netCDF of UGRID by its name.
bool is_ugrid_file(const FileName& file) {
  const std::string ending = io::ending(file);
  return ending == ".ugrid" || ending == ".nc" || ending == ".nc4" || ending == ".ug";
}

// Reads the file in its format, without FESOM's.
void read_into(const FileName& name, formats::MeshInFile& file) {
  const std::pair<FileName, std::string> divided = file_and_variable(name);
  const FileName& whole = divided.first;
  io::FileBytes bytes(whole, true);
  const OceanFormat* const format = ocean_format(whole);
  io::in_file(bytes.name(), [&] {
    if (format != nullptr) {
      if (bytes.head().empty()) throw io::BadValue("the file is empty");
      format->read(bytes.text(), file);
    } else if (is_ugrid_file(whole) || io::is_netcdf(bytes.head())) {
      const io::NetcdfReader reader(bytes);
      formats::read_ugrid_triangles(reader, divided.second, file);
    } else {
      io::throw_unknown_ending(
          name, "meshes of triangles are read from",
          std::array<std::string_view, 6>{".msh", ".14", ".gr3", ".ll", ".2dm", ".nc"});
    }
    formats::complete_mesh(file);
  });
}

// Returns what of a mesh a format does not hold. FESOM's alone has levels, and no segments.
std::vector<std::string> lost_in(bool is_fesom, bool is_in_space, bool has_types,
                                 const TriangleMesh& mesh) {
  std::vector<std::string> remarks;
  if (!is_fesom && !mesh.levels.empty()) {
    remarks.push_back("the " + std::to_string(mesh.levels.size()) +
                      " levels are left out, which files of FESOM alone have");
  }
  const auto has_type = [](const BoundarySegment& one) { return one.type.has_value(); };
  if (!has_types && std::ranges::any_of(mesh.boundary, has_type)) {
    remarks.emplace_back(
        "the types of segments (IBTYPE) are left out, which files of ADCIRC, SCHISM and UGRID "
        "have");
  }
  const auto is_beyond = [](const LonLat& place) { return std::abs(place.lon_deg) > 180; };
  if (is_in_space && std::ranges::any_of(mesh.positions, is_beyond)) {
    remarks.emplace_back(
        "nodes become x, y, z, from which longitudes are read as -180 to 180: those of this mesh "
        "are others");
  }
  const auto is_open = [](const BoundarySegment& one) { return one.kind == BoundaryKind::open; };
  if (is_fesom && std::ranges::any_of(mesh.boundary, is_open)) {
    remarks.emplace_back(
        "open segments are left out: FESOM takes all nodes of the border for coast");
  }
  return remarks;
}

}  // namespace

bool is_triangle_mesh_file(const FileName& file) {
  return ocean_format(file) != nullptr || is_fesom(file);
}

bool is_ugrid_of_triangles(const FileName& file) {
  const system::Call call({});
  const FileName whole = file_and_variable(file).first;
  std::error_code error;
  if (whole.bytes == nullptr && !std::filesystem::is_regular_file(whole.path, error)) {
    return false;  // a pipe can be read once
  }
  try {
    io::FileBytes bytes(whole, true);
    return io::is_netcdf(bytes.head()) &&
           formats::has_triangles_without_centers(io::NetcdfReader(bytes));
  } catch (const FileError&) {
    return false;
  } catch (const io::BadValue&) {
    return false;
  }
}

bool has_nodes_in_degrees(const FileName& file) {
  return can_write_triangle_mesh(file) && !is_gmsh(file);
}

bool can_write_triangle_mesh(const FileName& file) {
  return is_triangle_mesh_file(file) || is_ugrid_file(file);
}

void write_triangle_mesh(const FileName& name, const TriangleMesh& mesh,
                         const NetcdfOptions& netcdf, const Execution& execution,
                         std::vector<std::string>* remarks) {
  const system::Call call(execution);
  if (mesh.triangles.empty()) throw InvalidInput("there are no triangles");
  require_valid(mesh);
  const bool is_in_space = is_gmsh(name);
  const formats::MeshOfFile content = {
      mesh, is_in_space ? std::vector<LonLat>() : meshing::sound_positions(mesh), execution};
  const OceanFormat* const format = ocean_format(name);
  std::size_t num_clockwise = 0;
  if (!is_in_space && (format != nullptr || is_fesom(name))) {
    num_clockwise = meshing::require_area_in_degrees(content.positions, mesh.triangles);
  }
  if (remarks != nullptr) {
    const bool has_types = format == nullptr || format->write == &formats::write_gr3;
    *remarks = lost_in(is_fesom(name), is_in_space, !is_fesom(name) && has_types, mesh);
    if (num_clockwise > 0) {
      remarks->push_back(std::to_string(num_clockwise) + " of " +
                         std::to_string(mesh.triangles.size()) +
                         (num_clockwise == 1 ? " triangles is" : " triangles are") +
                         " clockwise in the plane of longitude and latitude, where some "
                         "models compute");
    }
  }
  if (is_fesom(name)) return formats::write_fesom(fesom_folder(name), content);
  if (format == nullptr && !is_ugrid_file(name)) {
    io::throw_unknown_ending(
        name, "meshes of triangles are written as",
        std::array<std::string_view, 7>{".msh", ".14", ".gr3", ".ll", ".2dm", ".nc", "fesom"});
  }
  io::AtomicFile file(name);
  if (format != nullptr) {
    format->write(file, content);
  } else {
    io::in_file(name.path, [&] {
      formats::write_ugrid_triangles(file, content, io::with_kind(netcdf, name));
    });
  }
  file.commit();
}

TriangleMesh read_triangle_mesh(const FileName& name, const Execution& execution,
                                std::vector<std::string>* remarks) {
  const system::Call call(execution);
  formats::MeshInFile file;
  if (is_fesom(name)) {
    formats::read_fesom(fesom_folder(name), file);
  } else {
    read_into(name, file);
  }
  if (remarks != nullptr) *remarks = std::move(file.remarks);
  return std::move(file.mesh);
}

}  // namespace rondel::mesh
