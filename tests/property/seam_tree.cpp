// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "property/seam_tree.h"

#include <algorithm>
#include <cmath>

#include "inputs/points.h"
#include "support/hull_oracle.h"

namespace rondel::test {
namespace {

using inputs::operator+;
using inputs::operator-;
using inputs::operator*;

SeamLine reversed(const SeamLine& line) { return {line.second, line.first}; }

SeamLine line_of(const Triple& face, unsigned corner) {
  return {face[(corner + 1) % 3], face[(corner + 2) % 3]};
}

}  // namespace

SeamTree::SeamTree(const SeamCase& input, Weakened weakened) : input_(input), weakened_(weakened) {
  options_.model = input.model;
  whole_ = delaunay(input.sites, options_);
  is_surrounded_ = whole_.dimension() == 2 && whole_.num_ghost_faces() == 0;
  for (const Triple& face : whole_.faces()) whole_faces_.insert(lowest_first(face));
  points_ = input.sites;
  has_final_.assign(input.sites.size(), 0);
  solve_root(make_cells());
}

Triangulation SeamTree::triangulate(std::span<const PlacedSite> sites) const {
  std::vector<Point> points;
  for (const PlacedSite& s : sites) points.push_back(s.point);
  return delaunay(points, options_);
}

SeamTree::Surface SeamTree::surface_of(std::span<const PlacedSite> sites, bool solid_only) const {
  const Triangulation t = triangulate(sites);
  Surface surface;
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (solid_only && t.is_ghost(f)) continue;
    Triple face = t.faces()[f];
    for (Index& v : face) v = sites[v].name;
    face = lowest_first(face);
    for (unsigned i = 0; i < 3; ++i)
      surface.left[line_of(face, i)] = {static_cast<Index>(surface.faces.size()), i};
    surface.faces.push_back(face);
  }
  for (const auto& [line, side] : surface.left) {
    if (!surface.left.contains(reversed(line))) surface.outline.push_back(line);
  }
  return surface;
}

// One site for each place: named by the lowest index, at the lexicographically smallest copy.
std::vector<PlacedSite> SeamTree::distinct(std::span<const PlacedSite> sites) const {
  const auto key_of = [&](const Point& p) {
    return input_.model == Model::projected
               ? ray_of(p)
               : std::array{static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)};
  };
  std::map<std::array<int, 3>, PlacedSite> places;
  for (const PlacedSite& s : sites) {
    const auto [found, is_new] = places.try_emplace(key_of(s.point), s);
    Point& p = found->second.point;
    if (is_new || weakened_ == Weakened::copies) continue;
    p = std::min(p, s.point, [](const Point& a, const Point& b) {
      return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    });
  }
  std::vector<PlacedSite> result;
  for (const auto& [key, site] : places) result.push_back(site);
  return result;
}

SeamPart SeamTree::gather(const SeamCell& cell) {
  SeamPart part;
  part.sites = distinct(cell.sites);
  part.all = part.sites;
  for (const SeamCell& child : cell.children) {
    SeamPart from = solve(child);
    part.sites.insert(part.sites.end(), from.sites.begin(), from.sites.end());
    part.hidden.insert(part.hidden.end(), from.hidden.begin(), from.hidden.end());
    part.all.insert(part.all.end(), from.all.begin(), from.all.end());
    part.edges.merge(from.edges);
    part.final_faces.merge(from.final_faces);
  }
  return part;
}

SeamPart SeamTree::solve(const SeamCell& cell) {
  SeamPart part = gather(cell);
  if (cell.fails) return part;
  const Surface surface = surface_of(part.sites, true);
  const Marks region = find_region(surface, part.edges);
  const Marks open = find_open(surface, part.edges, cell, part.all);
  check_cell(surface, region, part);
  for (Index f = 0; f < surface.faces.size(); ++f) {
    if (region[f] == 0 || open[f] != 0) continue;
    keep(surface.faces[f], part);
    if (!is_certain(surface.faces[f], cell, ball_around(part.all))) ++num_enclosed_;
    ++num_final_[cell.children.empty() ? 0 : 1];
  }
  hand_up(surface, region, open, part);
  return part;
}

// The faces at the outline and all that can be reached from them, but never across an edge of a
// final face. The surface of the root has no outline: there they start on the other side of such
// edges, or, where nothing is final, anywhere.
SeamTree::Marks SeamTree::find_region(const Surface& surface, const SeamLines& edges) const {
  Marks region(surface.faces.size(), 0);
  std::vector<Index> stack;
  const auto enter = [&](Index f) {
    if (std::exchange(region[f], 1) == 0) stack.push_back(f);
  };
  for (const SeamLine& line : surface.outline) {
    if (weakened_ == Weakened::outline || !edges.contains(line)) enter(surface.left.at(line).first);
  }
  if (surface.outline.empty()) {
    for (const auto& [line, side] : edges) {
      const auto found = surface.left.find(reversed(line));
      if (found != surface.left.end()) enter(found->second.first);
    }
    if (edges.empty() && !surface.faces.empty()) enter(0);
  }
  while (!stack.empty()) {
    const Triple face = surface.faces[stack.back()];
    stack.pop_back();
    for (unsigned i = 0; i < 3; ++i) {
      const auto found = surface.left.find(reversed(line_of(face, i)));
      if (found == surface.left.end()) continue;
      if (weakened_ == Weakened::seam_edges || !edges.contains(found->first))
        enter(found->second.first);
    }
  }
  return region;
}

// The distance within which all sites are taken to be.
double SeamTree::ball_around(std::span<const PlacedSite> all) const {
  double ball = 1;
  if (input_.model == Model::weighted) {
    ball = 0;
    if (weakened_ == Weakened::ball) {
      for (const PlacedSite& s : all) ball = std::max(ball, length_of(s.point));
    } else {
      for (const Point& p : input_.sites) ball = std::max(ball, length_of(p));
    }
  }
  return ball;
}

// From the outline, across faces that are not certified.
SeamTree::Marks SeamTree::find_open(const Surface& surface, const SeamLines& edges,
                                    const SeamCell& cell, std::span<const PlacedSite> all) const {
  const double ball = ball_around(all);
  Marks open(surface.faces.size(), 0);
  std::vector<Index> stack;
  const auto enter = [&](const SeamLine& line) {
    const Index f = surface.left.at(line).first;
    if (edges.contains(line) || open[f] != 0 || is_certain(surface.faces[f], cell, ball)) return;
    open[f] = 1;
    stack.push_back(f);
  };
  for (const SeamLine& line : surface.outline) enter(line);
  while (!stack.empty()) {
    const Triple face = surface.faces[stack.back()];
    stack.pop_back();
    for (unsigned i = 0; i < 3; ++i) {
      const SeamLine across = reversed(line_of(face, i));
      if (surface.left.contains(across)) enter(across);
    }
  }
  return open;
}

// Whether the cap that the plane of a face cuts off the ball lies in the cell's cone, further from
// its planes than the margin. Errors are far below `slack`: sites have coordinates below 100.
// Some faces are refused by chance, as a certificate that rounds may refuse any.
bool SeamTree::is_certain(const Triple& face, const SeamCell& cell, double ball) const {
  constexpr double slack = 1e-7;
  if (inputs::Random(input_.seed ^ (face[0] + 256U * face[1] + 65536U * face[2])).below(8) == 0)
    return false;
  std::array<Point, 3> corners = {points_[face[0]], points_[face[1]], points_[face[2]]};
  if (weakened_ == Weakened::cap) {
    return std::ranges::all_of(corners, [&](const Point& p) {
      return std::ranges::all_of(cell.inward, [&](const Point& n) {
        return dot(n, p) > (std::sin(input_.margin) + slack) * length_of(p);
      });
    });
  }
  if (input_.model == Model::projected) {
    for (Point& p : corners) p = 1 / length_of(p) * p;
  }
  Point normal = inputs::cross_product(corners[1] - corners[0], corners[2] - corners[0]);
  normal = 1 / length_of(normal) * normal;
  const double height = dot(normal, corners[0]) / ball;
  if (height < slack) return false;
  const double margin = weakened_ == Weakened::margin ? 0 : input_.margin;
  const double angle = std::acos(std::min(height, 1.0)) + margin;
  return angle < 1.5 && std::ranges::all_of(cell.inward, [&](const Point& n) {
           return dot(n, normal) > std::sin(angle) + slack;
         });
}

// A face becomes final: it is linked to the final faces beside it.
void SeamTree::keep(const Triple& face, SeamPart& part) {
  const auto name = static_cast<Index>(faces_.size());
  faces_.push_back(face);
  neighbors_.push_back({no_index, no_index, no_index});
  part.final_faces.insert(face);
  for (unsigned i = 0; i < 3; ++i) {
    has_final_[face[i]] = 1;
    const SeamLine line = line_of(face, i);
    if (const auto found = part.edges.find(reversed(line)); found != part.edges.end()) {
      const auto [other, corner] = found->second;
      neighbors_[name][i] = other;
      neighbors_[other][corner] = name;
      part.edges.erase(found);
    } else if (!part.edges.try_emplace(line, name, i).second) {
      wrong_result_ = "two faces on one side of an edge";
    }
  }
}

void SeamTree::hand_up(const Surface& surface, const Marks& region, const Marks& open,
                       SeamPart& part) {
  if (surface.faces.empty()) return;
  std::set<Index> at_open;
  for (Index f = 0; f < surface.faces.size(); ++f) {
    if (region[f] != 0 && open[f] != 0)
      at_open.insert(surface.faces[f].begin(), surface.faces[f].end());
  }
  if (weakened_ != Weakened::outer_face) {
    for (const auto& [a, b] : surface.outline) at_open.insert({a, b});
  }
  std::vector<PlacedSite> up;
  for (const PlacedSite& s : part.sites) {
    if (at_open.contains(s.name)) {
      up.push_back(s);
    } else if (has_final_[s.name] != 0) {
      ++num_dropped_;
    } else if (is_surrounded_ || weakened_ == Weakened::hidden) {
      hidden_.insert(s.name);
      ++num_hidden_below_;
    } else {
      part.hidden.push_back(s);
    }
  }
  part.sites = std::move(up);
}

// The region against the triangulation of all sites of the cell; what is handed up spans the same.
void SeamTree::check_cell(const Surface& surface, const Marks& region, const SeamPart& part) {
  const Surface all = surface_of(part.all, true);
  if (all.outline != surface.outline) wrong_cell_ = "another outline";
  std::set<Triple> expected;
  for (const Triple& face : all.faces) {
    if (!part.final_faces.contains(face)) expected.insert(face);
  }
  if (expected.size() + part.final_faces.size() != all.faces.size())
    wrong_cell_ = "a final face is none in the cell";
  std::set<Triple> found;
  for (Index f = 0; f < surface.faces.size(); ++f) {
    if (region[f] != 0) found.insert(surface.faces[f]);
  }
  if (found != expected) wrong_cell_ = "another region";
  for (const auto& [line, side] : part.edges) {
    if (!surface.left.contains(line) && !surface.left.contains(reversed(line)))
      wrong_cell_ = "an edge is lost";
  }
}

void SeamTree::solve_root(const SeamCell& root) {
  SeamPart part = gather(root);
  const Triangulation spanned = triangulate(part.sites);
  if (is_surrounded_ != (spanned.dimension() == 2 && spanned.num_ghost_faces() == 0))
    wrong_cell_ = "the root does not know where the center is";
  part.sites.insert(part.sites.end(), part.hidden.begin(), part.hidden.end());
  const Triangulation t = triangulate(part.sites);
  const Surface surface = surface_of(part.sites, false);
  const Marks region = find_region(surface, part.edges);
  for (Index f = 0; f < surface.faces.size(); ++f) {
    if (region[f] == 0) continue;
    keep(surface.faces[f], part);
    ++num_final_[2];
  }
  std::set<Index> on_ring;
  for (const Index v : t.ring()) on_ring.insert(part.sites[v].name);
  for (const PlacedSite& s : part.sites) {
    if (has_final_[s.name] == 0 && !on_ring.contains(s.name)) hidden_.insert(s.name);
  }
  if (!part.edges.empty()) wrong_result_ = "an edge without a second face";
  compare(t, part.sites);
}

void SeamTree::compare(const Triangulation& root, std::span<const PlacedSite> root_sites) {
  std::set<Index> expected_hidden;
  for (const Hidden& h : whole_.hidden()) expected_hidden.insert(h.site);
  if (hidden_ != expected_hidden) wrong_result_ = "other hidden sites";
  if (root.dimension() != whole_.dimension()) wrong_result_ = "another dimension";
  std::vector<Index> ring;
  for (const Index v : root.ring()) ring.push_back(root_sites[v].name);
  if (!std::ranges::equal(ring, whole_.ring())) wrong_result_ = "another ring";
  if (std::set(faces_.begin(), faces_.end()) != whole_faces_ ||
      faces_.size() != whole_faces_.size()) {
    wrong_result_ = "other faces";
  }
  if (wrong_result_.empty()) compare_arrays();
}

}  // namespace rondel::test
