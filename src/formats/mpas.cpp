// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes of MPAS by "MPAS Mesh Specification", version 1.0, 2015, with what MPAS-Tools' converter
// writes besides. Numbers start at 1; rows are filled with 0, which stands for none.
//
// There are two readers: read_mpas_cells() below reads only the cells, with their corners and
// centers, for read_cells(); mpas_arrays.cpp reads the arrays of a whole mesh, for read_mesh().
//
// define_mpas() is the writer, and mpas_content() returns what it would write.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "formats/cf_reader.h"
#include "formats/mesh_file.h"
#include "formats/mpas_places.h"
#include "formats/netcdf_cells.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "meshing/consistency.h"
#include "meshing/mesh_arrays.h"
#include "rondel/delaunay.h"
#include "rondel/version.h"
#include "rondel/weights.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using io::NetcdfReader;

// The largest distance of two places that count as one, in radians. Longitudes in single precision
// are off by up to 3e-7.
constexpr double max_apart_of_mpas = 1e-5;

using mesh::VoronoiMesh;

// The sizes and dimensions of the variables.
struct MpasSizes {
  std::size_t cells, edges, vertices, max_edges, max_edges_2, two, degree;
  std::size_t of_cell, of_edge;  // lengths of rows
};

constexpr MeshFile::Texts radians = {{"units", "rad"}};

// Returns ten digits of base 36 for `file_id`, the same for the same cells.
std::string id_of(std::uint64_t hash) {
  constexpr std::string_view digits = "0123456789abcdefghijklmnopqrstuvwxyz";
  std::string id;
  for (int i = 0; i < 10; ++i, hash /= 36) id += digits[hash % 36];
  return id;
}

// Returns the number that counts from 1, or 0 for no_index.
std::int32_t one_based(Index index) { return static_cast<std::int32_t>(index + 1); }

// Defines what cells, edges and vertices have in common: latCell, lonCell (radians), xCell, yCell,
// zCell (in the unit of the radius) and indexToCellID. `kind` is "Cell", "Edge" or "Vertex".
void define_places(MeshFile& file, const std::string& kind, std::size_t dimension,
                   const std::vector<Point>& points) {
  const std::size_t size = points.size();
  const auto define = [&](const char* axis, MeshFile::Texts texts, const auto& coordinate) {
    file.numbers((axis + kind).c_str(), dimension, texts, size,
                 [&points, coordinate](std::size_t i) { return coordinate(points[i]); });
  };
  define("lat", radians, latitude_of);
  define("lon", radians, longitude_of);
  define("x", {}, [](const Point& p) { return p.x; });
  define("y", {}, [](const Point& p) { return p.y; });
  define("z", {}, [](const Point& p) { return p.z; });
  file.indices(("indexTo" + kind + "ID").c_str(), dimension, {}, size,
               [](std::size_t i) { return i + 1; });
}

// Defines a variable with the values of an array.
void define_values(MeshFile& file, const char* name, std::size_t dimension, MeshFile::Texts texts,
                   const std::vector<double>& values) {
  file.numbers(name, dimension, texts, values.size(),
               [&values](std::size_t i) { return values[i]; });
}

// Defines edgesOnCell, cellsOnCell or verticesOnCell: rows of `maxEdges` numbers from an array in
// compressed rows.
void define_ring(MeshFile& file, const char* name, const MpasSizes& sizes,
                 const std::vector<Index>& ring) {
  const VoronoiMesh& arrays = file.arrays();
  file.indices(name, {sizes.cells, sizes.max_edges}, {}, arrays.num_cells(), sizes.of_cell,
               [&arrays, &ring](std::size_t i, std::int32_t* out) {
                 for (std::uint64_t at = arrays.edges_on_cell.offsets[i];
                      at < arrays.edges_on_cell.offsets[i + 1]; ++at) {
                   *out++ = one_based(ring[at]);
                 }
               });
}

// Defines a variable with rows of indices that count from 1.
template <class Row>
void define_rows(MeshFile& file, const char* name, std::vector<std::size_t> dimensions,
                 const std::vector<Row>& rows) {
  file.indices(name, std::move(dimensions), {}, rows.size(), std::tuple_size_v<Row>,
               [&rows](std::size_t i, std::int32_t* out) {
                 std::ranges::transform(rows[i], out, one_based);
               });
}

// Defines the variables of cells: nEdgesOnCell, areaCell, meshDensity and others.
void define_cells(MeshFile& file, const MpasSizes& sizes) {
  const VoronoiMesh& arrays = file.arrays();
  const std::size_t size = arrays.num_cells();
  define_places(file, "Cell", sizes.cells, arrays.cell_points);
  file.indices("nEdgesOnCell", sizes.cells, {}, size, [&arrays](std::size_t i) {
    return arrays.edges_on_cell.offsets[i + 1] - arrays.edges_on_cell.offsets[i];
  });
  define_ring(file, "edgesOnCell", sizes, arrays.edges_on_cell.values);
  define_ring(file, "cellsOnCell", sizes, arrays.cells_on_cell);
  define_ring(file, "verticesOnCell", sizes, arrays.vertices_on_cell);
  define_values(file, "areaCell", sizes.cells, {}, arrays.cell_areas);
  file.numbers("meshDensity", sizes.cells, {}, size,
               [&arrays](std::size_t i) { return arrays.density.empty() ? 1 : arrays.density[i]; });
  // MPAS-Tools defines cellQuality as the least distance of neighbors over the largest, and
  // gridSpacing as the mean distance.
  const auto distances = [&arrays](std::size_t i) {
    std::array<double, 3> found = {
        arrays.cell_distances[arrays.edges_on_cell.values[arrays.edges_on_cell.offsets[i]]], 0, 0};
    for (std::uint64_t at = arrays.edges_on_cell.offsets[i];
         at < arrays.edges_on_cell.offsets[i + 1]; ++at) {
      const double distance = arrays.cell_distances[arrays.edges_on_cell.values[at]];
      found = {std::min(found[0], distance), std::max(found[1], distance), found[2] + distance};
    }
    found[2] /=
        static_cast<double>(arrays.edges_on_cell.offsets[i + 1] - arrays.edges_on_cell.offsets[i]);
    return found;
  };
  file.numbers("cellQuality", sizes.cells, {}, size, [distances](std::size_t i) {
    const auto found = distances(i);
    return found[0] / found[1];
  });
  file.numbers("gridSpacing", sizes.cells, {}, size,
               [distances](std::size_t i) { return distances(i)[2]; });
}

// Defines the variables of edges: cellsOnEdge, dcEdge, dvEdge, angleEdge, and weightsOnEdge, from
// which MPAS computes tangential velocities.
void define_edges(MeshFile& file, const MpasSizes& sizes) {
  const VoronoiMesh& arrays = file.arrays();
  const std::size_t size = arrays.num_edges();
  define_places(file, "Edge", sizes.edges, arrays.edge_points);
  define_rows(file, "cellsOnEdge", {sizes.edges, sizes.two}, arrays.cells_on_edge);
  define_rows(file, "verticesOnEdge", {sizes.edges, sizes.two}, arrays.vertices_on_edge);
  define_values(file, "dcEdge", sizes.edges, {}, arrays.cell_distances);
  define_values(file, "dvEdge", sizes.edges, {}, arrays.vertex_distances);
  define_values(file, "angleEdge", sizes.edges, radians, arrays.normal_angles);
  file.indices("nEdgesOnEdge", sizes.edges, {}, size,
               [&arrays](std::size_t e) { return meshing::num_weights(arrays, e); });
  const std::size_t room = sizes.of_edge;
  file.indices("edgesOnEdge", {sizes.edges, sizes.max_edges_2}, {}, size, room,
               [&arrays, room](std::size_t e, std::int32_t* out) {
                 // Several threads fill rows; each keeps one buffer.
                 thread_local std::vector<Index> edges;
                 edges.resize(room);
                 meshing::write_weights(arrays, e, edges, {});
                 std::transform(
                     edges.begin(),
                     edges.begin() + static_cast<std::ptrdiff_t>(meshing::num_weights(arrays, e)),
                     out, one_based);
               });
  file.numbers("weightsOnEdge", {sizes.edges, sizes.max_edges_2}, {}, size, room,
               [&arrays, room](std::size_t e, double* out) {
                 meshing::write_weights(arrays, e, {}, {out, room});
               });
}

using Corners = std::array<Point, 3>;

// Returns the sites of the triangle of a vertex.
Corners corners_of(const VoronoiMesh& arrays, std::size_t v) {
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = arrays.cell_points[arrays.cells_on_vertex[v][i]];
  }
  return corners;
}

// Calls visit(to, from) with the two sides at each corner.
template <class Visit>
void for_each_angle(const Corners& corners, const Visit& visit) {
  for (std::size_t i = 0; i < 3; ++i) {
    visit(corners[(i + 1) % 3] - corners[i], corners[(i + 2) % 3] - corners[i]);
  }
}

// Returns the triangleQuality of MPAS-Tools: (a + b - c)(b + c - a)(c + a - b) / (a b c) for the
// sides a, b, c, which is 1 if they are equal.
double side_quality(const Corners& corners) {
  const double a = norm(corners[1] - corners[2]);
  const double b = norm(corners[2] - corners[0]);
  const double c = norm(corners[0] - corners[1]);
  return (a + b - c) / c * ((b + c - a) / a) * ((c + a - b) / b);
}

// Returns the triangleAngleQuality of MPAS-Tools: the smallest angle over the largest, in the plane
// triangle of the three sites.
double angle_quality(const Corners& corners) {
  double least = std::numbers::pi;
  double most = 0;
  for_each_angle(corners, [&](const Point& to, const Point& from) {
    const double angle = exact::argument(norm(cross(to, from)), dot(to, from));
    least = std::min(least, angle);
    most = std::max(most, angle);
  });
  return least / most;
}

// True if an angle of the plane triangle is above 90 degrees.
bool is_obtuse(const Corners& corners) {
  bool found = false;
  for_each_angle(corners,
                 [&](const Point& to, const Point& from) { found = found || dot(to, from) < 0; });
  return found;
}

// Defines the variables of vertices: cellsOnVertex, areaTriangle, kiteAreasOnVertex and the
// measures of the triangles' quality.
void define_vertices(MeshFile& file, const MpasSizes& sizes) {
  const VoronoiMesh& arrays = file.arrays();
  const std::size_t size = arrays.num_vertices();
  define_places(file, "Vertex", sizes.vertices, arrays.vertex_points);
  define_rows(file, "cellsOnVertex", {sizes.vertices, sizes.degree}, arrays.cells_on_vertex);
  define_rows(file, "edgesOnVertex", {sizes.vertices, sizes.degree}, arrays.edges_on_vertex);
  define_values(file, "areaTriangle", sizes.vertices, {}, arrays.triangle_areas);
  file.numbers(
      "kiteAreasOnVertex", {sizes.vertices, sizes.degree}, {}, size, 3,
      [&arrays](std::size_t v, double* out) { std::ranges::copy(arrays.kite_areas[v], out); });
  // A vertex at the border has no triangle.
  const auto is_whole = [&arrays](std::size_t v) {
    return !meshing::is_at_border(arrays.cells_on_vertex[v]);
  };
  file.indices("boundaryVertex", sizes.vertices, {}, size,
               [is_whole](std::size_t v) { return is_whole(v) ? 0 : 1; });
  file.numbers("triangleQuality", sizes.vertices, {}, size, [&arrays, is_whole](std::size_t v) {
    return is_whole(v) ? side_quality(corners_of(arrays, v)) : 0;
  });
  file.numbers("triangleAngleQuality", sizes.vertices, {}, size,
               [&arrays, is_whole](std::size_t v) {
                 return is_whole(v) ? angle_quality(corners_of(arrays, v)) : 0;
               });
  file.indices("obtuseTriangle", sizes.vertices, {}, size, [&arrays, is_whole](std::size_t v) {
    return is_whole(v) && is_obtuse(corners_of(arrays, v)) ? 1 : 0;
  });
}

}  // namespace

void require_one_place(const io::NetcdfReader& file, const std::string& kind, PlacesMay may) {
  const std::array<const io::VariableInFile*, 5> variables = {
      file.find("lon" + kind), file.find("lat" + kind), file.find("x" + kind),
      file.find("y" + kind), file.find("z" + kind)};
  if (std::ranges::count(variables, nullptr) > 0) return;
  const auto [lon, lat, x, y, z] = variables;
  for (const auto* const variable : variables) {
    if (variable->num_values == x->num_values) continue;
    if (may == PlacesMay::be_missing) return;
    throw io::BadValue("variable " + io::in_quotes(variable->name) + " has " +
                       std::to_string(variable->num_values) + " values instead of " +
                       std::to_string(x->num_values));
  }
  const std::vector<double> lons = degrees_of(file, *lon, UsualUnits::radians, {nullptr, lat});
  const std::vector<double> lats = degrees_of(file, *lat, UsualUnits::radians, {nullptr, lon});
  const std::array<std::vector<double>, 3> xyz = {file.numbers(*x), file.numbers(*y),
                                                  file.numbers(*z)};
  for (std::size_t i = 0; i < lons.size(); ++i) {
    LonLat place{lons[i], lats[i]};
    const bool is_place = is_nearly_place(place);
    if (!is_place && may == PlacesMay::not_be_missing) {
      throw io::BadValue("value " + std::to_string(i) + " of " + io::in_quotes(lon->name) +
                         " and " + io::in_quotes(lat->name) + ", " +
                         system::shortest_text(place.lon_deg) + " and " +
                         system::shortest_text(place.lat_deg) + " degrees, is no place");
    }
    if (!is_place) continue;
    place.lat_deg = std::clamp(place.lat_deg, -90.0, 90.0);
    const Point unit = unit_vectors({&place, 1}).front();
    const double length =
        std::sqrt(xyz[0][i] * xyz[0][i] + xyz[1][i] * xyz[1][i] + xyz[2][i] * xyz[2][i]);
    // The point (0, 0, 0) has no direction, as for elements that are left out.
    if (!(length > 0)) continue;
    const double dx = xyz[0][i] / length - unit.x;
    const double dy = xyz[1][i] / length - unit.y;
    const double dz = xyz[2][i] / length - unit.z;
    if (!(dx * dx + dy * dy + dz * dz > max_apart_of_mpas * max_apart_of_mpas)) continue;
    throw io::BadValue("value " + std::to_string(i) + " of " + io::in_quotes(lon->name) + " and " +
                       io::in_quotes(lat->name) + ", " + system::shortest_text(place.lon_deg) +
                       " and " + system::shortest_text(place.lat_deg) +
                       " degrees, is another place than that of " + io::in_quotes(x->name) + ", " +
                       io::in_quotes(y->name) + " and " + io::in_quotes(z->name));
  }
}

std::optional<MeshContent> read_mpas_cells(const NetcdfReader& file, const std::string& name) {
  const io::VariableInFile* const vertices = file.find("verticesOnCell");
  if (vertices == nullptr || !is_meant(file, name, *vertices)) return std::nullopt;
  require_sphere(file);
  MeshContent mesh;
  mesh.convention = "MPAS";
  // Masked places may be missing; those that are there must be the same in both forms.
  for (const char* kind : {"Cell", "Vertex"}) require_one_place(file, kind, PlacesMay::be_missing);
  const MeshCoordinates nodes = {&file.require("lonVertex"), &file.require("latVertex")};
  const MeshCoordinates centers = {file.find("lonCell"), file.find("latCell")};
  take_nodes(file, nodes, centers, UsualUnits::radians, mesh);
  const std::vector<double> counts = file.numbers(file.require("nEdgesOnCell"));
  require_rank(*vertices, 2);
  if (counts.size() != vertices->shape[0]) {
    throw BadValue("variable " + io::in_quotes("nEdgesOnCell") + " has " +
                   std::to_string(counts.size()) + " values instead of " +
                   std::to_string(vertices->shape[0]));
  }
  take_connectivity(file, {*vertices, vertices->shape[0], vertices->shape[1], false, 1, 1}, counts,
                    mesh);
  take_centers(file, centers, nodes, UsualUnits::radians, mesh);
  return mesh;
}

// The order of the variables is that in which they are written. `Time`, the record dimension, has
// no records.
void define_mpas(MeshFile& file) {
  const VoronoiMesh& arrays = file.arrays();
  MpasSizes sizes{};
  sizes.of_cell = arrays.max_edges();
  sizes.of_edge = 2 * sizes.of_cell;
  sizes.cells = file.dimension("nCells", arrays.num_cells());
  sizes.edges = file.dimension("nEdges", arrays.num_edges());
  sizes.vertices = file.dimension("nVertices", arrays.num_vertices());
  sizes.max_edges = file.dimension("maxEdges", sizes.of_cell);
  sizes.max_edges_2 = file.dimension("maxEdges2", sizes.of_edge);
  sizes.two = file.dimension("TWO", 2);
  sizes.degree = file.dimension("vertexDegree", 3);
  file.dimension("Time", 0);
  io::NetcdfWriter& out = file.netcdf();
  out.add_attribute("on_a_sphere", "YES");
  out.add_attribute({"sphere_radius", io::NetcdfType::float64, "", {arrays.radius}});
  out.add_attribute("is_periodic", "NO");
  out.add_attribute("mesh_spec", "1.0");
  out.add_attribute("Conventions", "MPAS");
  out.add_attribute("source", std::string("Rondel ") + version);
  out.add_attribute("file_id", id_of(point_set_hash(arrays.cell_points)));
  define_cells(file, sizes);
  define_edges(file, sizes);
  define_vertices(file, sizes);
  const double least =
      arrays.num_edges() == 0 ? 0 : *std::ranges::min_element(arrays.cell_distances);
  file.numbers("nominalMinDc", std::vector<std::size_t>{}, {}, 1, 1,
               [least](std::size_t, double* out_value) { *out_value = least; });
}

}  // namespace rondel::formats

namespace rondel::mesh {

MpasContent mpas_content(const VoronoiMesh& arrays, const Execution& execution) {
  // These follow from the others, or say which program wrote the file.
  constexpr std::array<std::string_view, 15> left_out = {
      "indexToCellID",        "indexToEdgeID",   "indexToVertexID", "cellQuality",
      "gridSpacing",          "nEdgesOnEdge",    "edgesOnEdge",     "weightsOnEdge",
      "boundaryVertex",       "triangleQuality", "nominalMinDc",    "obtuseTriangle",
      "triangleAngleQuality", "source",          "file_id"};
  const auto is_taken = [&](std::string_view name) {
    return std::ranges::find(left_out, name) == left_out.end();
  };
  const system::Call call(execution);
  meshing::require_consistent(arrays, execution.threads);
  std::string nothing;
  // The file is only defined: nothing is written to it.
  io::AtomicFile output(FileName::in_memory(nothing, {}));
  formats::MeshFile file(output, arrays, execution);
  formats::define_mpas(file);
  MpasContent result{file.content(is_taken), {}};
  for (const io::NetcdfAttribute& attribute : file.netcdf().attributes()) {
    if (!is_taken(attribute.name)) continue;
    result.attributes.emplace_back(attribute.name, attribute.text);
    if (!attribute.numbers.empty()) result.attributes.back().second = attribute.numbers[0];
  }
  return result;
}

}  // namespace rondel::mesh
