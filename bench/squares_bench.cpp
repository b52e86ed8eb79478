// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// squares_bench N [--depth D] [--threads T] [--check]: builds triangulations of more sites than fit
// any memory or disk, with the library's internal headers. The sites of 6 * 4^D squares are made
// when they are needed, and triangulated one square at a time as out of core, twice: first for what
// the square leaves open, which is joined and numbered, then for its faces, which are hashed and
// not kept. Each thread has one square.
//
//   sites    uniform on the sphere, in each square as many as its solid angle demands; their indices are
//            spread over all of 0 ... N-1
//   hash     of all corners and neighbors in canonical order, as 64-bit numbers
//   checks   there are 2V - 4 faces; each directed edge has its reverse, and each neighbor its neighbor, by
//            sums that cancel; with --check the hash is that of the build in memory

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bulk/bucket.h"
#include "distributed/bucket_faces.h"
#include "inputs/random.h"
#include "measure.h"
#include "order/cube_position.h"
#include "rondel/rondel.h"
#include "system/parallel.h"

#if defined(__GLIBC__)  // the headers above define it
#include <malloc.h>
#endif

namespace rondel::bench {
namespace {

using Triple64 = std::array<std::uint64_t, 3>;

struct Task {
  std::uint64_t num_sites = 0;
  int depth = 2;
  unsigned threads = 0;
  bool is_checked = false;
};

Task parse(int argc, char** argv) {
  Task task;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--check") {
      task.is_checked = true;
    } else if (word == "--depth" && i + 1 < argc) {
      task.depth = std::atoi(argv[++i]);
    } else if (word == "--threads" && i + 1 < argc) {
      task.threads = static_cast<unsigned>(std::atoi(argv[++i]));
    } else {
      task.num_sites = std::strtoull(word.c_str(), nullptr, 10);
    }
  }
  return task;
}

// Maps site i of n one to one to an index: i times a number without a common divisor with n.
class SpreadIndices {
 public:
  explicit SpreadIndices(std::uint64_t n)
      : n_(n), factor_(static_cast<std::uint64_t>(static_cast<double>(n) * 0.618) | 1U) {
    while (std::gcd(factor_, n_) != 1) factor_ += 2;
  }
  std::uint64_t operator()(std::uint64_t i) const {
    return static_cast<std::uint64_t>(static_cast<unsigned __int128>(i) * factor_ % n_);
  }

 private:
  std::uint64_t n_;
  std::uint64_t factor_;
};

// A square and its sites, which are the same whenever they are made.
class SquareSource {
 public:
  explicit SquareSource(const bulk::Square& square)
      : square_(square),
        axes_(order::cube_axes(square.corner.face)),
        u_(ratio(square.corner.u)),
        v_(ratio(square.corner.v)),
        width_(std::ldexp(1.0, square.bits - (order::position_bits - 1))) {
    // The density of directions is greatest where the square is closest to the middle of the face.
    const double u = closest_to_zero(u_);
    const double v = closest_to_zero(v_);
    max_density_ = density(u, v);
  }

  [[nodiscard]] const bulk::Square& square() const { return square_; }

  [[nodiscard]] double solid_angle() const {
    const auto corner = [](double u, double v) {
      return std::atan2(u * v, std::sqrt(1 + u * u + v * v));
    };
    return corner(u_ + width_, v_ + width_) - corner(u_, v_ + width_) - corner(u_ + width_, v_) +
           corner(u_, v_);
  }

  void make(std::uint64_t seed, std::span<Point> sites) const {
    inputs::Random random(inputs::Random(seed).next());
    for (Point& site : sites) site = make_site(random);
  }

 private:
  static double ratio(std::uint64_t position) {
    return static_cast<double>(position) * 0x1p-51 - 1;
  }
  [[nodiscard]] double closest_to_zero(double low) const {
    return low > 0 ? low : std::min(low + width_, 0.0);
  }
  static double density(double u, double v) {
    const double square = 1 + u * u + v * v;
    return 1 / (square * std::sqrt(square));
  }

  Point make_site(inputs::Random& random) const {
    for (;;) {
      const double u = u_ + random.unit() * width_;
      const double v = v_ + random.unit() * width_;
      if (random.unit() * max_density_ > density(u, v)) continue;
      return {axes_.out.x + u * axes_.u.x + v * axes_.v.x,
              axes_.out.y + u * axes_.u.y + v * axes_.v.y,
              axes_.out.z + u * axes_.u.z + v * axes_.v.z};
    }
  }

  bulk::Square square_;
  order::CubeAxes axes_;
  double u_;
  double v_;
  double width_;
  double max_density_;
};

void add_sources(const bulk::Square& square, int depth, std::vector<SquareSource>& sources) {
  if (depth == 0) {
    sources.emplace_back(square);
    return;
  }
  for (unsigned rank = 0; rank < 4; ++rank)
    add_sources(bulk::quadrant(square, rank), depth - 1, sources);
}

// Returns a hash that differs from that of (b, a).
std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t z = (a * 0xbf58'476d'1ce4'e5b9U) ^ (b * 0x94d0'49bb'1331'11ebU);
  return (z ^ (z >> 31)) * 0x9e37'79b9'7f4a'7c15U;
}

// Sums over faces that are not kept.
struct FaceSums {
  std::uint64_t hash = 0;       // depends on their order
  std::uint64_t edges = 0;      // 0 over all faces if each directed edge has its reverse
  std::uint64_t neighbors = 0;  // 0 over all faces if each neighbor has its neighbor
  std::uint64_t num_faces = 0;

  void add_corners(const Triple64& v) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = v[i];
      const std::uint64_t to = v[i == 2 ? 0 : i + 1];
      take(from);
      edges += mixed(from, to) - mixed(to, from);
    }
    ++num_faces;
  }
  void add_neighbors(std::uint64_t face, const Triple64& n) {
    for (const std::uint64_t other : n) {
      take(other);
      neighbors += mixed(face, other) - mixed(other, face);
    }
  }
  void add(const FaceSums& next) {
    take(next.hash);
    edges += next.edges;
    neighbors += next.neighbors;
    num_faces += next.num_faces;
  }

 private:
  void take(std::uint64_t value) { hash = (hash ^ value) * 0x100'0000'01b3U; }
};

class Squares {
 public:
  explicit Squares(const Task& task)
      : task_(task), spread_(task.num_sites), job_{{}, {.threads = 1}} {
    for (unsigned face = 0; face < 6; ++face)
      add_sources({{face, 0, 0}, order::position_bits, 0}, task.depth, sources_);
    double angle = 0;
    for (const SquareSource& source : sources_) {
      begin_.push_back(static_cast<std::uint64_t>(static_cast<double>(task.num_sites) * angle /
                                                  (4 * std::numbers::pi)));
      angle += source.solid_angle();
    }
    begin_.push_back(task.num_sites);
    all_ = bulk::AllSites(job_);
    const std::vector<Point> octants = {{1, 1, 1},  {1, 1, -1},  {1, -1, 1},  {1, -1, -1},
                                        {-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {-1, -1, -1}};
    all_.add(octants);  // as there are sites in each octant
  }

  [[nodiscard]] LargeVector<Point> sites_of(std::size_t i) const {
    LargeVector<Point> sites(begin_[i + 1] - begin_[i]);
    sources_[i].make(begin_[i], sites);
    return sites;
  }
  [[nodiscard]] std::size_t size() const { return sources_.size(); }
  [[nodiscard]] std::uint64_t index(std::uint64_t i) const { return spread_(i); }

  // Joins what all squares leave open.
  bool join() {
    struct Left {
      bulk::OpenBucket open;
      bulk::BucketBorder border;
      std::vector<std::uint64_t> indices;
    };
    std::vector<Left> all(size());
    for_each_square([&](std::size_t i) {
      const LargeVector<Point> sites = sites_of(i);
      bulk::Bucket bucket = triangulate(i, sites);
      Left& left = all[i];
      left.open.square = sources_[i].square();
      left.open.num_sites = static_cast<double>(bucket.order.order.size());
      for (const bulk::SeamSite& site : bucket.border.open_sites) {
        left.open.points.push_back(sites[bucket.order.order[site.rank]]);
        left.indices.push_back(index_of(i, bucket, site.rank));
      }
      left.open.open_edges = bucket.border.open_edges;
      left.border = std::move(bucket.border);
    });
    std::vector<bulk::OpenBucket> open;
    for (Left& left : all) {
      num_vertices_ += static_cast<std::uint64_t>(left.open.num_sites);
      open.push_back(std::move(left.open));
      borders_.push_back(std::move(left.border));
      open_indices_.insert(open_indices_.end(), left.indices.begin(), left.indices.end());
    }
    auto joined = bulk::join_buckets(open, all_, {{}, {.threads = task_.threads}});
    if (!joined) return false;
    joined_ = *std::move(joined);
    return true;
  }

  // Returns the sums of all squares, in their order.
  std::vector<FaceSums> hash_faces() {
    distributed::JoinedNumbers numbers(joined_);
    std::vector<distributed::BucketFaces> faces;
    faces.reserve(size());
    Index first_site = 0;
    Index first_edge = 0;
    distributed::GlobalIndex next = 0;
    for (const bulk::BucketBorder& border : borders_) {
      faces.emplace_back(border, joined_, first_site, first_edge).number(next, numbers);
      first_site += static_cast<Index>(border.open_sites.size());
      first_edge += static_cast<Index>(border.open_edges.size());
      next += faces.back().size();
    }
    std::vector<FaceSums> sums(size());
    for_each_square([&](std::size_t i) {
      const LargeVector<Point> sites = sites_of(i);
      sums[i] = hash_faces(i, triangulate(i, sites), faces[i], numbers);
    });
    return sums;
  }

  [[nodiscard]] std::uint64_t num_vertices() const { return num_vertices_; }
  [[nodiscard]] std::size_t num_open_sites() const { return open_indices_.size(); }

 private:
  template <class Visit>
  void for_each_square(Visit visit) const {
    std::atomic<std::size_t> num_done = 0;
    system::parallel_for(task_.threads, size(), 1, [&](std::size_t i, std::size_t /*end*/) {
      visit(i);
      std::fprintf(stderr, "\r%zu of %zu squares ", ++num_done, size());
    });
    std::fputs("\n", stderr);
  }

  [[nodiscard]] bulk::Bucket triangulate(std::size_t i, std::span<const Point> sites) const {
    return bulk::triangulate_bucket(sites, sources_[i].square(), all_, job_);
  }

  [[nodiscard]] std::uint64_t index_of(std::size_t i, const bulk::Bucket& bucket,
                                       Index rank) const {
    return index(begin_[i] + bucket.order.order[rank]);
  }

  [[nodiscard]] FaceSums hash_faces(std::size_t i, const bulk::Bucket& bucket,
                                    const distributed::BucketFaces& faces,
                                    const distributed::JoinedNumbers& numbers) const {
    LargeVector<std::uint64_t> indices(bucket.order.order.size());
    for (Index rank = 0; rank < indices.size(); ++rank) indices[rank] = index_of(i, bucket, rank);
    FaceSums sums;
    faces.for_each_face(bucket.faces, [&](const auto& corners) {
      Triple64 v{};
      for (std::size_t c = 0; c < 3; ++c)
        v[c] = corners[c].is_own ? indices[corners[c].index] : open_indices_[corners[c].index];
      sums.add_corners(v);
    });
    std::uint64_t face = faces.first();
    faces.for_each_neighbors(bucket.neighbors, [&](const auto& across) {
      sums.add_neighbors(face++, {numbers[across[0]], numbers[across[1]], numbers[across[2]]});
    });
    return sums;
  }

  Task task_;
  SpreadIndices spread_;
  system::Job job_;
  std::vector<SquareSource> sources_;
  std::vector<std::uint64_t> begin_;  // by square: its first site
  bulk::AllSites all_;
  std::vector<bulk::BucketBorder> borders_;
  std::vector<std::uint64_t> open_indices_;
  bulk::JoinedFaces joined_;
  std::uint64_t num_vertices_ = 0;
};

FaceSums sum_up(std::span<const FaceSums> sums) {
  FaceSums all;
  for (const FaceSums& of_square : sums) all.add(of_square);
  return all;
}

// Returns the same sums for the build in memory.
FaceSums sums_in_memory(const Squares& squares, const Task& task,
                        std::span<const FaceSums> expected) {
  std::vector<Point> sites(task.num_sites);
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    for (const Point& p : squares.sites_of(i)) sites[squares.index(next++)] = p;
  }
  const Triangulation t = delaunay(Sites::view(sites), {}, {.threads = task.threads});
  const auto wide = [](const Triple& v) { return Triple64{v[0], v[1], v[2]}; };
  std::vector<FaceSums> sums(squares.size());
  std::size_t begin = 0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const std::size_t end = std::min<std::size_t>(begin + expected[i].num_faces, t.num_faces());
    for (std::size_t f = begin; f < end; ++f) sums[i].add_corners(wide(t.faces()[f]));
    for (std::size_t f = begin; f < end; ++f) sums[i].add_neighbors(f, wide(t.neighbors()[f]));
    begin = end;
  }
  return sum_up(sums);
}

// Keeps the memory of a square for the next one; otherwise a fifth of the time would be spent on
// its pages.
void keep_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_ARENA_MAX, 1);
#endif
}

int run(int argc, char** argv) {
  keep_memory();
  const Task task = parse(argc, argv);
  if (task.num_sites < 10000 || task.depth < 0 || task.depth > 6) {
    std::fprintf(
        stderr,
        "usage: squares_bench N [--depth D] [--threads T] [--check]; N from 10000 on, D to 6\n");
    return 2;
  }
  const Stopwatch watch;
  Squares squares(task);
  if (!squares.join()) return 1;
  const double joined_seconds = watch.seconds();
  const std::vector<FaceSums> of_squares = squares.hash_faces();
  const FaceSums sums = sum_up(of_squares);
  const double seconds = watch.seconds();
  const bool is_closed =
      sums.num_faces == 2 * squares.num_vertices() - 4 && sums.edges == 0 && sums.neighbors == 0;
  std::printf("{\"sites\": %llu, \"vertices\": %llu, \"faces\": %llu, \"open_sites\": %zu,\n",
              static_cast<unsigned long long>(task.num_sites),
              static_cast<unsigned long long>(squares.num_vertices()),
              static_cast<unsigned long long>(sums.num_faces), squares.num_open_sites());
  std::printf(
      " \"joined_seconds\": %.6g, \"seconds\": %.6g, \"closed\": %s, \"hash\": \"%016llx\"}\n",
      joined_seconds, seconds, is_closed ? "true" : "false",
      static_cast<unsigned long long>(sums.hash));
  if (!is_closed) return 1;
  if (task.is_checked && sums_in_memory(squares, task, of_squares).hash != sums.hash) {
    std::fprintf(stderr, "squares_bench: not as in memory\n");
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace rondel::bench

int main(int argc, char** argv) { return rondel::bench::run(argc, argv); }
