// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps: put all features into one set, let them meet in corners, simplify them, triangulate their
// arcs, find the faces of the area and not of the land, fill narrow water, refine what is left, and
// tell what the edges of the mesh follow.
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "exact/point_order.h"
#include "exact/vector.h"
#include "map/arc.h"
#include "meshing/coarse_refine.h"
#include "meshing/corner_meetings.h"
#include "meshing/narrow_water.h"
#include "meshing/pinches.h"
#include "meshing/scvt_levels.h"
#include "meshing/small_parts.h"
#include "meshing/small_rings.h"
#include "meshing/sound_positions.h"
#include "meshing/weld.h"
#include "order/spatial_order.h"
#include "rondel/constrained_features.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_triangles.h"
#include "rondel/simplify.h"
#include "system/arithmetic.h"
#include "system/job.h"

namespace rondel::mesh {
namespace {

// Appends polygons from `begin` to before `end`, with their points. One that is the whole sphere has no
// sides, and is appended as one without rings.
void append(const CellRings& more, std::size_t begin, std::size_t end, CellRings& all) {
  std::vector<Index> numbers(more.points.size(), no_index);
  std::vector<Index> ring;
  for (std::size_t i = begin; i < end; ++i) {
    for (std::uint64_t r = more.cells[i]; r < more.cells[i + 1]; ++r) {
      ring.clear();
      for (const Index corner : more.corners_of(r)) {
        if (numbers[corner] == no_index) {
          numbers[corner] = static_cast<Index>(all.points.size());
          all.points.push_back(more.points[corner]);
        }
        ring.push_back(numbers[corner]);
      }
      all.append_ring(ring);
    }
    all.end_cell();
  }
}

// Appends the lines of feature i, as one feature.
void append_lines(const FeatureLines& more, std::size_t i, FeatureLines& all) {
  for (std::uint64_t k = more.offsets[i]; k < more.offsets[i + 1]; ++k) {
    all.rows.append(more.rows[k]);
  }
  all.end_group();
}

void append(const Geometries& more, std::size_t begin, std::size_t end, Geometries& all) {
  for (std::size_t i = begin; i < end; ++i) append_lines(more.lines, i, all.lines);
  append(more.polygons, begin, end, all.polygons);
}

void append(const Geometries& more, Geometries& all) { append(more, 0, more.size(), all); }

// Returns features from `begin` to before `end` with their lines, and polygons without rings.
Geometries lines_alone(const Geometries& all, std::size_t begin, std::size_t end) {
  Geometries result;
  for (std::size_t i = begin; i < end; ++i) {
    append_lines(all.lines, i, result.lines);
    result.polygons.end_cell();
  }
  return result;
}

// Returns features without lines, and with polygons from `begin` to before `end`.
Geometries polygons_alone(const CellRings& all, std::size_t begin, std::size_t end) {
  Geometries result;
  for (std::size_t i = begin; i < end; ++i) result.lines.end_group();
  append(all, begin, end, result.polygons);
  return result;
}

// True if feature i has no line, no point and no polygon.
bool is_empty(const Geometries& geometries, std::size_t i) {
  const auto& [lines, polygons] = geometries;
  return lines.offsets[i] == lines.offsets[i + 1] && polygons.cells[i] == polygons.cells[i + 1];
}

// Numbers nodes along the spatial order, and triangles and edges by their nodes. Drops the sites and
// the sources, which have numbers of the domain.
void sort(DomainTriangles& made, unsigned threads) {
  RefinedMesh& mesh = made.mesh;
  const order::SpatialOrder spatial =
      order::spatial_order(mesh.nodes, Model::projected, {}, threads);
  std::vector<Index> numbers(mesh.nodes.size());
  std::vector<Point> nodes;
  nodes.reserve(mesh.nodes.size());
  for (const Index node : spatial.order) {
    numbers[node] = static_cast<Index>(nodes.size());
    nodes.push_back(mesh.nodes[node]);
  }
  mesh.nodes = std::move(nodes);

  std::vector<std::pair<Triple, Index>> triangles;  // with their regions
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triple corners = mesh.triangles[t];
    for (Index& corner : corners) corner = numbers[corner];
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    triangles.emplace_back(corners, mesh.regions[t]);
  }
  std::ranges::sort(triangles);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::tie(mesh.triangles[t], mesh.regions[t]) = triangles[t];
  }

  std::vector<std::pair<std::array<Index, 2>, FeatureOfEdge>> edges;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [low, high] = std::minmax({numbers[mesh.edges[e][0]], numbers[mesh.edges[e][1]]});
    edges.push_back({{low, high}, made.features[e]});
  }
  std::ranges::sort(edges);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    std::tie(mesh.edges[e], made.features[e]) = edges[e];
  }
  mesh.sites.clear();
  mesh.sources.clear();
}

// Returns how many nodes of an equilateral mesh with these spacings a triangle has, the integral of
// 1 / (sqrt(3)/2 spacing^2): by its halves where it is longer than 200 km on the Earth, so that a
// spacing that changes is looked at in many places.
double number_of_nodes(const std::array<Point, 3>& triangle, const SizeFunction& spacing) {
  constexpr double longest = 1.0 / 32;
  std::size_t apex = 0;  // opposite to the longest edge
  double length = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const exact::Vector3<double> edge =
        exact::to_vector(triangle[(k + 2) % 3]) - exact::to_vector(triangle[(k + 1) % 3]);
    if (norm(edge) > length) std::tie(length, apex) = std::pair(norm(edge), k);
  }
  const Point& a = triangle[apex];
  const Point& b = triangle[(apex + 1) % 3];
  const Point& c = triangle[(apex + 2) % 3];
  const exact::Vector3<double> middle = exact::to_vector(b) + exact::to_vector(c);
  if (length <= longest) {
    const double wanted = spacing.spacing(exact::to_point(middle + exact::to_vector(a)));
    const auto edge = [&](const Point& p) { return exact::to_vector(p) - exact::to_vector(a); };
    // Half of the cross product is the area between chords, which no rounding makes negative.
    return norm(cross(edge(b), edge(c))) / (std::numbers::sqrt3 * wanted * wanted);
  }
  const Point half = exact::to_point(normalized(middle));
  return number_of_nodes({a, b, half}, spacing) + number_of_nodes({a, half, c}, spacing);
}

class TrianglesOfDomain {
 public:
  TrianglesOfDomain(const TrianglesOptions& options, const Execution& execution)
      : options_(options), execution_(execution) {}

  DomainTriangles run(const MeshDomain& domain) {
    take(domain);
    if (options_.weld) weld_within(*options_.weld);
    simplify();
    require_area(options_.tolerance ? "the tolerance with which it is simplified"
                                    : "a quarter of the spacing, with which it is simplified "
                                      "unless there is a tolerance");
    triangulate();
    require_possible_number();
    const double filled_area = options_.fill_narrow > 0 ? fill_narrow() : 0;
    const std::size_t num_small_parts = options_.smallest_part > 0 ? leave_small_parts_out() : 0;
    DomainTriangles made = refined(options_.refine);
    made.filled_area = filled_area;
    made.num_small_parts = num_small_parts;
    if (options_.fill_narrow > 0) {
      made.filled_area += meshing::fill_pinches(made);
      if (options_.smallest_part > 0) made.num_small_parts += leave_small_parts_out(made);
    }
    made.lines_outside = lines_outside(made.mesh, domain);
    sort(made, execution_.threads);
    return made;
  }

 private:
  void take(const MeshDomain& domain) {
    all_ = {};
    for (const Geometries& more : domain.coast) append(more, all_);
    end_of_coast_ = all_.size();
    const auto has_whole = [](const Geometries& more) { return !more.polygons.whole.empty(); };
    is_everywhere_ = domain.area.empty() || std::ranges::any_of(domain.area, has_whole);
    for (const Geometries& more : domain.area) {
      append(is_everywhere_ ? lines_alone(more, 0, more.size()) : more, all_);
    }
    end_of_area_ = all_.size();
    if (std::ranges::any_of(domain.coast, has_whole)) refuse_land();
    first_line_ = all_.size();
    for (const Geometries& more : domain.lines) append(more, all_);
  }

  // Welds what is too near, and what crosses after that.
  void weld_within(double near) {
    constexpr int most_times = 4;
    const auto near_at = [&](const Point&) { return near; };
    meshing::drop_tiny_rings(all_.polygons, near_at);
    meshing::shrink_tiny_lines(all_.lines, near_at);
    take_whole();
    const std::vector<Point> given = meshing::places_of(all_);
    make_crossings_corners();  // so that borders in common have the same sides and stay common
    weld(near_at, given);
    for (int k = 1; k < most_times && make_crossings_corners(); ++k) weld(near_at, given);
    require_area("the distance of welding");
  }

  void simplify() {
    SimplifyOptions simplify{.tolerance = options_.tolerance.value_or(0), .clearance = clearance};
    const auto& spacing = options_.refine.spacing;
    if (!options_.tolerance && spacing) {
      simplify.tolerance_at = [&](const Point& place) { return spacing->spacing(place) / 4; };
    } else if (simplify.tolerance == 0) {
      return;
    }
    simplify_by(simplify);
  }
  // Polygons that overlap or touch are simplified as one, and features that cross after they have corners
  // there: so coasts, borders and lines keep their topology.
  void simplify_by(const SimplifyOptions& simplify) {
    // A coast by itself is welded and united below.
    const bool is_coast_alone = end_of_coast_ == all_.size() && all_.lines.rows.size() == 0;
    if (!is_coast_alone) drop_small_rings(simplify);
    weld_rounding();
    const bool is_meeting = make_crossings_corners();
    if (is_meeting) weld_rounding();
    if (is_meeting || meshing::may_have_common_places(all_.polygons, end_of_area_)) {
      meshing::unite_polygons(0, end_of_coast_, all_, execution_);
      meshing::unite_polygons(end_of_coast_, end_of_area_, all_, execution_);
      take_whole();
    }
    all_.polygons = meshing::without_small_rings(all_.polygons, simplify);
    take_whole();
    if (is_meeting && make_crossings_corners()) weld_rounding();
    SimplifiedFeatures simple = simplified(all_.lines, all_.polygons, simplify, execution_);
    all_ = {std::move(simple.lines), std::move(simple.polygons)};
    take_whole();
  }

  // Drops small rings of the coast, of the area and of lines, each by itself: so that nothing is welded
  // to what vanishes.
  void drop_small_rings(const SimplifyOptions& simplify) {
    CellRings kept;
    for (const auto& [begin, end] : {std::array{std::size_t{0}, end_of_coast_},
                                     {end_of_coast_, end_of_area_},
                                     {end_of_area_, all_.size()}}) {
      Geometries some = polygons_alone(all_.polygons, begin, end);
      if (end <= end_of_area_) {
        weld_rounding(some);
        if (meshing::may_have_common_places(some.polygons, some.size())) {
          meshing::unite_polygons(0, some.size(), some, execution_);
        }
      }
      some.polygons = meshing::without_small_rings(some.polygons, simplify);
      for (const Index cell : some.polygons.whole) {
        kept.whole.push_back(static_cast<Index>(begin) + cell);
      }
      append(some.polygons, 0, some.size(), kept);
    }
    all_.polygons = std::move(kept);
    take_whole();
  }

  // Closes gaps that only rounding leaves between features: of numbers in files, as the spacing sees
  // it.
  void weld_rounding(Geometries& features) const {
    constexpr double share = 1e-4;
    const auto& spacing = options_.refine.spacing;
    meshing::weld(features, [&](const Point& place) {
      const double near = spacing ? share * spacing->spacing(place) : 0;
      return std::max(meshing::rounding_of_places,
                      std::min(near, options_.tolerance.value_or(near)));
    });
  }

  void weld_rounding() {
    weld_rounding(all_);
    take_whole();
  }

  // Gives features corners where they cross. Returns false if they meet in corners alone.
  bool make_crossings_corners() {
    std::optional<Geometries> meeting = meshing::meeting_in_corners(all_, execution_);
    if (!meeting) return false;
    all_ = *std::move(meeting);
    return true;
  }

  void weld(const std::function<double(const Point&)>& near_at, std::span<const Point> given = {}) {
    meshing::weld(all_, near_at, given);
    take_whole();
  }

  // Takes polygons that have become the whole sphere, and have no rings then.
  void take_whole() {
    for (const Index cell : std::exchange(all_.polygons.whole, {})) {
      if (cell < end_of_coast_) refuse_land();
      is_everywhere_ = is_everywhere_ || cell < end_of_area_;
    }
  }

  // Simplifies where coasts are new.
  void simplify_at(std::span<const Point> new_corners) {
    const auto is_new = [&](const Point& place) {
      return std::ranges::binary_search(new_corners, place, exact::is_less);
    };
    SimplifyOptions simplify{.clearance = clearance};
    simplify.tolerance_at = [&](const Point& place) {
      if (!is_new(place)) return 0.0;
      const double quarter = options_.refine.spacing->spacing(place) / 4;
      return std::max(options_.fill_narrow * quarter, options_.tolerance.value_or(quarter));
    };
    simplify_by(simplify);
  }

  // Throws InvalidInput if nothing of the area is left; `what` says what it is nowhere wider than.
  void require_area(const std::string& what) const {
    if (is_everywhere_ || all_.polygons.cells[end_of_coast_] != all_.polygons.cells[end_of_area_]) {
      return;
    }
    throw InvalidInput("nothing is left for triangles: the area is nowhere wider than " + what);
  }

  // Throws InvalidInput if the spacing asks for more nodes than a mesh may have.
  void require_possible_number() const {
    const std::optional<SizeFunction>& spacing = options_.refine.spacing;
    if (!spacing) return;
    double number = 0;
    for (Index f = 0; f < regions_.size(); ++f) {
      if (regions_[f] != no_index) number += number_of_nodes(corners_of(f), *spacing);
    }
    const auto most = static_cast<double>(options_.refine.most_vertices);
    if (!(number > most)) return;
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "the spacing asks for about %.2g nodes, more than the %.0f that a mesh may have",
                  number, most);
    throw InvalidInput(text.data());
  }

  [[noreturn]] static void refuse_land() {
    throw InvalidInput("nothing is left for triangles: the land covers the area");
  }

  // Triangulates all features, and finds the faces of the mesh. Where corners of the features have
  // no faces beyond their hull, but the mesh is there, it has corners of an icosahedron, too.
  void triangulate() {
    const auto rounding = [](const Point&) { return meshing::rounding_of_places; };
    weld(rounding);
    features_ = constraints_of_features(all_.lines, all_.polygons);
    if (!triangulate_sites()) {
      if (make_crossings_corners()) weld(rounding);
      features_ = constraints_of_features(all_.lines, all_.polygons);
      triangulate_sites(ConstraintCrossings::split);
    }
    const Triangulation& first = triangulation_.triangulation;
    bool is_found = false;
    if (first.dimension() == 2 && (first.num_ghost_faces() == 0 || !is_everywhere_)) {
      try {
        regions_ = find_regions();
        is_found = true;
      } catch (const InvalidInput&) {  // an area of more than half of the sphere
      }
    }
    if (!is_found) {
      add_far_corners();
      triangulate_sites(ConstraintCrossings::split);
      regions_ = find_regions();
    }
    if (std::ranges::count(regions_, no_index) == static_cast<std::ptrdiff_t>(regions_.size())) {
      refuse_land();
    }
  }

  // Adds the corners of an icosahedron that are far from all features. The others are not needed: its
  // faces are 0.79 from the center, so that the center stays inside if corners move by 0.5, to places
  // of features.
  void add_far_corners() {
    constexpr double far = 0.5;
    std::vector<Point> corners;
    for (const Point& corner : icosahedron()) {
      const auto is_near = [&](const std::array<Index, 2>& side) {
        const Point& a = features_.sites[side[0]];
        const Point& b = features_.sites[side[1]];
        const double distance = map::distance(corner, a);
        if (distance > far + map::distance(a, b)) return false;
        const auto foot = map::foot_on_arc(corner, a, b);
        return distance <= far || (foot && map::distance(corner, *foot) <= far);
      };
      const auto is_site_near = [&](const Point& site) {
        return map::distance(corner, site) <= far;
      };
      if (std::ranges::any_of(features_.sites, is_site_near)) continue;
      if (std::ranges::none_of(features_.constraints, is_near)) corners.push_back(corner);
    }
    features_.sites.insert(features_.sites.end(), corners.begin(), corners.end());
  }

  // Returns false if arcs cross, unless they are split there, which takes longer.
  bool triangulate_sites(ConstraintCrossings crossings = ConstraintCrossings::refuse) {
    const Sites sites(features_.sites);
    try {
      triangulation_ =
          constrained_delaunay(sites, features_.constraints, {.crossings = crossings}, execution_);
      return true;
    } catch (const CrossingConstraints&) {
      return false;
    }
  }

  // Refines the faces of the mesh, and tells what edges follow.
  [[nodiscard]] DomainTriangles refined(const RefineOptions& options) const {
    return with_features(refine(triangulation_, regions_, options, execution_));
  }
  [[nodiscard]] DomainTriangles with_features(RefinedMesh mesh) const {
    DomainTriangles result;
    result.mesh = std::move(mesh);
    for (const Index source : result.mesh.sources) {
      result.features.push_back(source == no_index ? FeatureOfEdge::none : feature_of(source));
    }
    return result;
  }

  // Refines the faces until angles show what is narrow. Triangles that are much smaller than what
  // is filled need no angles.
  [[nodiscard]] DomainTriangles refined_by_angles() const {
    const auto small = [&](const Point& place) {
      return options_.fill_narrow / 8 * options_.refine.spacing->spacing(place);
    };
    const RefineOptions by_angles{.most_vertices = options_.refine.most_vertices};
    return with_features(
        meshing::refine_coarsely(triangulation_, regions_, by_angles, small, execution_));
  }

  // Takes the lines of the coast and of the area away, and all features that are behind these.
  Geometries taken_lines() {
    Geometries lines = lines_alone(all_, 0, end_of_area_);
    append(all_, end_of_area_, all_.size(), lines);
    all_ = polygons_alone(all_.polygons, 0, end_of_area_);
    return lines;
  }
  // Puts lines back, of which the first ones are those of the coast and of the area.
  void put_back(const Geometries& lines, std::size_t end_of_coast, std::size_t end_of_area) {
    Geometries all;
    append(all_, 0, end_of_coast_, all);
    append(lines, 0, end_of_coast, all);
    const std::size_t end = all.size();
    append(all_, end_of_coast_, end_of_area_, all);
    append(lines, end_of_coast, end_of_area, all);
    const std::size_t end_with_area = all.size();
    append(all_, end_of_area_, all_.size(), all);
    first_line_ = all.size();
    append(lines, end_of_area, lines.size(), all);
    all_ = std::move(all);
    end_of_coast_ = end;
    end_of_area_ = end_with_area;
  }

  // Makes land of narrow water, and returns its area. Lines do not make water narrow, whichever features
  // have them; so they wait, and what of them is then on land is no edge of the mesh.
  double fill_narrow() {
    constexpr int most_times = 10;
    const std::size_t end_of_coast = end_of_coast_;
    const std::size_t end_of_area = end_of_area_;
    const Geometries lines = taken_lines();
    const bool has_lines = lines.size() > end_of_area || lines.lines.rows.size() > 0;
    if (has_lines) triangulate();
    const CellRings before = polygon_of_mesh();
    bool is_filled = false;
    std::vector<Point> new_corners;
    for (int k = 0; k < most_times; ++k) {
      const auto wider = meshing::without_narrow_water(
          refined_by_angles(), *options_.refine.spacing, options_.fill_narrow);
      if (!wider) break;
      is_filled = true;
      take(wider->domain);
      new_corners.insert(new_corners.end(), wider->new_corners.begin(), wider->new_corners.end());
      std::ranges::sort(new_corners, exact::is_less);
      simplify_at(new_corners);
      triangulate();
    }
    const double area =
        is_filled ? meshing::area_without(before, polygon_of_mesh(), execution_) : 0;
    if (has_lines) {
      put_back(lines, end_of_coast, end_of_area);
      triangulate();
    }
    return area;
  }

  [[nodiscard]] std::array<Point, 3> corners_of(Index face) const {
    const std::span<const Point> points = triangulation_.triangulation.sites().points();
    const auto& [a, b, c] = triangulation_.triangulation.faces()[face];
    return {points[a], points[b], points[c]};
  }
  // The faces of the mesh, and their corners.
  struct FacesOfMesh {
    std::vector<Index> faces;
    std::vector<Triple> triangles;
  };
  [[nodiscard]] FacesOfMesh faces_of_mesh() const {
    FacesOfMesh result;
    for (Index f = 0; f < regions_.size(); ++f) {
      if (regions_[f] == no_index) continue;
      result.faces.push_back(f);
      result.triangles.push_back(triangulation_.triangulation.faces()[f]);
    }
    return result;
  }
  [[nodiscard]] CellRings polygon_of_mesh() const {
    return meshing::polygon_of(triangulation_.triangulation.sites().points(),
                               faces_of_mesh().triangles);
  }

  // Leaves parts of the mesh out that are too small, and returns their number.
  std::size_t leave_small_parts_out() {
    const Triangulation& all = triangulation_.triangulation;
    const auto [faces, triangles] = faces_of_mesh();
    const meshing::SmallParts small =
        meshing::small_parts(all.sites().points(), triangles, options_.smallest_part);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (small.has[i]) regions_[faces[i]] = no_index;
    }
    return small.number;
  }
  // Leaves small parts out of the mesh that is made: nodes that were filled, at which it touched itself,
  // may have divided a part.
  [[nodiscard]] std::size_t leave_small_parts_out(DomainTriangles& made) const {
    const meshing::SmallParts small =
        meshing::small_parts(made.mesh.nodes, made.mesh.triangles, options_.smallest_part);
    if (small.number > 0) meshing::remove_triangles(small.has, made);
    return small.number;
  }

  // Returns 0 for the faces of the mesh, and no_index for others.
  [[nodiscard]] std::vector<Index> find_regions() const {
    const auto inside = faces_inside(triangulation_, features_.constraints, features_.polygons);
    const Index everywhere = is_everywhere_ ? 0 : no_index;
    std::vector<Index> regions(triangulation_.triangulation.num_faces(), everywhere);
    for (std::size_t i = end_of_coast_; i < end_of_area_; ++i) {
      for (const Index face : inside[i]) regions[face] = 0;
    }
    for (std::size_t i = 0; i < end_of_coast_; ++i) {
      for (const Index face : inside[i]) regions[face] = no_index;
    }
    for (const Index face : triangulation_.triangulation.ghost_faces()) regions[face] = no_index;
    return regions;
  }

  [[nodiscard]] FeatureOfEdge feature_of(Index edge) const {
    FeatureOfEdge result = FeatureOfEdge::line;
    for (const Index constraint : triangulation_.sources[edge]) {
      const Index feature = features_.features[constraint];
      if (feature < end_of_coast_) return FeatureOfEdge::coast;
      if (feature < end_of_area_) result = FeatureOfEdge::area;
    }
    return result;
  }

  // Returns the lines of the domain of which no arc and no point is in a mesh of the faces.
  [[nodiscard]] std::vector<Index> lines_outside(const RefinedMesh& mesh,
                                                 const MeshDomain& domain) const {
    std::vector<bool> is_in(all_.size());
    for (const Index source : mesh.sources) {
      if (source == no_index) continue;
      for (const Index constraint : triangulation_.sources[source]) {
        is_in[features_.features[constraint]] = true;
      }
    }
    std::vector<Point> nodes;
    for (std::size_t v = 0; v < mesh.nodes.size(); ++v) {
      if (mesh.sites[v] != no_index) nodes.push_back(mesh.nodes[v]);
    }
    std::ranges::sort(nodes, exact::is_less);
    std::vector<Index> outside;
    std::size_t feature = first_line_;
    for (const Geometries& more : domain.lines) {
      for (std::size_t i = 0; i < more.size(); ++i, ++feature) {
        bool is_found = is_in[feature] || is_empty(more, i);
        const CompressedRows<Point>& rows = all_.lines.rows;
        for (std::uint64_t k = all_.lines.offsets[feature]; k < all_.lines.offsets[feature + 1];
             ++k) {
          is_found = is_found || (rows[k].size() == 1 &&
                                  std::ranges::binary_search(nodes, rows[k][0], exact::is_less));
        }
        if (!is_found) outside.push_back(static_cast<Index>(feature - first_line_));
      }
    }
    return outside;
  }

  // The share of the tolerance that simplified coasts keep from each other: a sixteenth of the spacing.
  static constexpr double clearance = 0.25;

  const TrianglesOptions& options_;
  const Execution& execution_;
  Geometries all_;
  std::size_t end_of_coast_ = 0;
  std::size_t end_of_area_ = 0;
  std::size_t first_line_ = 0;  // of the domain, behind points that filling water has made
  bool is_everywhere_ = false;  // the area is the sphere
  FeatureConstraints features_;
  ConstrainedTriangulation triangulation_;
  std::vector<Index> regions_;  // of each face: 0 in the mesh, else no_index
};

// Throws InvalidInput for an area or a coast that has features, but no polygon.
void require_polygons(const MeshDomain& domain) {
  const auto has_polygon = [](const Geometries& more) {
    return !more.polygons.whole.empty() || !more.polygons.corners.empty();
  };
  if (!domain.area.empty() && std::ranges::none_of(domain.area, has_polygon)) {
    throw InvalidInput("the area has no polygon");
  }
  for (const Geometries& coast : domain.coast) {
    if (coast.size() > 0 && !has_polygon(coast)) {
      throw InvalidInput("the coast has no polygon: lines and points are none");
    }
  }
}

void require_shares(const TrianglesOptions& options) {
  const auto is_share = [](double value) { return value >= 0 && value <= 1; };
  if (!is_share(options.fill_narrow)) {
    throw InvalidInput("the share of the spacing below which water is narrow is not from 0 to 1");
  }
  if (!is_share(options.smallest_part)) {
    throw InvalidInput("the share of the largest part below which parts vanish is not from 0 to 1");
  }
  if (options.weld && !(*options.weld >= 0 && *options.weld <= std::numbers::pi / 4)) {
    throw InvalidInput("the distance of welding is not from 0 to pi / 4");
  }
  if (options.fill_narrow > 0 && !options.refine.spacing) {
    throw InvalidInput("narrow water can be filled only where there is a spacing");
  }
}

}  // namespace

std::string_view name_of(FeatureOfEdge feature) noexcept {
  constexpr std::array<std::string_view, 4> names = {"none", "coast", "area", "line"};
  const auto i = static_cast<std::size_t>(feature);
  return i < names.size() ? names[i] : std::string_view();
}

DomainTriangles triangles(const MeshDomain& domain, const TrianglesOptions& options,
                          const Execution& execution) {
  const system::Call call(execution);
  require_polygons(domain);
  require_shares(options);
  DomainTriangles made = TrianglesOfDomain(options, execution).run(domain);
  made.west_deg = domain.west_deg;
  return made;
}

TriangleMesh triangle_mesh(const DomainTriangles& triangles) {
  std::vector<std::array<Index, 2>> coast;
  for (std::size_t e = 0; e < triangles.features.size(); ++e) {
    if (triangles.features[e] == FeatureOfEdge::coast) coast.push_back(triangles.mesh.edges[e]);
  }
  TriangleMesh mesh = triangle_mesh(triangles.mesh.nodes, {}, triangles.mesh.triangles,
                                    std::span(std::as_const(coast)));
  mesh.positions = meshing::sound_positions(mesh, triangles.west_deg);
  return mesh;
}

}  // namespace rondel::mesh
