// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Every public function that takes no file, with whatever arguments the bytes make: an answer, or one
// of the exceptions that error.h has. Each input is up to a dozen calls on the same few objects, of
// which some are made by earlier calls, some of arrays that belong to nothing.
#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/polygons.h"
#include "rondel/rondel.h"
#include "support/other_surfaces.h"

namespace rondel::fuzz {
namespace {

class Caller {
 public:
  explicit Caller(ByteSource source) : source_(source) {}

  void run() {
    constexpr std::array calls = {
        &Caller::convert,    &Caller::build,     &Caller::build_hull,    &Caller::take_arrays,
        &Caller::flip_edges, &Caller::check_any, &Caller::make_diagrams, &Caller::draw_polygons,
        &Caller::ask,        &Caller::ask_many,  &Caller::change,        &Caller::change_many,
        &Caller::decide};
    scales_ = next_scales(source_);
    for (int i = 0; i < 12 && !source_.is_empty(); ++i) {
      try {
        (this->*calls[source_.below(calls.size())])();
      } catch (const InvalidInput& error) {
        require(*error.what() != '\0', "a refusal says why");
      } catch (const Interrupted&) {  // it was told to stop
      }
    }
  }

 private:
  // Mostly what a caller means, else anything.
  double number() { return source_.below(4) == 0 ? source_.any_double() : source_.small() / 16.0; }
  Point point() {
    if (source_.below(4) == 0) return {number(), number(), number()};
    return next_site(source_, points_, scales_);
  }
  Index index() {
    const Index small = source_.byte() % 16;
    return source_.below(8) == 0 ? no_index - small : small;
  }
  unsigned threads() { return source_.below(8) == 0 ? ~0U - source_.byte() : source_.byte() % 3U; }
  std::size_t many() {
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    const std::size_t few = source_.below(12);
    return source_.below(8) == 0 ? most - few : few;
  }
  template <class T, class Make>
  std::vector<T> list(std::size_t most, const Make& make) {
    std::vector<T> values(source_.below(most));
    for (T& value : values) value = make();
    return values;
  }
  std::vector<Point> points() {
    points_ = list<Point>(14, [this] { return point(); });
    return points_;
  }
  std::vector<Index> indices() {
    return list<Index>(10, [this] { return index(); });
  }
  std::vector<Triple> triples() {
    return list<Triple>(10, [this] { return Triple{index(), index(), index()}; });
  }
  Options options() {
    Options result;
    result.model = source_.below(2) == 0 ? Model::projected : Model::weighted;
    if (source_.below(4) == 0) result.sphere = {{number(), number(), number()}, number()};
    return result;
  }
  Execution execution() {
    Execution result{.threads = threads()};
    if (source_.below(4) == 0) result.stop = source_.below(2) == 0 ? &go_ : &stop_;
    if (source_.below(4) == 0) result.progress = [](std::string_view, double) {};
    return result;
  }

  void convert() {
    const auto positions = list<LonLat>(6, [this] { return LonLat{number(), number()}; });
    const auto radii = list<double>(6, [this] { return number(); });
    if (source_.below(2) == 0) {
      static_cast<void>(unit_vectors(positions));
      static_cast<void>(polar_points(positions, radii));
    }
    static_cast<void>(polar_points(points(), radii));
    static_cast<void>(polar_point(point(), number()));
  }

  void build() {
    const std::vector<Point> sites = points();
    t_ = source_.below(2) == 0 ? delaunay(sites, options(), execution())
                               : delaunay(Sites::view(sites), options(), execution());
    // The sites that are viewed end with this call.
    t_ = Triangulation::from_arrays(sites, parts_of(t_), {t_.model(), t_.sphere()});
    diagram_ = diagram(t_, execution());
    const auto xyz = list<double>(12, [this] { return number(); });
    static_cast<void>(delaunay(std::span<const double>(xyz), options(), execution()));
  }

  void build_hull() {
    t_ = convex_hull(points(), execution());
    static_cast<void>(size_of_hull(t_));
    const auto xyz = list<double>(12, [this] { return number(); });
    static_cast<void>(convex_hull(std::span<const double>(xyz), execution()));
  }

  static TriangulationParts parts_of(const Triangulation& t) {
    return {.dimension = t.dimension(),
            .faces = t.faces(),
            .neighbors = t.neighbors(),
            .ghost_faces = t.ghost_faces(),
            .ring = t.ring(),
            .duplicates = t.duplicates(),
            .hidden = t.hidden()};
  }

  // Of this triangulation with other sites, or with one array of its own.
  void take_arrays() {
    TriangulationParts parts = parts_of(t_);
    const std::vector<Triple> rows = triples();
    const std::vector<Index> numbers = indices();
    const auto duplicates = list<Duplicate>(4, [this] { return Duplicate{index(), index()}; });
    const auto hidden = list<Hidden>(4, [this] { return Hidden{index(), index()}; });
    switch (source_.below(8)) {
      case 0:
        parts.faces = rows;
        break;
      case 1:
        parts.neighbors = rows;
        break;
      case 2:
        parts.ghost_faces = numbers;
        break;
      case 3:
        parts.ring = numbers;
        break;
      case 4:
        parts.duplicates = duplicates;
        break;
      case 5:
        parts.hidden = hidden;
        break;
      case 6:
        parts.dimension = source_.small();
        break;
      default:;
    }
    std::vector<Point> sites(t_.sites().points().begin(), t_.sites().points().end());
    if (source_.below(2) == 0) {
      for (Point& p : sites) p = point();
    }
    t_ = Triangulation::from_arrays(std::move(sites), parts, options());
  }

  // Of this triangulation, with other diagonals: a surface without a flaw, but not the hull.
  void flip_edges() {
    TriangulationParts parts = parts_of(t_);
    std::vector<Triple> faces(parts.faces.begin(), parts.faces.end());
    if (faces.empty()) return;
    for (std::size_t i = source_.below(6); i < 6; ++i) {
      test::flip_edge(faces, source_.below(faces.size()), source_.below(3));
    }
    const std::vector<Triple> neighbors = test::neighbors_of(faces);
    parts.faces = faces;
    parts.neighbors = neighbors;
    t_ = Triangulation::from_arrays(t_.sites(), parts, {t_.model(), t_.sphere()});
  }

  void check_any() { static_cast<void>(check(points(), triples(), options(), execution())); }

  void make_diagrams() {
    static_cast<void>(circumcenters(t_, execution()));
    static_cast<void>(cells(t_, execution()));
    static_cast<void>(areas(t_, execution()));
    static_cast<void>(centroids(t_, execution()));
    static_cast<void>(merge_cocircular(t_, execution()));
    static_cast<void>(edges(t_));
    static_cast<void>(t_.is_ghost(index()));
  }

  void draw_polygons() {
    static_cast<void>(face_polygons(t_, execution()));
    // A diagram that may be of another triangulation, with a number that is another one.
    Diagram diagram = diagram_;
    if (source_.below(2) == 0 && !diagram.cells.rings.values.empty()) {
      diagram.cells.rings.values[source_.below(diagram.cells.rings.values.size())] = index();
    }
    if (source_.below(8) == 0 && !diagram.cells.points.empty()) {
      diagram.cells.points[source_.below(diagram.cells.points.size())] = point();
    }
    // A tiny tolerance makes many lines.
    double tolerance_deg = number();
    if (tolerance_deg > 0 && source_.byte() != 1) tolerance_deg = std::max(tolerance_deg, 0.01);
    static_cast<void>(cell_polygons(t_, diagram, tolerance_deg, execution()));
  }

  template <class Ask>
  void with_locator(const Ask& question) {
    if (source_.below(2) == 0) {
      question(Locator(t_));
    } else {
      question(Locator(changing_));
    }
  }

  void ask() {
    with_locator([this](const Locator& locator) {
      const Point query = point();
      static_cast<void>(locator.locate(query));
      static_cast<void>(locator.nearest(query));
      static_cast<void>(locator.k_nearest(query, many()));
      static_cast<void>(locator.within(query, number()));
      static_cast<void>(locator.conflict_region(query));
      static_cast<void>(locator.neighbors(index()));
      static_cast<void>(locator.distance(query, index()));
    });
  }

  void ask_many() {
    with_locator([this](const Locator& locator) {
      const std::vector<Point> queries = list<Point>(6, [this] { return point(); });
      static_cast<void>(locator.locate(queries, execution()));
      static_cast<void>(locator.nearest(queries, execution()));
      static_cast<void>(locator.within(queries, number(), execution()));
      if (queries.size() > 1) static_cast<void>(locator.k_nearest(queries, many(), execution()));
    });
  }

  void change() {
    switch (source_.below(6)) {
      case 0:
        changing_ = DynamicTriangulation(options());
        break;
      case 1:
        changing_ = DynamicTriangulation(t_, execution());
        break;
      case 2:
        static_cast<void>(changing_.insert(point(), index()));
        break;
      case 3:
        changing_.remove(index());
        break;
      case 4:
        changing_.move(index(), point());
        break;
      default:
        static_cast<void>(changing_.insert(point()));
    }
    look();
  }

  void change_many() {
    switch (source_.below(4)) {
      case 0:
        static_cast<void>(changing_.insert(points(), execution()));
        break;
      case 1:
        changing_.remove(indices(), execution());
        break;
      case 2:
        changing_.move_all(points(), execution());
        break;
      default:
        changing_.move(indices(), points(), execution());
    }
    look();
  }

  void look() {
    require(changing_.num_vertices() <= changing_.num_sites(), "a vertex is a site");
    t_ = changing_.snapshot().triangulation;
    require(t_.num_sites() == changing_.ids().size(), "a copy has all sites");
    const Index id = index();
    if (changing_.contains(id)) {
      static_cast<void>(changing_.neighbors(id));
      static_cast<void>(changing_.representative(id));
      static_cast<void>(changing_.is_vertex(id));
    }
    static_cast<void>(source_.below(2) == 0 ? changing_.face(id) : Triple{});
    static_cast<void>(changing_.site(id));
  }

  void decide() {
    const auto p = points();
    if (p.size() < 4) return;
    const auto [model, sphere] = options();
    switch (source_.below(4)) {
      case 0:
        static_cast<void>(orientation(p[0], p[1], p[2], sphere));
        break;
      case 1:
        static_cast<void>(is_same_site(p[0], p[1], model, sphere));
        break;
      case 2:
        static_cast<void>(side_of_circle(p[0], p[1], p[2], p[3], model, sphere));
        break;
      default:
        static_cast<void>(is_in_conflict(p[0], p[1], p[2], p[3], model, sphere));
    }
  }

  ByteSource source_;
  Scales scales_ = Scales::near;
  std::vector<Point> points_;
  Triangulation t_;
  Diagram diagram_;
  DynamicTriangulation changing_;
  const std::atomic<bool> stop_ = true;
  const std::atomic<bool> go_ = false;
};

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rondel::fuzz::Caller(rondel::fuzz::ByteSource(data, size)).run();
  return 0;
}
