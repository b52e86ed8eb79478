// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A thread may round in another direction, or flush subnormal numbers to zero: public functions
// give the same bytes as without, and leave the thread as it was.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include "rondel/io.h"
#include "rondel/rondel.h"
#include "support/generators.h"
#include "support/temporary_files.h"
#include "system/parallel.h"

namespace rondel {
namespace {

constexpr int flush_to_zero = -1;

// Rounds in another direction while it lives, or flushes subnormal numbers, read or computed.
class OtherArithmetic {
 public:
  explicit OtherArithmetic(int mode) {
    std::fegetenv(&before_);
    if (mode == flush_to_zero) {
#if defined(__x86_64__)
      constexpr unsigned subnormals_are_zero = 0x40;
      _mm_setcsr(_mm_getcsr() | _MM_FLUSH_ZERO_ON | subnormals_are_zero);
#endif
    } else {
      std::fesetround(mode);
    }
  }
  ~OtherArithmetic() { std::fesetenv(&before_); }
  OtherArithmetic(const OtherArithmetic&) = delete;
  OtherArithmetic& operator=(const OtherArithmetic&) = delete;

 private:
  std::fenv_t before_{};
};

unsigned long control() {
#if defined(__x86_64__)
  constexpr unsigned status = 0x3f;
  return _mm_getcsr() & ~status;
#else
  return static_cast<unsigned long>(std::fegetround());
#endif
}

template <class Range>
std::string bytes_of(const Range& values) {
  using Value = std::remove_cvref_t<decltype(*std::begin(values))>;
  std::string bytes(std::size(values) * sizeof(Value), '\0');
  if (!bytes.empty()) std::memcpy(bytes.data(), std::data(values), bytes.size());
  return bytes;
}

template <class Value>
std::string bytes_of_one(const Value& value) {
  return bytes_of(std::array{value});
}

std::string bytes_of(const Triangulation& t) {
  return bytes_of(t.faces()) + bytes_of(t.ring()) + bytes_of(t.hidden()) + bytes_of(t.duplicates());
}

std::string bytes_of(const Cells& cells) {
  return bytes_of(cells.rings.offsets) + bytes_of(cells.rings.values) + bytes_of(cells.points);
}

std::string bytes_of(const Location& l) {
  return bytes_of_one(l.face) + bytes_of(l.sites) + std::to_string(static_cast<int>(l.where));
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// What the functions below are asked about: sites that rounding decides, ties, subnormal numbers.
struct Subject {
  std::vector<Point> sites;
  Options options;
  std::vector<Point> queries;
};

Subject subject(std::string_view kind, Model model, double size) {
  test::SiteSet set = test::generator(kind).make(600, 1);
  Subject s;
  s.sites = std::move(set.sites);
  s.options = {.model = model, .sphere = set.sphere};
  s.queries = test::generator("uniform").make(100, 2).sites;
  for (Point& p : s.sites) p = {size * p.x, size * p.y, size * p.z};
  for (Point& p : s.queries) p = {size * p.x, size * p.y, size * p.z};
  s.options.sphere.center = {};
  return s;
}

struct Function {
  std::string name;
  std::function<std::string(const Subject&)> call;
};

Triangulation triangulation_of(const Subject& s) {
  return delaunay(s.sites, s.options, {.threads = 2});
}

std::string changed(const Subject& s) {
  DynamicTriangulation changing(s.sites, s.options);
  changing.insert(std::span(s.queries).first(50));
  changing.insert(s.queries[60]);
  changing.insert(s.queries[61], 0);
  changing.remove(3);
  changing.move(4, s.queries[62]);
  // Two neighbors change places, without any arithmetic here.
  const std::vector<Index> ids = changing.ids();
  std::vector<Point> swapped;
  for (const Index id : ids) swapped.push_back(changing.site(id));
  const std::vector<Index> neighbors = changing.neighbors(ids[10]);
  if (!neighbors.empty()) {
    const auto other = std::ranges::find(ids, neighbors.front()) - ids.begin();
    std::swap(swapped[10], swapped[static_cast<std::size_t>(other)]);
  }
  changing.move_all(swapped);
  const Snapshot now = changing.snapshot();
  return bytes_of(now.triangulation) + bytes_of(now.ids) +
         bytes_of(now.triangulation.sites().points());
}

std::string answers(const Subject& s) {
  const Triangulation t = triangulation_of(s);
  const Locator locator(t);
  std::string all = bytes_of(locator.nearest(s.queries)) +
                    bytes_of(locator.k_nearest(s.queries, 3)) +
                    bytes_of(locator.within(s.queries, 0.2).values);
  for (const Point& q : std::span(s.queries).first(20)) {
    all += bytes_of(locator.locate(q)) + bytes_of_one(locator.nearest(q)) +
           bytes_of(locator.k_nearest(q, 2)) + bytes_of(locator.within(q, 0.3)) +
           bytes_of_one(locator.distance(q, 0)) + bytes_of(locator.conflict_region(q));
  }
  for (const Location& l : locator.locate(s.queries)) all += bytes_of(l);
  return all;
}

std::string predicates_of(const Subject& s) {
  std::string all;
  for (std::size_t i = 0; i + 3 < s.sites.size(); ++i) {
    const auto p = std::span(s.sites).subspan(i, 4);
    const Sphere& sphere = s.options.sphere;
    all += bytes_of_one(orientation(p[0], p[1], p[2], sphere)) +
           bytes_of_one(side_of_circle(p[0], p[1], p[2], p[3], s.options.model, sphere)) +
           bytes_of_one(is_same_site(p[0], p[1], s.options.model, sphere));
  }
  return all;
}

std::string converted(const Subject& s) {
  std::string all;
  for (const double lat : {12.25, -77.7, 0.1}) {
    for (const double lon : {33.3, 170.9, -1e-3}) {
      const LonLat place{lon, lat};
      all += bytes_of_one(unit_vector(place)) + bytes_of_one(polar_point(place, 12.3)) +
             bytes_of(unit_vectors({&place, 1}));
      const double radius = 7.7;
      all += bytes_of(polar_points(std::span<const LonLat>(&place, 1), {&radius, 1}));
    }
  }
  for (const Point& p : s.queries) {
    const double radius = 3.3;
    all += bytes_of_one(polar_point(p, 45.6)) +
           bytes_of(polar_points(std::span<const Point>(&p, 1), {&radius, 1}));
  }
  return all;
}

std::string files(const Subject& s) {
  const TemporaryDirectory folder;
  const std::string csv = folder.file("sites.csv");
  write_file(csv,
             "lon,lat,radius\n12.3,45.6,1.5\n-77.1,0.3,2\n100.1,-30.7,1\n1e-3,80.1,0.1\n5,6,7\n");
  ReadOptions options;
  if (s.options.model == Model::weighted) options.radius = "radius";
  const SiteTable table = read_sites(csv, options);
  const Triangulation t = delaunay(table.sites, s.options);
  write_triangles(folder.file("t.off"), table, t);
  write_triangles(folder.file("t.geojson"), table, t);
  write_cells(folder.file("c.geojson"), table, t, diagram(t));
  write_sites(folder.file("s.csv"), table.sites);
  std::string all;
  for (const char* name : {"t.off", "t.geojson", "c.geojson", "s.csv"})
    all += text_of(folder.file(name));
  return all;
}

const std::vector<Function> functions = {
    {"delaunay", [](const auto& s) { return bytes_of(triangulation_of(s)); }},
    {"convex_hull",
     [](const auto& s) {
       const Triangulation hull = convex_hull(s.sites);
       const HullSize size = size_of_hull(hull);
       return bytes_of(hull) + bytes_of_one(size.volume) + bytes_of_one(size.area);
     }},
    {"check",
     [](const auto& s) { return check(s.sites, triangulation_of(s).faces(), s.options).reason; }},
    {"predicates", predicates_of},
    {"conversions", converted},
    {"circumcenters", [](const auto& s) { return bytes_of(circumcenters(triangulation_of(s))); }},
    {"diagram",
     [](const auto& s) {
       const Diagram d = diagram(triangulation_of(s));
       return bytes_of(d.cells) + bytes_of(d.areas);
     }},
    {"areas",
     [](const auto& s) {
       const Triangulation t = triangulation_of(s);
       const Cells c = cells(t);
       return bytes_of(c) + bytes_of(areas(t)) + bytes_of(centroids(t));
     }},
    {"merge_cocircular",
     [](const auto& s) { return bytes_of(merge_cocircular(triangulation_of(s)).values); }},
    {"Locator", answers},
    {"DynamicTriangulation", changed},
    {"files", files},
};

class Arithmetic : public testing::TestWithParam<int> {};

TEST_P(Arithmetic, of_the_thread_changes_no_result_and_is_not_changed) {
  const std::vector<Subject> subjects = {
      subject("uniform", Model::projected, 1), subject("integer_sphere", Model::projected, 1),
      subject("uniform", Model::projected, 1e-309), subject("cube_outside", Model::weighted, 1)};
  for (const Subject& s : subjects) {
    for (const Function& f : functions) {
      SCOPED_TRACE(f.name);
      const std::string expected = f.call(s);
      const OtherArithmetic other(GetParam());
      const auto before = control();
      const std::string found = f.call(s);
      EXPECT_EQ(control(), before);
      EXPECT_TRUE(found == expected);
    }
  }
}

TEST_P(Arithmetic, of_the_caller_is_not_that_of_the_pieces_of_a_loop) {
  const auto expected = control();
  const OtherArithmetic other(GetParam());
  for (const unsigned threads : {1U, 4U}) {
    std::vector<unsigned long> seen(1000);
    system::parallel_for(threads, seen.size(), 1,
                         [&](std::size_t i, std::size_t) { seen[i] = control(); });
    EXPECT_EQ(seen, std::vector(seen.size(), expected));
  }
}

INSTANTIATE_TEST_SUITE_P(modes, Arithmetic,
                         testing::Values(FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, flush_to_zero),
                         [](const auto& test) {
                           switch (test.param) {
                             case FE_UPWARD:
                               return "upward";
                             case FE_DOWNWARD:
                               return "downward";
                             case FE_TOWARDZERO:
                               return "toward_zero";
                             default:
                               return "flush_to_zero";
                           }
                         });

}  // namespace
}  // namespace rondel
