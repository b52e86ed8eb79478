// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "bulk/closing.h"
#include "bulk/emit.h"
#include "bulk/merge.h"
#include "bulk/reach.h"
#include "bulk/solve_square.h"
#include "bulk/sphere_step.h"
#include "exact/eft.h"
#include "models/with_model.h"
#include "system/huge_pages.h"
#include "system/mutex.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::bulk {
namespace {

using kernel::Triangulated;
using predicates::Vector;

// The lunes: of the positive x axis, the positive y axis, and the negative ones. Each has three
// parts: a face around the cube, and the parts of the top and of the bottom.
constexpr std::size_t num_lunes = 4;
constexpr std::size_t parts_of_lune = 3;
constexpr std::size_t num_parts = num_lunes * parts_of_lune;

// For fewer it takes longer to start threads than to wait for one.
constexpr Index least_parallel_sites = 4096;

// The part of a ray on this face of the cube. A ray with |x| = |y| belongs to a lune of the x axis,
// and the z axis, as an end of it, to the half of its sign.
class Parts {
 public:
  explicit Parts(const Point& center) : center_(center) {
    for (unsigned face = 0; face < faces_.size(); ++face) {
      faces_[face] = order::cube_axes(face).out;
      const Point& out = faces_[face];
      for (std::size_t i = 0; i < num_lunes; ++i) {
        if (out.z != 0) face_of_[parts_of_lune * i + (out.z > 0 ? 1 : 2)] = face;
      }
      if (out.z == 0) face_of_[parts_of_lune * lune(out.x, out.y)] = face;
    }
  }

  [[nodiscard]] bool is_one_part(unsigned face) const { return faces_[face].z == 0; }

  [[nodiscard]] unsigned face_of(std::size_t part) const { return face_of_[part]; }
  // Of a site on the top or the bottom.
  [[nodiscard]] std::size_t part_of(unsigned face, const Point& site) const {
    const double z = faces_[face].z;
    exact::DoubleDouble x = size_of(exact::two_diff(site.x, center_.x));
    exact::DoubleDouble y = size_of(exact::two_diff(site.y, center_.y));
    if (std::isinf(x.hi) && std::isinf(y.hi)) {  // halves of what is so large are exact
      x = size_of(exact::two_diff(site.x / 2, center_.x / 2));
      y = size_of(exact::two_diff(site.y / 2, center_.y / 2));
    }
    const bool is_y_longer = x.hi < y.hi || (x.hi == y.hi && x.lo < y.lo);
    const bool is_on_axis = x.hi == 0 && y.hi == 0;
    const std::size_t of_site = is_on_axis ? lune(z, 0)
                                           : lune(is_y_longer ? 0 : site.x - center_.x,
                                                  is_y_longer ? site.y - center_.y : 0);
    return parts_of_lune * of_site + (z > 0 ? 1 : 2);
  }

 private:
  static std::size_t lune(double x, double y) { return x > 0 ? 0 : (y > 0 ? 1 : (x < 0 ? 2 : 3)); }
  static exact::DoubleDouble size_of(const exact::DoubleDouble& a) {
    return a.hi < 0 ? exact::DoubleDouble{-a.hi, -a.lo} : a;
  }

  Point center_;
  std::array<Point, 6> faces_;
  std::array<unsigned, num_parts> face_of_{};
};

template <models::SphereModel T>
class SphereTriangulation {
 public:
  SphereTriangulation(const Input& input, std::span<const order::Renamed> renamed)
      : input_(input), renamed_(renamed), num_sites_(static_cast<Index>(input.order.size())) {}

  std::optional<Triangulated> run() {
    divide();
    const PlaneGraph::Edge edge = conquer();
    if (edge == no_index) return std::nullopt;
    // A triangulation of the sphere with V vertices has 3V-6 edges.
    std::vector<Index> hidden;
    const auto is_complete = [&] {
      return graph_.num_edges() + 6 == 3 * (num_sites_ - hidden.size());
    };
    if (!is_complete()) {
      hidden = remove_unreached(graph_, edge, num_sites_);
      if (!is_complete()) return std::nullopt;
    }
    Triangulated result;
    result.builder = Builder::sphere;
    result.tally = tally_;
    write(hidden, result.arrays);
    return result;
  }

 private:
  // Orders the sites by parts.
  void divide();

  // Makes room for all that is needed before the result, and graphs of so many vertices.
  std::vector<PlaneGraph> allot(std::span<const Index> sizes);

  // Triangulates the parts and merges them. Returns an edge, or no_index if this does not work.
  PlaneGraph::Edge conquer();
  // These return nothing if this does not work.
  std::optional<Part> solve_lune(std::size_t lune, PlaneGraph& graph);
  std::optional<Part> merge_lunes(const Part& left, const Part& right, PlaneGraph& graph);

  void find_directions(Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      directions_[i] = predicates::direction(input_.sites[order_[i]], input_.options.sphere.center);
    }
  }
  [[nodiscard]] SphereSites<T> sphere_sites() const {
    return {input_.sites, order_, input_.options.sphere.center, directions_};
  }
  void count(const Tally& tally) {
    const std::lock_guard guard(mutex_);
    predicates::add(tally_, tally);
  }

  void write(const std::vector<Index>& hidden, TriangulationArrays& arrays);

  const Input& input_;
  std::span<const order::Renamed> renamed_;
  Index num_sites_;
  std::vector<Index> order_;              // by parts
  std::vector<Index> ranks_;              // of the same, and of no site: no_index
  std::array<Block, num_parts> parts_{};  // ranks in the order by parts
  system::LargeArray<std::byte> memory_;  // of the next three
  SquareCoordinates coordinates_;
  Vector* directions_ = nullptr;  // not with weights
  PlaneGraph graph_;
  system::Mutex mutex_;  // of what follows
  Tally tally_;
  // The rest counts as one lune more.
  system::StageProgress progress_{input_.options.progress, "triangulate", num_lunes + 1};
};

template <models::SphereModel T>
void SphereTriangulation<T>::divide() {
  const Parts parts(input_.options.sphere.center);
  const auto faces = cube_faces(num_sites_, [this](Index rank) { return input_.position(rank); });
  std::array<std::vector<Index>, num_parts> ranks;  // of those that share a face
  for (const Block& face : faces) {
    if (parts.is_one_part(face.square.corner.face)) continue;
    for (Index rank = face.begin; rank < face.end; ++rank) {
      ranks[parts.part_of(face.square.corner.face, input_.sites[input_.order[rank]])].push_back(
          rank);
    }
  }
  order_.resize(num_sites_);
  ranks_.resize(num_sites_ + 1, no_index);
  Index next = 0;
  const auto add = [&, order = order_.data(), all_ranks = ranks_.data(),
                    all = input_.order.data()](Index rank) {
    order[next] = all[rank];
    all_ranks[next++] = rank;
  };
  for (std::size_t part = 0; part < num_parts; ++part) {
    Block& block = parts_[part];
    block.begin = next;
    const Block& face = faces[parts.face_of(part)];
    block.square = face.square;
    if (parts.is_one_part(face.square.corner.face)) {
      for (Index rank = face.begin; rank < face.end; ++rank) add(rank);
    } else {
      for (const Index rank : ranks[part]) add(rank);
    }
    block.end = next;
  }
}

template <models::SphereModel T>
std::optional<Part> SphereTriangulation<T>::solve_lune(std::size_t lune, PlaneGraph& graph) {
  const std::span parts = std::span(parts_).subspan(parts_of_lune * lune, parts_of_lune);
  const Index first = parts.front().begin;
  Input input = input_;
  input.order = order_;
  SquareSites<T> sites;
  sites.assign(input.sites, order_, first, parts.back().end - first, input.options.sphere.center,
               input.extent, coordinates_);
  if (T::model == Model::projected) find_directions(first, parts.back().end);
  SphereSites<T> all = sphere_sites();
  Merge<SphereStep<T>> merge(all, graph);
  std::vector<Misplaced> misplaced;
  Part result;
  for (const Block& block : parts) {
    if (block.begin == block.end) continue;
    sites.enter(block.square, block.end - block.begin);
    const auto part = solve_square(input, block, block.begin, sites, misplaced, graph);
    if (!part) return std::nullopt;
    result = merge.merge(result, *part, {});
  }
  if (merge.has_failed()) return std::nullopt;
  count(sites.tally());
  count(all.tally());
  progress_.step();
  return result;
}

template <models::SphereModel T>
std::optional<Part> SphereTriangulation<T>::merge_lunes(const Part& left, const Part& right,
                                                        PlaneGraph& graph) {
  SphereSites<T> sites = sphere_sites();
  Merge<SphereStep<T>> merge(sites, graph);
  const Part result = merge.merge(left, right, {});
  if (merge.has_failed()) return std::nullopt;
  count(sites.tally());
  return result;
}

// All in one piece: glibc keeps freed memory in proportion to the largest piece, so that the next
// build need not get it from the system again.
template <models::SphereModel T>
std::vector<PlaneGraph> SphereTriangulation<T>::allot(std::span<const Index> sizes) {
  const std::size_t of_coordinates = num_sites_ * SquareCoordinates::bytes_of_site;
  const std::size_t of_directions = T::model == Model::projected ? num_sites_ * sizeof(Vector) : 0;
  memory_ = system::make_large_array<std::byte>(of_coordinates + of_directions +
                                                PlaneGraph::size_of_parts(sizes));
  coordinates_.place(memory_.get(), num_sites_);
  directions_ = reinterpret_cast<Vector*>(memory_.get() + of_coordinates);
  return graph_.clear_parts(sizes, memory_.get() + of_coordinates + of_directions);
}

template <models::SphereModel T>
PlaneGraph::Edge SphereTriangulation<T>::conquer() {
  const unsigned threads = num_sites_ < least_parallel_sites ? 1 : input_.options.threads;
  std::array<Index, num_lunes> sizes{};
  for (std::size_t i = 0; i < num_parts; ++i) {
    sizes[i / parts_of_lune] += parts_[i].end - parts_[i].begin;
  }
  std::vector<PlaneGraph> graphs = allot(sizes);
  std::array<std::optional<Part>, num_lunes> lunes;
  system::parallel_for(threads, num_lunes, 1, [&](std::size_t lune, std::size_t /*end*/) {
    lunes[lune] = solve_lune(lune, graphs[lune]);
  });
  if (!std::ranges::all_of(lunes, [](const auto& lune) { return lune.has_value(); })) {
    return no_index;
  }
  std::array<std::optional<Part>, 2> halves;
  system::parallel_for(threads, halves.size(), 1, [&](std::size_t half, std::size_t /*end*/) {
    const std::size_t left = 2 * half;
    graphs[left].append(graphs[left + 1]);
    halves[half] = merge_lunes(*lunes[left], *lunes[left + 1], graphs[left]);
  });
  if (!halves[0] || !halves[1]) return no_index;
  graph_.take(graphs[0]);
  graph_.append(graphs[2]);
  // No direction in which sites tend to be regular.
  const double half = std::sqrt(0.5);
  SphereSites<T> sites = sphere_sites();
  const PlaneGraph::Edge edge =
      Closing<T>(sites, graph_)
          .run(*halves[0], *halves[1], {half, half, 0}, {0.8 * half, -0.8 * half, 0.6});
  count(sites.tally());
  return edge;
}

template <models::SphereModel T>
void SphereTriangulation<T>::write(const std::vector<Index>& hidden, TriangulationArrays& arrays) {
  graph_.clear_faces();
  Index* const targets = graph_.targets();
  for (PlaneGraph::Edge e = 0; e < graph_.edge_limit(); ++e) {
    targets[e] = ranks_[std::min(targets[e], num_sites_)];
  }
  arrays.faces.resize(2 * std::size_t{num_sites_});
  arrays.neighbors.resize(2 * std::size_t{num_sites_});
  std::vector<Index> names;
  if (!renamed_.empty()) names.assign(input_.order.begin(), input_.order.end());
  order::rename(names, renamed_);
  const std::span<const Index> of_ranks =
      renamed_.empty() ? input_.order : std::span<const Index>(names);
  EmissionSpace space;
  BlockResult all;
  emit_faces(graph_, {0, num_sites_, of_ranks}, {}, {}, space, {arrays.faces, arrays.neighbors},
             all);
  arrays.faces.resize(all.faces_end);
  arrays.neighbors.resize(all.faces_end);
  arrays.dimension = 2;
  for (const Index i : hidden) arrays.hidden.push_back({of_ranks[ranks_[i]], no_index});
  std::ranges::sort(arrays.hidden, {}, &Hidden::site);
}

}  // namespace

bool surround_center(std::span<const Point> sites, const Point& center) {
  constexpr unsigned all = 255;
  unsigned octants = 0;
  for (const Point& p : sites) {
    const auto d = exact::to_vector(p) - exact::to_vector(center);
    if (d.x == 0 || d.y == 0 || d.z == 0) continue;
    octants |= 1U << ((d.x > 0 ? 1U : 0U) + (d.y > 0 ? 2U : 0U) + (d.z > 0 ? 4U : 0U));
    if (octants == all) return true;
  }
  return false;
}

std::optional<Triangulated> triangulate_sphere(const Input& input,
                                               std::span<const order::Renamed> renamed) {
  return models::with_model(input.options.model,
                            [&]<class T> { return SphereTriangulation<T>(input, renamed).run(); });
}

}  // namespace rondel::bulk
