// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Recomputes the filters of divide and conquer and the certificate, and compares them with values
// of 400 bits: no error exceeds the bounds that docs/theory/blocks.md derives.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

#include "bulk/open_faces.h"
#include "bulk/piece.h"
#include "exact/eft.h"
#include "order/cube_position.h"
#include "support/adversarial.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

using predicates::Vector;
using Big = mpf_class;
using BigVector = std::array<Big, 3>;

Big big(double v) { return {v, 400}; }
BigVector minus(const BigVector& a, const BigVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Big dot_of(const BigVector& a, const BigVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
BigVector cross_of(const BigVector& a, const BigVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
BigVector times(const Big& s, const BigVector& v) { return {s * v[0], s * v[1], s * v[2]}; }

constexpr Model models[] = {Model::projected, Model::weighted};
constexpr bulk::Extent weights = {0.4, 4};

// Sites of one face of the cube, as divide and conquer sees them, and exactly.
template <class T>
class Cell {
 public:
  // The sites are those of a cell that is twice as long, `levels` times, as one that holds them.
  Cell(std::vector<Point> sites, const Point& center, bool has_weights, unsigned levels = 60)
      : points_(std::move(sites)), order_(points_.size()), center_(center) {
    for (Index i = 0; i < order_.size(); ++i) order_[i] = i;
    has_weights_ = has_weights;
    const auto first = order::exact_cube_position(points_[0], center);
    axes_ = order::cube_axes(first.face);
    std::uint64_t differences = 0;
    for (const Point& p : points_) {
      const auto q = order::exact_cube_position(p, center);
      differences |= (p == center || q.face != first.face) ? ~std::uint64_t{0}
                                                           : (q.u ^ first.u) | (q.v ^ first.v);
    }
    const int bits =
        std::min(static_cast<int>(std::bit_width(differences)) + static_cast<int>(levels),
                 static_cast<int>(order::position_bits));
    const bulk::Square cell = {
        {first.face, first.u >> bits << bits, first.v >> bits << bits}, bits, 0};
    const auto num_sites = static_cast<Index>(points_.size());
    memory_.reserve(num_sites);
    const bulk::Input input = {points_,
                               order_,
                               {{.model = T::model, .sphere = {center}}, {}},
                               {},
                               has_weights ? weights : bulk::Extent{}};
    given_ = bulk::GivenSites<T>(input);
    sites_.assign(input, given_, 0, num_sites, memory_.coordinates());
    sites_.enter(cell, num_sites);
  }

  [[nodiscard]] const bulk::SquareSites<T>& sites() const { return sites_; }
  [[nodiscard]] Sign orientation(Index a, Index b, Index c) { return sites_.orientation(a, b, c); }

  // In the axes of SquareSites::ray: of unit length, or relative to the largest one.
  [[nodiscard]] BigVector ray(Index i) const {
    const Point& p = points_[i];
    const BigVector d = {big(p.x) - big(center_.x), big(p.y) - big(center_.y),
                         big(p.z) - big(center_.z)};
    const auto along = [&](const Point& axis) {
      return Big(d[0] * axis.x + d[1] * axis.y + d[2] * axis.z);
    };
    const BigVector v = {along(axes_.u), sites_.hand() * along(axes_.v), along(axes_.out)};
    const Big length = has_weights_ ? big(weights.max_size) : Big(sqrt(dot_of(v, v)));
    return times(1 / length, v);
  }

  // (u, v, w).
  [[nodiscard]] BigVector point(Index i) const {
    const BigVector r = ray(i);
    return {r[0] / r[2], r[1] / r[2], 1 / r[2]};
  }

 private:
  std::vector<Point> points_;
  std::vector<Index> order_;
  Point center_;
  order::CubeAxes axes_;
  bool has_weights_ = false;
  bulk::PieceMemory memory_;
  bulk::GivenSites<T> given_;
  bulk::SquareSites<T> sites_;
};

// Up to `distance` apart, on the face around (0, 0, 1), with a center or without.
std::vector<Point> close_sites(Random& random, std::size_t n, double distance, bool has_weights,
                               const Point& center) {
  const double u = (1 - distance) * random.signed_unit();
  const double v = (1 - distance) * random.signed_unit();
  std::vector<Point> sites;
  const double size = random.coin() ? 4 : 1;
  while (sites.size() < n) {
    const Point p = {u + distance * random.signed_unit() / 2,
                     v + distance * random.signed_unit() / 2, 1};
    const double length = has_weights ? size * (1 - distance * random.unit() / 2) : 1;
    sites.push_back(center + length * normalized(p));
  }
  return sites;
}

struct Largest {
  double orientation = 0;
  double conflict = 0;
};

template <class T>
Largest largest_errors(bool has_weights) {
  Random random(31);
  Largest largest;
  const double ratio = has_weights ? weights.max_size / weights.min_size : 1;
  for (std::size_t i = 0; i < scaled(20000); ++i) {
    const double distance = std::min(random_distance(random, 1e-15), 0.99);
    const Point center = random.coin() ? Point{} : random.signed_unit() * random_direction(random);
    const Cell<T> cell(close_sites(random, 4, distance, has_weights, center), center, has_weights,
                       static_cast<unsigned>(random.below(30)));
    const auto step_to = [&](Index k) {
      return cell.sites().coordinates(k) - cell.sites().coordinates(0);
    };
    const Vector ab = step_to(1);
    const Vector ac = step_to(2);
    const Vector ad = step_to(3);
    const auto normal = cross(ab, ac);
    const BigVector a = cell.point(0);
    const BigVector exact_normal = cross_of(minus(cell.point(1), a), minus(cell.point(2), a));
    const Big exact_value = dot_of(exact_normal, minus(cell.point(3), a));
    // What limits() says for a length of 1, undone: the bound relative to distances.
    const double unit_distance = has_weights ? 2.01 * ratio + 1.74 * (ratio - 1) : 1.42;
    const double orientation_bound = cell.sites().limits(1).orientation / unit_distance;
    const auto in_plane = [](const Vector& v) { return v.x * v.x + v.y * v.y; };
    const double plane = std::sqrt(std::max({in_plane(ab), in_plane(ac), in_plane(ad)}));
    const double space = std::sqrt(std::max({dot(ab, ab), dot(ac, ac), dot(ad, ad)}));
    const double conflict_bound = cell.sites().conflict_limit(has_weights ? space : plane);
    const double orientation_error = Big(abs(big(normal.z) - exact_normal[2])).get_d();
    const double conflict_error = Big(abs(big(dot(normal, ad)) - exact_value)).get_d();
    largest.orientation =
        std::max(largest.orientation, orientation_error / (orientation_bound * plane));
    largest.conflict = std::max(largest.conflict, conflict_error / conflict_bound);
    // No distance in the cell exceeds what limits() takes for its length.
    const auto of_cell = cell.sites().limits(distance);
    EXPECT_LE(conflict_bound, of_cell.conflict);
    EXPECT_LE(orientation_bound * plane, of_cell.orientation);
  }
  return largest;
}

TEST(bulk_bounds, filters_hold) {
  for (const Model model : models) {
    const Largest largest = model == Model::projected
                                ? largest_errors<models::ProjectedPoints>(false)
                                : largest_errors<models::WeightedPoints>(true);
    std::cout << "orientation: largest error " << largest.orientation
              << " of the bound, conflict: " << largest.conflict << "\n";
    EXPECT_LE(largest.orientation, 1.0);
    EXPECT_LE(largest.conflict, 1.0);
    EXPECT_GT(largest.orientation, 0.02);
    EXPECT_GT(largest.conflict, 0.002);
  }
}

// Four sites on one circle, or three on one great circle, but for the roundings of their
// coordinates.
std::vector<Point> almost_tied(Random& random, double distance, bool on_great_circle) {
  const Point middle = normalized({random.signed_unit() / 2, random.signed_unit() / 2, 1});
  const Point side = normalized(cross_product(middle, random_direction(random)));
  const Point other = cross_product(middle, side);
  std::vector<Point> sites;
  for (int i = 0; i < 4; ++i) {
    const double angle = 6.3 * random.unit();
    const double x = distance * std::cos(angle) / 4;
    const double y = on_great_circle ? 0 : distance * std::sin(angle) / 4;
    sites.push_back(normalized(middle + x * side + y * other));
  }
  return sites;
}

TEST(bulk_bounds, numbers_of_64_bits_do_not_err_and_decide_ties) {
  Random random(33);
  std::size_t num_decided = 0;
  const std::size_t num_sets = scaled(20000);
  for (std::size_t i = 0; i < num_sets; ++i) {
    const double distance =
        std::min(random_distance(random, 1e-9), 1.0);  // on one face of the cube
    const Point center = random.coin() ? Point{} : 0.1 * random_direction(random);
    auto points = almost_tied(random, distance, random.coin());
    for (Point& p : points) p = center + p;
    Cell<models::ProjectedPoints> cell(points, center, false,
                                       static_cast<unsigned>(random.below(30)));
    const BigVector a = cell.point(0);
    const BigVector ab = minus(cell.point(1), a);
    const BigVector ac = minus(cell.point(2), a);
    const BigVector normal = cross_of(ab, ac);
    const int turn = sgn(normal[2]);
    const int side = sgn(dot_of(normal, minus(cell.point(3), a)));
    const auto found_turn =
        static_cast<int>(predicates::orientation_extended(points[0], points[1], points[2], center));
    EXPECT_TRUE(found_turn == 0 || found_turn == turn);
    const auto filtered_side = static_cast<int>(cell.sites().side_over_tangent(0, 1, 2, 3));
    EXPECT_TRUE(filtered_side == 0 || filtered_side == side);
    num_decided += static_cast<std::size_t>(found_turn != 0);
  }
  std::cout << num_decided << " of " << num_sets << " decided\n";
  EXPECT_TRUE(num_decided > num_sets * 99 / 100 || !exact::has_extended_precision());
}

// In a cell that is much longer than the distances of sites its own limits decide nothing.
TEST(bulk_bounds, the_filter_over_a_tangent_decides_close_sites_in_any_cell) {
  Random random(34);
  std::size_t num_decided = 0;
  const std::size_t num_sets = scaled(20000);
  for (std::size_t i = 0; i < num_sets; ++i) {
    const double distance = random_distance(random, 1e-11);
    const Cell<models::ProjectedPoints> cell(close_sites(random, 4, distance / 2, false, {}), {},
                                             false);
    const BigVector a = cell.point(0);
    const BigVector normal = cross_of(minus(cell.point(1), a), minus(cell.point(2), a));
    const int side = sgn(dot_of(normal, minus(cell.point(3), a)));
    const auto found = static_cast<int>(cell.sites().side_over_tangent(0, 1, 2, 3));
    EXPECT_TRUE(found == 0 || found == side);
    num_decided += static_cast<std::size_t>(found != 0);
  }
  std::cout << num_decided << " of " << num_sets << " decided\n";
  EXPECT_GT(num_decided, num_sets * 3 / 4);
}

template <class T>
void expect_true_certificates(bool has_weights) {
  Random random(32);
  std::size_t num_final = 0;
  for (std::size_t i = 0; i < scaled(20000); ++i) {
    // Edges of very different lengths, the site a anywhere.
    const double distance = std::min(random_distance(random, 1e-8), 0.5);
    auto points = close_sites(random, 3, distance, has_weights, {});
    const double ratio = random_distance(random, 1e-7);
    const std::size_t moved = random.below(3);
    const Point& other = points[(moved + 1) % 3];
    points[moved] = other + ratio * (points[moved] - other);
    Cell<T> cell(points, {}, has_weights);
    Index b = 1;
    Index c = 2;
    if (cell.orientation(0, b, c) == Sign::zero) continue;
    if (cell.orientation(0, b, c) == Sign::negative) std::swap(b, c);

    // The circle exactly: its center is the foot of the perpendicular from the center.
    const BigVector a = cell.ray(0);
    const BigVector normal = cross_of(minus(cell.ray(b), a), minus(cell.ray(c), a));
    const BigVector middle = times(Big(dot_of(normal, a) / dot_of(normal, normal)), normal);
    const Big square = 1 - dot_of(middle, middle);
    const Big size = square > 0 ? Big(sqrt(square)) : big(0);

    // A plane that touches the cap, up to an error.
    const Vector axis = {middle[0].get_d(), middle[1].get_d(), middle[2].get_d()};
    const double length = std::sqrt(dot(axis, axis));
    const double off = (random.coin() ? 1 : -1) * random_distance(random, 1e-16);
    const double sine = size.get_d() / length * (1 + off) + (random.coin() ? off : 0);
    if (!(sine > 0 && sine < 1)) continue;
    const Point side =
        normalized(cross_product({axis.x, axis.y, axis.z}, random_direction(random)));
    const double cosine = std::sqrt(1 - sine * sine);
    const Vector inward = {sine * axis.x / length + cosine * side.x,
                           sine * axis.y / length + cosine * side.y,
                           sine * axis.z / length + cosine * side.z};
    const bulk::Cone cone = {inward, inward, inward, inward};

    bulk::PieceMemory memory;
    memory.reserve(3);
    bulk::PlaneGraph graph = memory.graph(0, 0, 3);
    const auto e = graph.add(0, b);
    const auto f = graph.add(b, c);
    const auto g = graph.add(c, 0);
    graph.insert_after(g ^ 1, e);
    graph.insert_after(e ^ 1, f);
    graph.insert_after(f ^ 1, g);
    const bulk::Certificate certificate(cone, has_weights);
    graph.clear_faces();
    std::vector<bulk::PlaneGraph::Edge> open;
    bulk::find_open_faces(graph, e, open, [&](Index i0, Index i1, Index i2) {
      return certificate.is_final(cell.sites().ray(i0), cell.sites().ray(i1), cell.sites().ray(i2));
    });
    if (graph.face(e) == bulk::open_face) continue;
    ++num_final;
    const BigVector exact_inward = {big(inward.x), big(inward.y), big(inward.z)};
    ASSERT_TRUE(dot_of(exact_inward, middle) >= size);
  }
  EXPECT_GT(num_final, scaled(20000) / 100);
}

TEST(bulk_bounds, final_faces_have_their_caps_in_the_cone) {
  expect_true_certificates<models::ProjectedPoints>(false);
  expect_true_certificates<models::WeightedPoints>(true);
}

}  // namespace
}  // namespace rondel::test
