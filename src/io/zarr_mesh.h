// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The Zarr group of a triangulation: a mesh by the conventions of UGRID 1.0, whose nodes are the sites.
// Dimensions have the names that to_xarray() of the Python package gives them.
//
//     mesh          ()                          the topology: what is where
//     sites         (n_node, xyz)               the input; unit vectors where it has longitudes
//     node_lon      (n_node)                    degrees, as given or of the rays through the sites
//     node_lat      (n_node)
//     faces         (n_face, n_max_face_nodes)  all faces, as .npy
//     ghost_faces   (n_ghost_face)              if there are some
//     neighbors     (n_face, n_max_face_nodes)  the last three if they are wanted
//     areas         (n_node)
//     duplicates    (n_duplicate, two)
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/zarr_group.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::io {

// Whether an output of this name is a group.
RONDEL_API bool is_zarr(const std::string& path);

RONDEL_API ZarrHead zarr_faces(const std::string& type, std::uint64_t num_faces);
RONDEL_API ZarrHead zarr_ghost_faces(const std::string& type, std::uint64_t num_ghost_faces);
RONDEL_API ZarrHead zarr_neighbors(const std::string& type, std::uint64_t num_faces);
RONDEL_API ZarrHead zarr_areas(std::uint64_t num_sites);
RONDEL_API ZarrHead zarr_duplicates(const std::string& type, std::uint64_t num_duplicates);

// What sites, node_lon and node_lat take on the disk.
constexpr std::uint64_t zarr_bytes_of_node = 40;

// Writes sites, node_lon and node_lat.
class RONDEL_API ZarrNodes {
 public:
  ZarrNodes(ZarrGroup& group, std::uint64_t num_sites, const Point& center);

  // The next ones; positions, in degrees, are empty where sites were given as points.
  void add(std::span<const Point> sites, std::span<const LonLat> positions, unsigned threads);
  void finish();

 private:
  void add_block(std::span<const Point> sites, std::span<const LonLat> positions, unsigned threads);

  Point center_;
  ZarrArray sites_;
  ZarrArray lon_;
  ZarrArray lat_;
  std::vector<double> lon_buffer_;
  std::vector<double> lat_buffer_;
};

// Writes the topology and gives the group its name.
RONDEL_API void commit_zarr_mesh(ZarrGroup& group, bool has_neighbors);

}  // namespace rondel::io
