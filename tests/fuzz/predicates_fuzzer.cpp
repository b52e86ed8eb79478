// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// orientation, side_of_circle, is_in_conflict, is_same_site: the laws of oriented
// matroids and of symmetry, on any six sites.
#include <algorithm>
#include <array>
#include <utility>

#include "fuzz/fuzz_input.h"
#include "rondel/predicates.h"

namespace rondel::fuzz {
namespace {

int number(Sign sign) { return static_cast<int>(sign); }

struct SiteQuadruple {
  const std::vector<Point>& sites;
  Model model;
  Sphere sphere;

  [[nodiscard]] int side(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    return number(side_of_circle(sites[a], sites[b], sites[c], sites[d], model, sphere));
  }
  [[nodiscard]] int oriented(std::size_t a, std::size_t b, std::size_t c) const {
    return number(orientation(sites[a], sites[b], sites[c], sphere));
  }
  [[nodiscard]] bool is_same(std::size_t a, std::size_t b) const {
    return is_same_site(sites[a], sites[b], model, sphere);
  }
  // Ties broken; for four distinct sites not in one plane with the center.
  [[nodiscard]] int perturbed(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    return is_in_conflict(sites[a], sites[b], sites[c], sites[d], model, sphere) ? 1 : -1;
  }
  [[nodiscard]] bool are_in_plane_with_center(std::size_t a, std::size_t b, std::size_t c,
                                              std::size_t d) const {
    return oriented(a, b, c) == 0 && oriented(a, b, d) == 0 && oriented(a, c, d) == 0 &&
           oriented(b, c, d) == 0;
  }
};

void test_orientation(const SiteQuadruple& q) {
  const int sign = q.oriented(0, 1, 2);
  require(q.oriented(1, 2, 0) == sign && q.oriented(2, 0, 1) == sign, "orientation is cyclic");
  require(
      q.oriented(1, 0, 2) == -sign && q.oriented(0, 2, 1) == -sign && q.oriented(2, 1, 0) == -sign,
      "orientation is odd");
  require(q.oriented(0, 0, 1) == 0, "orientation of equal sites is zero");
  // Grassmann and Pluecker: [034][012]... over the common site 0.
  const std::array<int, 3> products = {q.oriented(0, 1, 2) * q.oriented(0, 3, 4),
                                       -q.oriented(0, 1, 3) * q.oriented(0, 2, 4),
                                       q.oriented(0, 1, 4) * q.oriented(0, 2, 3)};
  const auto [low, high] = std::ranges::minmax(products);
  require((low == 0 && high == 0) || (low < 0 && high > 0), "orientation is a chirotope");
}

void test_same_site(const SiteQuadruple& q) {
  require(q.is_same(0, 0), "a site is the same as itself");
  require(q.is_same(0, 1) == q.is_same(1, 0), "being the same is symmetric");
  if (!q.is_same(0, 1)) return;
  require(q.side(0, 1, 2, 3) == 0, "the same sites are coplanar with any two");
  require(q.oriented(0, 1, 2) == 0, "the same sites are in a plane with the center and any");
  require(q.side(0, 2, 3, 4) == q.side(1, 2, 3, 4), "the same sites lie on the same side");
  require(q.is_same(0, 2) == q.is_same(1, 2), "being the same is transitive");
}

void test_permutations(const SiteQuadruple& q) {
  const int sign = q.side(0, 1, 2, 3);
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  do {
    int parity = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) parity = order[i] > order[j] ? -parity : parity;
    }
    require(q.side(order[0], order[1], order[2], order[3]) == parity * sign,
            "side_of_circle is odd");
  } while (std::ranges::next_permutation(order).found);
  require(q.side(0, 1, 1, 2) == 0, "side_of_circle of equal sites is zero");
}

// Every sign of a 4-subset, under the three-term relation for each pair of common sites.
void test_chirotope(const SiteQuadruple& q, bool is_perturbed) {
  const auto sign = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return is_perturbed ? q.perturbed(a, b, c, d) : q.side(a, b, c, d);
  };
  const std::array<int, 3> products = {sign(0, 1, 2, 3) * sign(0, 1, 4, 5),
                                       -sign(0, 1, 2, 4) * sign(0, 1, 3, 5),
                                       sign(0, 1, 2, 5) * sign(0, 1, 3, 4)};
  const auto [low, high] = std::ranges::minmax(products);
  require((low == 0 && high == 0) || (low < 0 && high > 0),
          is_perturbed ? "is_in_conflict is a chirotope" : "side_of_circle is a chirotope");
  // Points, not vectors: the five dets with weights of one sign add up to zero.
  const std::array<int, 5> radon = {sign(1, 2, 3, 4), -sign(0, 2, 3, 4), sign(0, 1, 3, 4),
                                    -sign(0, 1, 2, 4), sign(0, 1, 2, 3)};
  const auto [least, most] = std::ranges::minmax(radon);
  require((least == 0 && most == 0) || (least < 0 && most > 0), "five sites have a Radon point");
}

void test_exact_signs(const SiteQuadruple& q) { test_chirotope(q, false); }

void test_ties(const SiteQuadruple& q) {
  bool are_general = true;
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = a + 1; b < 6; ++b) {
      if (q.is_same(a, b)) return;
      for (std::size_t c = b + 1; c < 6; ++c) {
        for (std::size_t d = c + 1; d < 6; ++d) {
          if (q.are_in_plane_with_center(a, b, c, d)) are_general = false;
        }
      }
    }
  }
  if (const int sign = q.side(0, 1, 2, 3); sign != 0) {
    require(q.perturbed(0, 1, 2, 3) == sign, "is_in_conflict follows side_of_circle");
  }
  if (!q.are_in_plane_with_center(0, 1, 2, 3)) {
    require(q.perturbed(0, 1, 2, 3) == -q.perturbed(1, 0, 2, 3), "is_in_conflict is odd");
    require(q.perturbed(0, 1, 2, 3) == -q.perturbed(3, 1, 2, 0), "is_in_conflict is odd");
    require(q.perturbed(0, 1, 2, 3) == q.perturbed(1, 2, 0, 3), "is_in_conflict is cyclic");
  }
  if (are_general) test_chirotope(q, true);
}

// A mirror exchanges the sides; a cyclic shift of the axes changes nothing. The
// tie-breaking order is that of the coordinates, so this is about exact signs only.
void test_symmetry(const SiteQuadruple& q) {
  const auto changed = [&](auto&& change) {
    std::vector<Point> moved;
    for (const Point& p : q.sites) moved.push_back(change(p));
    Sphere sphere = q.sphere;
    sphere.center = change(q.sphere.center);
    const SiteQuadruple r{moved, q.model, sphere};
    return std::pair(r.side(0, 1, 2, 3), r.oriented(0, 1, 2));
  };
  const std::pair before(q.side(0, 1, 2, 3), q.oriented(0, 1, 2));
  require(changed([](const Point& p) {
            return Point{p.y, p.z, p.x};
          }) == before,
          "a shift of the axes keeps every sign");
  require(changed([](const Point& p) {
            return Point{-p.x, p.y, p.z};
          }) == std::pair(-before.first, -before.second),
          "a mirror inverts every sign");
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  const std::uint8_t what = source.byte();
  const fuzz::Scales scales = fuzz::next_scales(source);
  const Sphere sphere = fuzz::next_sphere(source, scales);
  std::vector<Point> sites;
  while (sites.size() < 6) sites.push_back(fuzz::next_site(source, sites, scales));
  const Model model = what % 2 == 0 ? Model::projected : Model::weighted;
  if (model == Model::projected) {
    std::vector<Point> rays = sites;
    fuzz::remove_center(rays, sphere);
    if (rays.size() < sites.size()) return 0;
  }
  constexpr std::array laws = {fuzz::test_orientation,  fuzz::test_same_site,
                               fuzz::test_permutations, fuzz::test_exact_signs,
                               fuzz::test_ties,         fuzz::test_symmetry};
  laws[what / 2 % laws.size()]({sites, model, sphere});
  return 0;
}
