// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/cubic_faces.h"

#include <cmath>

#include "system/wide_vectors.h"

namespace rondel::interpolation {
namespace {

constexpr std::size_t lanes = CubicFaces::lanes;
using Lanes = CubicFaces::Lanes;
using LaneVectors = CubicFaces::LaneVectors;
using FaceLanes = CubicFaces::FaceLanes;

constexpr std::size_t next_of(std::size_t k) { return (k + 1) % 3; }
constexpr std::size_t previous_of(std::size_t k) { return (k + 2) % 3; }

// Bounds of the squared lengths of sides between which S of 1 is far from 0 and nothing underflows.
// The squared sides of an octahedron, 2, are well within.
constexpr double longest_square = 2.125;
constexpr double shortest_square = 0x1p-400;

// The bound of the coordinates a and b. A continuous gradient across edges that are shorter than
// their faces by this factor would multiply values by it.
constexpr double largest_part = 1024;

// (8)^2: X_4 has its full share if both faces of an edge are higher than an eighth of the edge.
constexpr double full_share_of_height = 64;

// One vector of one lane.
struct LaneVec {
  double x;
  double y;
  double z;
};

RONDEL_ALWAYS_INLINE inline LaneVec at(const LaneVectors& v, std::size_t lane) {
  return {v.x[lane], v.y[lane], v.z[lane]};
}
RONDEL_ALWAYS_INLINE inline void put(LaneVectors& v, std::size_t lane, const LaneVec& a) {
  v.x[lane] = a.x;
  v.y[lane] = a.y;
  v.z[lane] = a.z;
}
RONDEL_ALWAYS_INLINE inline LaneVec sum(const LaneVec& a, const LaneVec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
RONDEL_ALWAYS_INLINE inline LaneVec difference(const LaneVec& a, const LaneVec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
RONDEL_ALWAYS_INLINE inline LaneVec times(double s, const LaneVec& a) {
  return {s * a.x, s * a.y, s * a.z};
}
RONDEL_ALWAYS_INLINE inline double product(const LaneVec& a, const LaneVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
RONDEL_ALWAYS_INLINE inline LaneVec third(const LaneVec& a) { return {a.x / 3, a.y / 3, a.z / 3}; }
// Returns `a` or 0, whatever `a` is, NaN included.
RONDEL_ALWAYS_INLINE inline double only_if(bool is, double a) { return is ? a : 0.0; }
RONDEL_ALWAYS_INLINE inline LaneVec only_if(bool is, const LaneVec& a) {
  return {only_if(is, a.x), only_if(is, a.y), only_if(is, a.z)};
}
// This is std::min(), which compilers do not always inline.
RONDEL_ALWAYS_INLINE inline double least(double a, double b) { return b < a ? b : a; }
// Computes `a && b` without a branch.
RONDEL_ALWAYS_INLINE inline bool all_of(bool a, bool b) {
  return (static_cast<unsigned>(a) & static_cast<unsigned>(b)) != 0;
}

// Sets the squared length of edge K. Lanes with an edge that is too long or too short are not
// weighed.
template <std::size_t K>
RONDEL_ALWAYS_INLINE inline void measure_edge(FaceLanes& s) {
  RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
    const LaneVec d =
        difference(at(s.corners[previous_of(K)].step, l), at(s.corners[next_of(K)].step, l));
    const double square = product(d, d);
    s.squares[K][l] = square;
    const bool is_sound = all_of(square <= longest_square, square >= shortest_square);
    s.is_weighed[l] = only_if(is_sound, s.is_weighed[l]);
  }
}

// With k the index of the smallest l, the coordinates of the point in the part (x_i, x_j, v) of the
// face are s = l_i - l_k, t = l_j - l_k, r = 3 l_k. The excess u of a corner is s, t or, at x_k, 0.
RONDEL_ALWAYS_INLINE inline void weigh_points(FaceLanes& state) {
  RONDEL_KEEP_LOOP for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double l0 = state.l[0][lane];
    const double l1 = state.l[1][lane];
    const double l2 = state.l[2][lane];
    const double lowest = least(least(l0, l1), l2);
    const double u0 = l0 - lowest;
    const double u1 = l1 - lowest;
    const double u2 = l2 - lowest;
    const double r = 3 * lowest;
    // p[v, v, v] is the mean of the three p[x, v, v]; p[x, v, v] is the mean of p[x, x, v] and both
    // p[x, x', v]; p[x, x, v] is that of the p[x, x, .], and p[x, x', v] that of both p[x, x', .]
    // and e.
    const double all = r * r * r / 3;
    const double of_center0 = all + 3 * u0 * r * r;  // factor of p[x, v, v]
    const double of_center1 = all + 3 * u1 * r * r;
    const double of_center2 = all + 3 * u2 * r * r;
    const double spoke0 = (of_center0 / 3 + 3 * u0 * u0 * r) / 3;  // factor of p[x, x, v]
    const double spoke1 = (of_center1 / 3 + 3 * u1 * u1 * r) / 3;
    const double spoke2 = (of_center2 / 3 + 3 * u2 * u2 * r) / 3;
    // factor of p[x, x', v]
    const double edge0 = ((of_center1 + of_center2) / 3 + 6 * u1 * u2 * r) / 3;
    const double edge1 = ((of_center2 + of_center0) / 3 + 6 * u2 * u0 * r) / 3;
    const double edge2 = ((of_center0 + of_center1) / 3 + 6 * u0 * u1 * r) / 3;
    state.of_edges[0][lane] = edge0;
    state.of_edges[1][lane] = edge1;
    state.of_edges[2][lane] = edge2;
    state.of_pairs[0][0][lane] = spoke0 + u0 * u0 * u0;
    state.of_pairs[1][1][lane] = spoke1 + u1 * u1 * u1;
    state.of_pairs[2][2][lane] = spoke2 + u2 * u2 * u2;
    state.of_pairs[0][1][lane] = (spoke0 + edge2) + 3 * u0 * u0 * u1;
    state.of_pairs[1][2][lane] = (spoke1 + edge0) + 3 * u1 * u1 * u2;
    state.of_pairs[2][0][lane] = (spoke2 + edge1) + 3 * u2 * u2 * u0;
    state.of_pairs[1][0][lane] = (spoke1 + edge2) + 3 * u0 * u1 * u1;
    state.of_pairs[2][1][lane] = (spoke2 + edge0) + 3 * u1 * u2 * u2;
    state.of_pairs[0][2][lane] = (spoke0 + edge1) + 3 * u2 * u0 * u0;
  }
}

// The coordinates of a point z = a x_i + b x_j + a vector normal to the edge. Apart from the normal
// part, z - x_i is (a + b - 1) times the midpoint plus (b - a + 1) / 2 times d.
struct EdgeCoordinates {
  double a;
  double b;
  double along;
  double lack;  // 1 - a - b
};
// Returns the coordinates of the point x_i + e, given |e|^2 and |e - d|^2.
RONDEL_ALWAYS_INLINE inline EdgeCoordinates part_of_edge(const LaneVec& e, const LaneVec& d,
                                                         double square, double from_i,
                                                         double from_j) {
  const double along = product(e, d) / square;
  const double lack = (from_i + from_j - square) / (4 - square);
  return {1 - along - lack / 2, along - lack / 2, along, lack};
}

// X_4 and its share. With y = a' x_i + b' x_j - q H (q > 0) and P = p[., ., x_i], the equations for
// p[x_k, x_k, x_i] and p[y, y, x_i] are linear in X and p[H, H, x_i]; eliminating the latter,
//   2 q A X = R_i = q^2 P(x_k, x_k) - P(y, y) - (qa - a') B f_i - (qb - b') A P(x_j, x_j)
//                   - ((qa - a') A + (qb - b') B) P(x_i, x_j) - 2/3 q B g_i.H,
//
// where A = qb + b' and B = qa + a'; at x_j the same holds with A and B exchanged. Least squares
// give X = (A R_i + B R_j) / (2 q (A^2 + B^2)). The other face of the edge has 1/q and -q H in
// place of q and H, and computes the same X.
struct BeyondEdge {
  double share;  // if 0, all others are 0 too
  double q;
  double a_sum;  // A
  double b_sum;  // B
  double a_difference;
  double b_difference;
};
RONDEL_ALWAYS_INLINE inline BeyondEdge look_across(bool may_look, const LaneVec& h,
                                                   const LaneVec& e, double square,
                                                   const EdgeCoordinates& inner,
                                                   const EdgeCoordinates& outer) {
  const double height = product(h, h);
  const double q = -product(e, h) / height;
  const double a_sum = q * inner.b + outer.b;
  const double b_sum = q * inner.a + outer.a;
  // X_4 fades out where x_k and y see the edge at more than about a right angle, as in few faces of
  // a coarse triangulation.
  const double turn = 4 * (a_sum + b_sum) / (1 + q) - 2;
  const double bounded = turn < 0 ? 0.0 : (1.0 < turn ? 1.0 : turn);
  const double min_height = least(1.0, q * q) * height;
  const double share = bounded * least(1.0, full_share_of_height * min_height / square);
  const bool is = all_of(all_of(may_look, q > 0), share > 0);
  return {only_if(is, share),
          only_if(is, q),
          only_if(is, a_sum),
          only_if(is, b_sum),
          only_if(is, q * inner.a - outer.a),
          only_if(is, q * inner.b - outer.b)};
}

// Computes the weights that come through edge K, from x_i to x_j.
template <std::size_t K>
RONDEL_ALWAYS_INLINE inline void weigh_edge(FaceLanes& s) {
  constexpr std::size_t i = next_of(K);
  constexpr std::size_t j = previous_of(K);
  RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
    const LaneVec start = at(s.corners[i].step, l);
    const LaneVec d = difference(at(s.corners[j].step, l), start);
    const LaneVec inner_e = difference(at(s.corners[K].step, l), start);
    const double square = s.squares[K][l];
    const double weight = s.of_edges[K][l];  // derivative of the value by X
    const EdgeCoordinates inner =
        part_of_edge(inner_e, d, square, s.squares[j][l], s.squares[i][l]);
    const bool is_long =
        all_of(std::fabs(inner.a) <= largest_part, std::fabs(inner.b) <= largest_part);
    const LaneVec middle = sum(at(s.corners[i].place, l), times(0.5, d));
    const LaneVec h = only_if(
        is_long, sum(difference(inner_e, times(inner.along, d)), times(inner.lack, middle)));
    const LaneVec e = difference(at(s.opposites[K].step, l), start);
    const LaneVec e_from_j = difference(e, d);
    const double from_i = product(e, e);
    const double from_j = product(e_from_j, e_from_j);
    const EdgeCoordinates outer = part_of_edge(e, d, square, from_i, from_j);
    const BeyondEdge x =
        look_across(all_of(is_long, s.has_opposite[K][l] != 0), h, e, square, inner, outer);

    const double mixed = x.a_difference * x.a_sum + x.b_difference * x.b_sum;
    const double scale = only_if(
        x.share > 0, weight * x.share / (2 * x.q * (x.a_sum * x.a_sum + x.b_sum * x.b_sum)));
    const double w_i = scale * x.a_sum;
    const double w_j = scale * x.b_sum;
    const double half = is_long ? 0.0 : weight / 2;
    s.of_pairs[i][K][l] += half;
    s.of_pairs[j][K][l] += half;
    s.of_pairs[K][i][l] += x.q * x.q * w_i;
    s.of_pairs[K][j][l] += x.q * x.q * w_j;
    s.of_pairs[i][i][l] -= w_i * x.a_difference * x.b_sum;
    s.of_pairs[j][j][l] -= w_j * x.b_difference * x.a_sum;
    s.of_pairs[i][j][l] = (s.of_pairs[i][j][l] + only_if(is_long, weight * inner.a)) -
                          (w_i * mixed + w_j * x.a_difference * x.b_sum);
    s.of_pairs[j][i][l] = (s.of_pairs[j][i][l] + only_if(is_long, weight * inner.b)) -
                          (w_j * mixed + w_i * x.b_difference * x.a_sum);
    const double by_height = 2 * x.q / 3;
    const double cosine = 1 - square / 2;
    const LaneVec slope = times(weight * (1 - x.share) * cosine / 6, h);
    put(s.slopes[i], l,
        sum(difference(at(s.slopes[i], l), times(by_height * w_i * x.b_sum, h)), slope));
    put(s.slopes[j], l,
        sum(difference(at(s.slopes[j], l), times(by_height * w_j * x.a_sum, h)), slope));
    // The terms P(y, y) at x_i and x_j: value and gradient of y.
    s.weights[3 + K][l] = -(w_i * (1 - from_i / 2) + w_j * (1 - from_j / 2));
    const LaneVec towards = difference(times(w_i + w_j, e), times(w_j, d));
    const double radial = (w_i * from_i + w_j * from_j) / 2;
    put(s.slopes[3 + K], l, third(difference(towards, times(radial, at(s.opposites[K].place, l)))));
  }
}

// Turns the derivatives by p[x_i, x_i, x_j] at corner I into weights of its value and gradient, by
// the formulas of the header.
template <std::size_t I>
RONDEL_ALWAYS_INLINE inline void collect(FaceLanes& s) {
  constexpr std::size_t j = next_of(I);
  constexpr std::size_t k = previous_of(I);
  RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
    const LaneVec here = at(s.corners[I].step, l);
    const double to_j = s.of_pairs[I][j][l];
    const double to_k = s.of_pairs[I][k][l];
    s.weights[I][l] =
        s.of_pairs[I][I][l] + to_j * (1 - s.squares[k][l] / 2) + to_k * (1 - s.squares[j][l] / 2);
    const double radial = to_j * s.squares[k][l] / 2 + to_k * s.squares[j][l] / 2;
    const LaneVec slope = sum(times(to_j, difference(at(s.corners[j].step, l), here)),
                              times(to_k, difference(at(s.corners[k].step, l), here)));
    put(s.slopes[I], l,
        sum(at(s.slopes[I], l), third(sum(slope, times(radial, at(s.corners[I].place, l))))));
  }
}

RONDEL_ALWAYS_INLINE inline void weigh_in_lanes(FaceLanes& s) {
  RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) s.is_weighed[l] = 1;
  for (std::size_t k = 0; k < 3; ++k) s.slopes[k] = {};
  measure_edge<0>(s);
  measure_edge<1>(s);
  measure_edge<2>(s);
  weigh_points(s);
  weigh_edge<0>(s);
  weigh_edge<1>(s);
  weigh_edge<2>(s);
  collect<0>(s);
  collect<1>(s);
  collect<2>(s);
}

}  // namespace

void CubicFaces::weigh() {
  FaceLanes& state = state_;
  system::with_wide_vectors([&state]() RONDEL_ALWAYS_INLINE { weigh_in_lanes(state); });
}

}  // namespace rondel::interpolation
