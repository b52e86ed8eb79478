// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes the arrays of a mesh from a triangulation: a vertex for each face, and an edge for each
// pair of halfedges, numbered where the face of the lower number has it. Threads fill disjoint
// parts of each array.

#include "meshing/mesh_arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>

#include "api/triangulation_impl.h"
#include "dual/ring_walk.h"
#include "dual/split_sites.h"
#include "exact/angles.h"
#include "meshing/face_measures.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh.h"
#include "rondel/predicates.h"
#include "system/job.h"
#include "system/large_arrays.h"
#include "system/message_text.h"
#include "system/row_assembly.h"

namespace rondel::mesh {
namespace {

using dual::corner_of;
using dual::mirror_corner;
using dual::next_corner;
using dual::previous_corner;

constexpr std::size_t mesh_grain = 4096;

// For edges shorter than this, predicates decide whether their length is 0, since circumcenters
// have errors of 4u and sums of arcs less.
constexpr double min_certain_arc = 0x1p-48;

// Makes the arrays, each in parallel.
class MeshMaker {
 public:
  MeshMaker(const Triangulation& triangulation, const MeshOptions& options,
            const Execution& execution)
      : triangulation_(triangulation),
        faces_(triangulation.faces()),
        neighbors_(triangulation.neighbors()),
        options_(options),
        execution_(execution),
        sites_(triangulation, execution.threads) {}

  VoronoiMesh make() {
    arrays_.radius = options_.radius;
    arrays_.density.assign(options_.density.begin(), options_.density.end());
    measures_.resize(faces_.size());
    in_pieces(faces_.size(), [&](std::size_t begin, std::size_t end) {
      meshing::measure_faces(sites_, begin, std::span(measures_).subspan(begin, end - begin));
    });
    announce(0.3);
    number_edges();
    set_vertices();
    announce(0.5);
    set_edges();
    announce(0.8);
    measures_ = {};
    set_cells();
    announce(1);
    return std::move(arrays_);
  }

 private:
  // Calls piece(begin, end) for pieces of `mesh_grain` elements, in parallel.
  template <class Piece>
  void in_pieces(std::size_t count, const Piece& piece) const {
    system::parallel_for(execution_.threads, count, mesh_grain, piece);
  }
  // Tells the progress, the share that is done.
  void announce(double fraction) const { system::announce(execution_, "mesh", fraction); }

  // Sets edges_of_[3f + i] for every halfedge.
  void number_edges() {
    edges_of_.resize(3 * faces_.size());
    std::vector<Index> firsts(system::num_pieces(faces_.size(), mesh_grain) + 1, 0);
    in_pieces(faces_.size(), [&](std::size_t begin, std::size_t end) {
      Index count = 0;
      for (std::size_t f = begin; f < end; ++f) {
        for (const Index g : neighbors_[f]) count += static_cast<Index>(f < g);
      }
      firsts[begin / mesh_grain + 1] = count;
    });
    system::sum_counts(firsts);
    in_pieces(faces_.size(), [&](std::size_t begin, std::size_t end) {
      Index next = firsts[begin / mesh_grain];
      for (std::size_t f = begin; f < end; ++f) {
        for (Index i = 0; i < 3; ++i) {
          if (f < neighbors_[f][i]) edges_of_[3 * f + i] = next++;
        }
      }
    });
    in_pieces(faces_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        for (Index i = 0; i < 3; ++i) {
          const Index g = neighbors_[f][i];
          if (g < f) edges_of_[3 * f + i] = edges_of_[across(static_cast<Index>(f), i)];
        }
      }
    });
    num_edges_ = firsts.back();
  }

  // Returns the other halfedge of an edge.
  [[nodiscard]] std::size_t across(Index f, Index i) const {
    const Index g = neighbors_[f][i];
    return 3 * static_cast<std::size_t>(g) + mirror_corner(faces_[f], i, faces_[g]);
  }

  // Sets the circumcenters, kites and areas of triangles, by face.
  void set_vertices() {
    const std::size_t size = faces_.size();
    const double square = options_.radius * options_.radius;
    arrays_.vertex_points.resize(size);
    arrays_.cells_on_vertex.assign(faces_.begin(), faces_.end());
    arrays_.edges_on_vertex.resize(size);
    arrays_.kite_areas.resize(size);
    arrays_.triangle_areas.resize(size);
    in_pieces(size, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const auto& [center, arcs, kites] = measures_[f];
        arrays_.vertex_points[f] = options_.radius * center;
        arrays_.edges_on_vertex[f] = {edges_of_[3 * f + 1], edges_of_[3 * f + 2], edges_of_[3 * f]};
        auto& areas = arrays_.kite_areas[f];
        for (std::size_t i = 0; i < 3; ++i) areas[i] = square * kites[i];
        arrays_.triangle_areas[f] = areas[0] + areas[1] + areas[2];
      }
    });
  }

  // Sets what belongs to edges; the face with the lower number sets each.
  void set_edges() {
    arrays_.edge_points.resize(num_edges_);
    arrays_.cells_on_edge.resize(num_edges_);
    arrays_.vertices_on_edge.resize(num_edges_);
    arrays_.cell_distances.resize(num_edges_);
    arrays_.vertex_distances.resize(num_edges_);
    arrays_.normal_angles.resize(num_edges_);
    // The first edge of length 0 in each piece.
    std::vector<std::size_t> zeros(system::num_pieces(faces_.size(), mesh_grain), no_halfedge);
    in_pieces(faces_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        for (Index i = 0; i < 3; ++i) {
          if (f > neighbors_[f][i]) continue;
          if (set_edge(static_cast<Index>(f), i)) continue;
          std::size_t& zero = zeros[begin / mesh_grain];
          zero = std::min(zero, 3 * f + i);
        }
      }
    });
    const auto zero = std::ranges::find_if(zeros, [](std::size_t at) { return at != no_halfedge; });
    if (zero != zeros.end() && !options_.allow_zero_edges) refuse_zero_edge(*zero);
  }

  // Sets what belongs to an edge; returns false if its length is 0.
  bool set_edge(Index f, Index i) {
    const std::size_t edge = edges_of_[3 * static_cast<std::size_t>(f) + i];
    const std::size_t other = across(f, i);
    const auto g = static_cast<Index>(other / 3);
    Index first = next_corner(i);
    Index second = previous_corner(i);
    const bool is_turned = faces_[f][first] > faces_[f][second];
    if (is_turned) std::swap(first, second);
    arrays_.cells_on_edge[edge] = {faces_[f][first], faces_[f][second]};
    arrays_.vertices_on_edge[edge] = is_turned ? std::array{f, g} : std::array{g, f};
    const Index a = sites_.corners(f)[first];
    const Index b = sites_.corners(f)[second];
    arrays_.cell_distances[edge] = options_.radius * meshing::distance_of(sites_, a, b);
    const double arc = measures_[f].arcs[i] + measures_[g].arcs[other % 3];
    const bool has_length = arc > min_certain_arc || !is_cocircular(f, g, other % 3);
    arrays_.vertex_distances[edge] = has_length ? options_.radius * std::max(arc, 0.0) : 0;
    const meshing::EdgePlace place =
        meshing::edge_place(dual::to_vector(sites_[a].hi), dual::to_vector(sites_[b].hi));
    arrays_.edge_points[edge] = options_.radius * place.middle;
    arrays_.normal_angles[edge] = place.normal_angle;
    return arrays_.vertex_distances[edge] > 0;
  }

  // True if the four sites of two faces lie on one circle, exactly.
  [[nodiscard]] bool is_cocircular(Index f, Index g, std::size_t corner) const {
    const auto [a, b, c] = faces_[f];
    const auto points = sites_.sites();
    return side_of_circle(points[a], points[b], points[c], points[faces_[g][corner]],
                          triangulation_.model(), triangulation_.sphere()) == Sign::zero;
  }

  // Names the sites of an edge without length.
  [[noreturn]] void refuse_zero_edge(std::size_t halfedge) const {
    const auto f = static_cast<Index>(halfedge / 3);
    const std::size_t other = across(f, static_cast<Index>(halfedge % 3));
    std::array<Index, 4> four = {faces_[f][0], faces_[f][1], faces_[f][2],
                                 faces_[other / 3][other % 3]};
    std::ranges::sort(four);
    const std::array<std::string, 4> names = {std::to_string(four[0]), std::to_string(four[1]),
                                              std::to_string(four[2]), std::to_string(four[3])};
    const LonLat first = lonlats({&sites_.sites()[four[0]], 1}).front();
    std::array<char, 80> place{};
    std::snprintf(place.data(), place.size(), "%.10g %.10g", first.lon_deg, first.lat_deg);
    throw InvalidInput("sites " + names[0] + " (at " + place.data() + "), " + names[1] + ", " +
                           names[2] + " and " + names[3] +
                           " lie on one circle, so that an edge has no length",
                       four[0]);
  }

  // Sets sites, areas and rings of the cells; SplitSites has them in spatial order, by rank.
  void set_cells() {
    const std::size_t size = triangulation_.num_sites();
    const auto order = sites_.order();
    arrays_.cell_points.resize(size);
    arrays_.cell_areas.resize(size);
    arrays_.edges_on_cell.offsets.assign(size + 1, 0);
    for (std::size_t k = 0; k < order.size(); ++k) {
      arrays_.edges_on_cell.offsets[order[k] + 1] = sites_.degree(static_cast<Index>(k));
    }
    system::sum_counts(arrays_.edges_on_cell.offsets);
    arrays_.edges_on_cell.values.resize(arrays_.edges_on_cell.offsets.back());
    arrays_.cells_on_cell.resize(arrays_.edges_on_cell.offsets.back());
    arrays_.vertices_on_cell.resize(arrays_.edges_on_cell.offsets.back());
    in_pieces(order.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) set_cell(static_cast<Index>(k));
    });
  }

  // Walks counterclockwise around a site: an entry has a vertex, the edge that ends there, and the
  // cell across this edge.
  void set_cell(Index rank) {
    const Index site = sites_.order()[rank];
    std::uint64_t at = arrays_.edges_on_cell.offsets[site];
    Index f = sites_.first_face(rank);
    double area = 0;
    for (Index left = sites_.degree(rank); left > 0; --left, ++at) {
      const Index i = corner_of(faces_[f], site);
      arrays_.edges_on_cell.values[at] =
          edges_of_[3 * static_cast<std::size_t>(f) + previous_corner(i)];
      arrays_.cells_on_cell[at] = faces_[f][next_corner(i)];
      arrays_.vertices_on_cell[at] = f;
      area += arrays_.kite_areas[f][i];
      f = neighbors_[f][next_corner(i)];
    }
    arrays_.cell_points[site] = options_.radius * sites_[rank].hi;
    arrays_.cell_areas[site] = area;
  }

  static constexpr std::size_t no_halfedge = static_cast<std::size_t>(-1);

  const Triangulation& triangulation_;
  std::span<const Triple> faces_;
  std::span<const Triple> neighbors_;
  const MeshOptions& options_;
  const Execution& execution_;
  dual::SplitSites sites_;
  LargeVector<meshing::FaceMeasures> measures_;
  LargeVector<Index> edges_of_;
  std::size_t num_edges_ = 0;
  VoronoiMesh arrays_;
};

// Throws InvalidInput for a triangulation that has no mesh.
void require_mesh(const Triangulation& triangulation, const MeshOptions& options) {
  if (triangulation.model() == Model::weighted) {
    throw InvalidInput("a mesh is made of sites without weights, as its models suppose");
  }
  if (!triangulation.duplicates().empty()) {
    const auto [site, representative] = triangulation.duplicates().front();
    throw InvalidInput("a mesh has a cell for each site, but site " + std::to_string(site) +
                           " is where site " + std::to_string(representative) + " is",
                       site);
  }
  if (triangulation.dimension() < 2 || triangulation.num_ghost_faces() > 0) {
    throw InvalidInput(
        "a mesh covers the sphere, but the hull of the sites does not surround its center");
  }
  meshing::require_options(options, triangulation.num_sites());
}

}  // namespace

std::size_t VoronoiMesh::max_edges() const {
  std::uint64_t most = 0;
  for (std::size_t i = 0; i < edges_on_cell.size(); ++i) {
    most = std::max<std::uint64_t>(most, edges_on_cell[i].size());
  }
  return static_cast<std::size_t>(most);
}

VoronoiMesh make_mesh(const Triangulation& triangulation, const MeshOptions& options,
                      const Execution& execution) {
  const system::Call call(execution);
  require_mesh(triangulation, options);
  api::require_unchanged_faces(triangulation, execution);
  return MeshMaker(triangulation, options, execution).make();
}

}  // namespace rondel::mesh

namespace rondel::meshing {

void require_options(const mesh::MeshOptions& options, std::size_t num_sites) {
  if (!(options.radius >= mesh::min_radius && options.radius <= mesh::largest_radius)) {
    throw InvalidInput("the radius " + system::shortest_text(options.radius) +
                       " of the sphere is not from 1e-30 to 1e30");
  }
  if (options.density.empty()) return;
  if (options.density.size() != num_sites) {
    throw InvalidInput("there are " + std::to_string(options.density.size()) + " densities for " +
                           std::to_string(num_sites) + " sites",
                       0);
  }
  for (std::size_t i = 0; i < options.density.size(); ++i) {
    if (!(options.density[i] > 0) || options.density[i] > 1e300) {
      throw InvalidInput("density " + std::to_string(i) + " is not positive or not finite", i);
    }
  }
}

}  // namespace rondel::meshing
