// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/bucket_areas.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "api/triangulation_impl.h"
#include "dual/parts.h"
#include "system/parallel.h"

namespace rondel::distributed {
namespace {

// The sites begin ... end - 1 with all faces around them.
class StarPiece {
 public:
  StarPiece(const AreaInput& input, std::span<const Index> face_at, Index begin, Index end)
      : input_(input), face_at_(face_at), begin_(begin), end_(end) {}

  // Returns the areas of the sites of the piece.
  std::vector<double> areas(const system::Job& options) {
    list_faces();
    TriangulationArrays arrays;
    arrays.dimension = 2;
    points_ = input_.landmarks;
    points_.insert(points_.end(), input_.points.begin() + begin_, input_.points.begin() + end_);
    const std::size_t num_whole = points_.size();
    for (const auto& [number, code] : faces_) {
      const Index f = static_cast<Index>(arrays.faces.size());
      Triple face{};
      Triple neighbors{};
      for (unsigned i = 0; i < 3; ++i) {
        face[i] = site_of(input_.surface.corner(code, i));
        neighbors[i] = face_of(input_.surface.across(code, i), f);
      }
      arrays.faces.push_back(face);
      arrays.neighbors.push_back(neighbors);
    }
    arrays.num_sites = points_.size();
    const Triangulation surface =
        api::make_triangulation(Sites(std::move(points_)), std::move(arrays), options, {});
    std::vector<double> areas = dual::areas_within(surface, num_whole);
    areas.erase(areas.begin(), areas.end() - (end_ - begin_));
    return areas;
  }

 private:
  // Lists all faces around the sites, each once, in the order of their numbers.
  void list_faces() {
    for (Index rank = begin_; rank < end_; ++rank) {
      if (face_at_[rank] == no_index) continue;
      input_.surface.turn(rank, face_at_[rank], [&](Index code, unsigned /*i*/) {
        if (is_first(rank, code)) faces_.emplace_back(input_.number(code), code);
      });
    }
    std::ranges::sort(faces_);
    local_of_.reserve(faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f)
      local_of_.emplace(faces_[f].second, static_cast<Index>(f));
  }

  // True if the corner is a site of the piece.
  [[nodiscard]] bool is_in_piece(const BucketCorner& v) const {
    return v.is_own && v.index >= begin_ && v.index < end_;
  }

  // True if no earlier site of the piece has the face.
  [[nodiscard]] bool is_first(Index rank, Index code) const {
    for (unsigned i = 0; i < 3; ++i) {
      const BucketCorner v = input_.surface.corner(code, i);
      if (is_in_piece(v) && v.index < rank) return false;
    }
    return true;
  }

  // Returns the local number of a site, which it gets when it is first seen.
  Index site_of(const BucketCorner& v) {
    if (is_in_piece(v)) return static_cast<Index>(input_.landmarks.size()) + (v.index - begin_);
    const std::uint64_t key = (v.is_own ? 0 : std::uint64_t{1} << 32U) | v.index;
    const auto [place, is_new] = others_.try_emplace(key, static_cast<Index>(points_.size()));
    if (is_new) points_.push_back(v.is_own ? input_.points[v.index] : input_.open_points[v.index]);
    return place->second;
  }

  // Returns the local face, or `self` across the border, where a face is its own neighbor.
  [[nodiscard]] Index face_of(Index code, Index self) const {
    const auto place = local_of_.find(code);
    return place == local_of_.end() ? self : place->second;
  }

  const AreaInput& input_;
  std::span<const Index> face_at_;
  Index begin_;
  Index end_;
  std::vector<std::pair<GlobalIndex, Index>> faces_;  // number and code
  std::unordered_map<Index, Index> local_of_;         // code -> local face
  std::unordered_map<std::uint64_t, Index> others_;   // sites that are not in the piece
  std::vector<Point> points_;
};

}  // namespace

std::vector<double> bucket_areas(const AreaInput& input, const system::Job& options,
                                 std::size_t piece_sites) {
  const std::vector<Index> face_at = input.surface.faces_at_sites(input.points.size());
  std::vector<double> areas(input.points.size());
  system::Job of_piece = options;
  of_piece.threads = 1;
  of_piece.progress = {};
  system::parallel_for(
      options.threads, areas.size(), piece_sites, [&](std::size_t begin, std::size_t end) {
        const auto of_sites =
            StarPiece(input, face_at, static_cast<Index>(begin), static_cast<Index>(end))
                .areas(of_piece);
        std::copy_n(of_sites.begin(), end - begin,
                    areas.begin() + static_cast<std::ptrdiff_t>(begin));
      });
  return areas;
}

}  // namespace rondel::distributed
