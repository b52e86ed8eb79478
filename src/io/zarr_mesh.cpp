// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/zarr_mesh.h"

#include <algorithm>

#include "io/binary.h"
#include "io/ending.h"
#include "map/arc.h"
#include "rondel/version.h"
#include "system/parallel.h"

namespace rondel::io {
namespace {

ZarrHead with_faces(const char* name, const std::string& type, std::uint64_t num_faces,
                    const char* role, const char* what) {
  return {name,
          type,
          {num_faces, 3},
          {"n_face", "n_max_face_nodes"},
          {{"cf_role", zarr_text(role)}, {"long_name", zarr_text(what)}, {"start_index", "0"}}};
}

ZarrHead of_nodes(const char* name, std::uint64_t num_sites, const ZarrAttributes& attributes) {
  return {name, "float64", {num_sites}, {"n_node"}, attributes};
}

// What lies at the nodes of the mesh.
ZarrAttributes at_nodes(const char* what) {
  return {{"long_name", zarr_text(what)},
          {"mesh", zarr_text("mesh")},
          {"location", zarr_text("node")},
          {"coordinates", zarr_text("node_lon node_lat")}};
}

ZarrHead of_angles(const char* name, std::uint64_t num_sites, const char* angle,
                   const char* units) {
  return of_nodes(name, num_sites,
                  {{"standard_name", zarr_text(angle)},
                   {"long_name", zarr_text(std::string(angle) + " of nodes")},
                   {"units", zarr_text(units)}});
}

ZarrHead of_sites(std::uint64_t num_sites) {
  return {"sites", "float64", {num_sites, 3}, {"n_node", "xyz"}, at_nodes("sites")};
}

// The longitude is 0 at poles and for a site at the center.
LonLat position_of(const Point& site, const Point& center) {
  const Point direction = map::direction(site, center);
  if (map::is_pole(direction)) return {0, direction.z > 0 ? 90.0 : direction.z < 0 ? -90.0 : 0.0};
  return map::lonlat_of(direction, map::is_east(direction));
}

}  // namespace

bool is_zarr(const std::string& path) { return ending(path) == ".zarr"; }

ZarrHead zarr_faces(const std::string& type, std::uint64_t num_faces) {
  return with_faces("faces", type, num_faces, "face_node_connectivity",
                    "corners of the faces, counterclockwise");
}

ZarrHead zarr_neighbors(const std::string& type, std::uint64_t num_faces) {
  return with_faces("neighbors", type, num_faces, "face_face_connectivity",
                    "faces opposite to each corner");
}

ZarrHead zarr_ghost_faces(const std::string& type, std::uint64_t num_ghost_faces) {
  return {"ghost_faces",
          type,
          {num_ghost_faces},
          {"n_ghost_face"},
          {{"long_name", zarr_text("faces that are flat or reversed, seen from the center")}}};
}

ZarrHead zarr_areas(std::uint64_t num_sites) {
  ZarrAttributes attributes = at_nodes("areas of the cells");
  attributes.emplace_back("units", zarr_text("sr"));
  return of_nodes("areas", num_sites, attributes);
}

ZarrHead zarr_duplicates(const std::string& type, std::uint64_t num_duplicates) {
  return {"duplicates",
          type,
          {num_duplicates, 2},
          {"n_duplicate", "two"},
          {{"long_name", zarr_text("sites, each with the site that it repeats")}}};
}

ZarrNodes::ZarrNodes(ZarrGroup& group, std::uint64_t num_sites, const Point& center)
    : center_(center),
      sites_(group, of_sites(num_sites)),
      lon_(group, of_angles("node_lon", num_sites, "longitude", "degrees_east")),
      lat_(group, of_angles("node_lat", num_sites, "latitude", "degrees_north")) {}

void ZarrNodes::add(std::span<const Point> sites, std::span<const LonLat> positions,
                    unsigned threads) {
  constexpr std::size_t block = std::size_t{1} << 16U;
  for (std::size_t i = 0; i < sites.size(); i += block) {
    const std::size_t size = std::min(block, sites.size() - i);
    add_block(sites.subspan(i, size), positions.empty() ? positions : positions.subspan(i, size),
              threads);
  }
}

void ZarrNodes::add_block(std::span<const Point> sites, std::span<const LonLat> positions,
                          unsigned threads) {
  constexpr std::size_t grain = 4096;
  lon_buffer_.resize(sites.size());
  lat_buffer_.resize(sites.size());
  system::parallel_for(threads, sites.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const LonLat position = positions.empty() ? position_of(sites[i], center_) : positions[i];
      lon_buffer_[i] = position.lon_deg;
      lat_buffer_[i] = position.lat_deg;
    }
  });
  sites_.write(NumberBytes(sites));
  lon_.write(NumberBytes(lon_buffer_));
  lat_.write(NumberBytes(lat_buffer_));
}

void ZarrNodes::finish() {
  sites_.finish();
  lon_.finish();
  lat_.finish();
}

void commit_zarr_mesh(ZarrGroup& group, bool has_neighbors) {
  ZarrAttributes topology = {{"cf_role", zarr_text("mesh_topology")},
                             {"long_name", zarr_text("topology of the mesh")},
                             {"topology_dimension", "2"},
                             {"node_coordinates", zarr_text("node_lon node_lat")},
                             {"face_node_connectivity", zarr_text("faces")},
                             {"face_dimension", zarr_text("n_face")}};
  if (has_neighbors) topology.emplace_back("face_face_connectivity", zarr_text("neighbors"));
  group.add({"mesh", "int32", {}, {}, topology});
  group.commit({{"Conventions", zarr_text("CF-1.11 UGRID-1.0")},
                {"title", zarr_text("Delaunay triangulation on the sphere")},
                {"history", zarr_text(std::string("made by rondel ") + version)}});
}

}  // namespace rondel::io
