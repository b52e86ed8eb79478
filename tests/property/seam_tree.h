// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A tree of seams by brute force: the algorithm of "A tree of seams" in docs/theory/blocks.md on few
// sites with small integer coordinates, by nothing but delaunay() of sets of sites, too few for
// blocks. It can be told to leave out one condition of the lemmas.
//
// in    sites, and cells that are split at lines which integers decide
// out   the triangulation as the tree makes it, and what its cells found that is not as it should be
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "inputs/random.h"
#include "rondel/delaunay.h"

namespace rondel::test {

// A condition of the lemmas that is left out.
enum class Weakened : std::uint8_t {
  nothing,
  ball,         // the ball of the certificate holds the sites of the cell, not all
  margin,       // the certificate does not know that order and cells may disagree near a border
  cap,          // a face is final when its corners are in the cone
  outer_face,   // a site goes up for an open face, but not because it is on the outline
  outline,      // faces at the outline are in the region, even if a final face is there
  seam_edges,   // a search crosses edges of final faces
  hidden,       // what is hidden in a cell is hidden, wherever the center is
  copies,       // the lowest index gives the coordinates of a place, too
  owned_faces,  // the faces that a site owns are enough to put them in order
};

struct PlacedSite {
  Index name;
  Point point;
};

using SeamLine = std::pair<Index, Index>;                          // from a site to another one
using SeamLines = std::map<SeamLine, std::pair<Index, unsigned>>;  // face on the left, corner

// Equal for the sites of one ray, and for no others.
inline std::array<int, 3> ray_of(const Point& p) {
  const auto x = static_cast<int>(p.x);
  const auto y = static_cast<int>(p.y);
  const auto z = static_cast<int>(p.z);
  const int divisor = std::max(1, std::gcd(std::gcd(x, y), z));
  return {x / divisor, y / divisor, z / divisor};
}

inline double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length_of(const Point& a) { return std::sqrt(dot(a, a)); }

// All of its directions are further from its planes than the margin of the tree.
struct SeamCell {
  std::vector<Point> inward;       // normals of unit length
  std::vector<PlacedSite> sites;   // of a leaf, with their copies
  std::vector<SeamCell> children;  // or none
  bool fails = false;              // hands up what it is given
};

// What a cell hands up; and, to compare, all its sites and all faces that are known to be final.
struct SeamPart {
  std::vector<PlacedSite> sites;
  SeamLines edges;  // a final face on the left, and none known on the right
  std::vector<PlacedSite> hidden;
  std::vector<PlacedSite> all;
  std::set<Triple> final_faces;
};

struct SeamCase {
  std::vector<Point> sites;
  Model model = Model::projected;
  double margin = 0;  // radians
  std::uint64_t seed = 0;
};

class SeamTree {
 public:
  SeamTree(const SeamCase& input, Weakened weakened);

  // What differs from delaunay() of all sites: the result, or what a cell found. Empty: nothing.
  [[nodiscard]] const std::string& wrong_result() const { return wrong_result_; }
  [[nodiscard]] const std::string& wrong_cell() const { return wrong_cell_; }
  // How many faces were found to be final in leaves, in cells above, and at the root.
  [[nodiscard]] const std::array<std::size_t, 3>& num_final() const { return num_final_; }
  // How many of these are final because faces around them are certified, though they are not.
  [[nodiscard]] std::size_t num_enclosed() const { return num_enclosed_; }
  // How many sites were dropped, or found to be hidden, below the root.
  [[nodiscard]] std::size_t num_dropped() const { return num_dropped_; }
  [[nodiscard]] std::size_t num_hidden_below() const { return num_hidden_below_; }

 private:
  // Some faces and their halfedges.
  struct Surface {
    std::vector<Triple> faces;  // by names of sites
    SeamLines left;
    std::vector<SeamLine> outline;  // halfedges with a face on the left and none on the right
  };
  using Marks = std::vector<char>;

  [[nodiscard]] SeamCell make_cells();
  void split(SeamCell& cell, std::array<int, 4> box, unsigned axis, double sign, unsigned depth);
  [[nodiscard]] bool is_beyond(const Point& normal, const Point& p) const;
  [[nodiscard]] Triangulation triangulate(std::span<const PlacedSite> sites) const;
  [[nodiscard]] Surface surface_of(std::span<const PlacedSite> sites, bool solid_only) const;
  [[nodiscard]] std::vector<PlacedSite> distinct(std::span<const PlacedSite> sites) const;

  SeamPart solve(const SeamCell& cell);
  void solve_root(const SeamCell& root);
  SeamPart gather(const SeamCell& cell);
  [[nodiscard]] Marks find_region(const Surface& surface, const SeamLines& edges) const;
  [[nodiscard]] Marks find_open(const Surface& surface, const SeamLines& edges,
                                const SeamCell& cell, std::span<const PlacedSite> all) const;
  [[nodiscard]] double ball_around(std::span<const PlacedSite> all) const;
  [[nodiscard]] bool is_certain(const Triple& face, const SeamCell& cell, double ball) const;
  void keep(const Triple& face, SeamPart& part);
  void hand_up(const Surface& surface, const Marks& region, const Marks& open, SeamPart& part);
  void check_cell(const Surface& surface, const Marks& region, const SeamPart& part);
  void compare(const Triangulation& root, std::span<const PlacedSite> root_sites);
  void compare_arrays();
  [[nodiscard]] std::vector<Index> owned_in_order(Index v, std::span<const Index> faces,
                                                  std::span<const Index> rank) const;

  const SeamCase& input_;
  Weakened weakened_;
  Options options_;
  Triangulation whole_;
  std::set<Triple> whole_faces_;
  bool is_surrounded_ = false;  // the center is strictly inside the hull of all sites
  std::vector<Point> points_;   // by name
  std::vector<Triple> faces_, neighbors_;
  Marks has_final_;  // by name
  std::set<Index> hidden_;
  std::array<std::size_t, 3> num_final_{};
  std::size_t num_enclosed_ = 0;
  std::size_t num_dropped_ = 0;
  std::size_t num_hidden_below_ = 0;
  std::string wrong_result_;
  std::string wrong_cell_;
};

}  // namespace rondel::test
