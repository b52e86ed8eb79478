// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "bulk/emit.h"
#include "bulk/piece.h"
#include "exact/integer.h"
#include "models/with_model.h"
#include "predicates/rung.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::bulk {
namespace {

using kernel::Triangulated;

// The lunes: of the positive x axis, the positive y axis, and the negative ones. Each has three
// parts: a face around the cube, and the parts of the top and of the bottom.
constexpr std::size_t num_lunes = 4;
constexpr std::size_t parts_of_lune = 3;
constexpr std::size_t num_parts = num_lunes * parts_of_lune;

// For fewer it takes longer to start threads than to wait for one.
constexpr Index min_parallel_sites = 4096;

// Returns the lune of a ray along the x axis, or along the y axis if x is 0.
std::size_t lune_of_axis(double x, double y) { return x > 0 ? 0 : (y > 0 ? 1 : (x < 0 ? 2 : 3)); }

// A ray with |x| = |y| belongs to a lune of the x axis, and the z axis, as an end of it, to the half
// of its sign. Rounding keeps the order of differences, but for those that it makes equal.
std::size_t lune_of(const Point& site, const Point& center) {
  const double x = site.x - center.x;
  const double y = site.y - center.y;
  if (x == 0 && y == 0) return lune_of_axis(site.z - center.z, 0);
  bool is_y_longer = std::abs(x) < std::abs(y);
  if (std::abs(x) == std::abs(y)) {
    const auto ray = exact::scaled_rays({site}, center).front();
    is_y_longer = abs(ray.x) < abs(ray.y);
  }
  return lune_of_axis(is_y_longer ? 0 : x, is_y_longer ? y : 0);
}

template <models::SphereModel T>
class SphereTriangulation {
 public:
  explicit SphereTriangulation(const Input& input)
      : by_ranks_(input), num_sites_(static_cast<Index>(input.order.size())) {}

  std::optional<Triangulated> run(std::span<const order::Renamed> renamed) {
    divide();
    if (!conquer() || !pieces_[0].find_hidden()) return std::nullopt;
    Triangulated result;
    result.builder = Builder::sphere;
    for (const Piece<T>& piece : pieces_) predicates::add(result.tally, piece.tally());
    write(renamed, result.arrays);
    return result;
  }

 private:
  // Orders the sites by parts, which makes their local numbers.
  void divide() {
    std::vector<std::uint8_t> part_of_rank(num_sites_);
    for (const Block& face : cube_faces(by_ranks_)) {
      const Point out = order::cube_axes(face.square.corner.face).out;
      const auto part_of = [&](std::size_t lune) {
        return parts_of_lune * lune + (out.z > 0 ? 1 : (out.z < 0 ? 2 : 0));
      };
      if (out.z == 0) {
        const std::size_t part = part_of(lune_of_axis(out.x, out.y));
        parts_[part] = {0, face.end - face.begin, face.square};
        std::fill_n(part_of_rank.begin() + face.begin, face.end - face.begin,
                    static_cast<std::uint8_t>(part));
        continue;
      }
      for (std::size_t i = 0; i < num_lunes; ++i) parts_[part_of(i)].square = face.square;
      for (Index rank = face.begin; rank < face.end; ++rank) {
        const std::size_t part = part_of(lune_of(by_ranks_.point(rank), by_ranks_.center()));
        part_of_rank[rank] = static_cast<std::uint8_t>(part);
        ++parts_[part].end;
      }
    }
    std::array<Index, num_parts> next{};
    Index begin = 0;
    for (std::size_t i = 0; i < num_parts; ++i) {
      next[i] = parts_[i].begin = begin;
      begin = parts_[i].end += begin;
    }
    order_.resize(num_sites_);
    ranks_.resize(num_sites_ + 1, no_index);
    for (Index rank = 0; rank < num_sites_; ++rank) {
      const Index i = next[part_of_rank[rank]]++;
      order_[i] = by_ranks_.order[rank];
      ranks_[i] = rank;
    }
  }

  [[nodiscard]] unsigned num_threads() const {
    return num_sites_ < min_parallel_sites ? 1 : by_ranks_.options.threads;
  }

  // Triangulates the lunes, merges them to halves, and these to a sphere. Returns false if this does
  // not work.
  bool conquer() {
    const unsigned threads = num_threads();
    // The rest counts as one lune more.
    system::StageProgress progress(by_ranks_.options.progress, "triangulate", num_lunes + 1);
    Input input = by_ranks_;
    input.order = order_;
    input.copies = {};
    memory_.reserve(num_sites_, num_lunes);
    std::array<bool, num_lunes> is_solved{};
    system::parallel_for(threads, num_lunes, 1, [&](std::size_t lune, std::size_t /*end*/) {
      const auto parts = std::span(parts_).subspan(parts_of_lune * lune, parts_of_lune);
      const Index first = parts.front().begin;
      pieces_[lune].assign(input, first, parts.back().end - first, memory_, lune);
      is_solved[lune] = pieces_[lune].solve(parts);
      if (is_solved[lune]) progress.step();
    });
    if (!std::ranges::all_of(is_solved, std::identity())) return false;
    system::parallel_for(threads, 2, 1, [&](std::size_t half, std::size_t /*end*/) {
      is_solved[half] = pieces_[2 * half].merge(pieces_[2 * half + 1]);
    });
    if (!is_solved[0] || !is_solved[1]) return false;
    // No direction in which sites tend to be regular.
    const double half = std::sqrt(0.5);
    return pieces_[0].close(pieces_[2], {half, half, 0}, {0.8 * half, -0.8 * half, 0.6});
  }

  void write(std::span<const order::Renamed> renamed, TriangulationArrays& arrays) {
    PlaneGraph& graph = pieces_[0].graph();
    const Index* const ranks = ranks_.data();
    const Index none = num_sites_;
    const std::span targets(graph.targets(), graph.edge_limit());
    constexpr std::size_t grain = 16384;
    system::parallel_for(num_threads(), targets.size(), grain,
                         [&](std::size_t begin, std::size_t end) {
                           for (Index& target : targets.subspan(begin, end - begin))
                             target = ranks[std::min(target, none)];
                         });
    arrays.faces.resize(2 * std::size_t{num_sites_});
    arrays.neighbors.resize(2 * std::size_t{num_sites_});
    std::vector<Index> space;
    const auto names = order::names_of(by_ranks_.order, renamed, space);
    EmissionSpace emission;
    BlockResult all;
    emit_faces(graph, {0, num_sites_, names}, {}, {}, emission, {arrays.faces, arrays.neighbors},
               all, num_threads());
    arrays.faces.resize(all.faces_end);
    arrays.neighbors.resize(all.faces_end);
    arrays.dimension = 2;
    for (const Index i : pieces_[0].hidden()) arrays.hidden.push_back({names[ranks_[i]], no_index});
    std::ranges::sort(arrays.hidden, {}, &Hidden::site);
  }

  const Input& by_ranks_;
  Index num_sites_;
  std::array<Block, num_parts> parts_{};  // their local sites and squares
  std::vector<Index> order_;              // by local site
  std::vector<Index> ranks_;              // by local site; of none, no_index
  PieceMemory memory_;
  std::array<Piece<T>, num_lunes> pieces_;  // lunes, then halves, then the sphere come first
};

}  // namespace

unsigned octants_of(std::span<const Point> sites, const Point& center) {
  unsigned octants = 0;
  const auto look_at_every = [&](std::size_t stride) {
    for (std::size_t i = 0; i < sites.size() && octants != all_octants; i += stride) {
      const auto d = exact::to_vector(sites[i]) - exact::to_vector(center);
      if (d.x == 0 || d.y == 0 || d.z == 0) continue;
      octants |= 1U << ((d.x > 0 ? 1U : 0U) + (d.y > 0 ? 2U : 0U) + (d.z > 0 ? 4U : 0U));
    }
  };
  // Sites that come in the order of the curve get to the last octant late.
  look_at_every(sites.size() / 64 + 1);
  look_at_every(1);
  return octants;
}

bool surround_center(std::span<const Point> sites, const Point& center) {
  return octants_of(sites, center) == all_octants;
}

std::optional<Triangulated> triangulate_sphere(const Input& input,
                                               std::span<const order::Renamed> renamed) {
  return models::with_model(input.options.model,
                            [&]<class T> { return SphereTriangulation<T>(input).run(renamed); });
}

}  // namespace rondel::bulk
