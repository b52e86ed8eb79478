// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/cubic_face.h"

#include <algorithm>
#include <cmath>

namespace rondel::interpolation {
namespace {

constexpr std::array<unsigned, 3> next_of = {1, 2, 0};
constexpr std::array<unsigned, 3> previous = {2, 0, 1};

// Squares of the lengths of sides between which S of one is far from 0 and nothing underflows. The
// sides of an octahedron, 2, are well within.
constexpr double longest_square = 2.125;
constexpr double shortest_square = 0x1p-400;

// Of the coordinates a and b: C1 across edges so much shorter than their faces would take values so many
// times.
constexpr double largest_part = 1024;

// Both faces of an edge are higher than an eighth of it.
constexpr double full_share_of_height = 64;

}  // namespace

// Edge k, from x_i to x_j.
struct CubicFace::FaceEdge {
  unsigned i;
  unsigned j;
  Vec start;  // the step to x_i
  Vec d;      // x_j - x_i
  double square;

  // z = a x_i + b x_j + something normal to the edge, z - x_i - that is
  // (a + b - 1) times the midpoint plus (b - a + 1) / 2 times d.
  struct EdgeCoordinates {
    double a;
    double b;
    double along;
    double lack;  // 1 - a - b
  };
  // Of the point at e from x_i, with |e|^2 and |e - d|^2.
  [[nodiscard]] EdgeCoordinates part(const Vec& e, double from_i, double from_j) const {
    const double along = dot(e, d) / square;
    const double lack = (from_i + from_j - square) / (4 - square);
    return {1 - along - lack / 2, along - lack / 2, along, lack};
  }

  double weight;            // what the value takes of X
  Vec h{};                  // H
  double height{};          // |H|^2
  EdgeCoordinates inner{};  // of x_k
};

bool CubicFace::weigh(const std::array<double, 3>& l, FaceWeights& result) {
  for (unsigned k = 0; k < 3; ++k) {
    const Vec d = corners[previous[k]].step - corners[next_of[k]].step;
    squares_[k] = dot(d, d);
    if (!(squares_[k] <= longest_square && squares_[k] >= shortest_square)) return false;
  }
  result = {};
  weigh_points(l);
  for (unsigned k = 0; k < 3; ++k) weigh_edge(k, result);
  collect(result);
  return true;
}

// In the part of the face that has the point, (x_i, x_j, v), its coordinates are s, t, r; k has the
// least l.
void CubicFace::weigh_points(const std::array<double, 3>& l) {
  const auto k = static_cast<unsigned>(std::ranges::min_element(l) - l.begin());
  const unsigned i = next_of[k];
  const unsigned j = previous[k];
  const double s = l[i] - l[k];
  const double t = l[j] - l[k];
  const double r = 3 * l[k];
  // p[v, v, v] is the mean of the p[x, v, v], these of p[x, x, v] and both p[x, x', v], these of
  // p[x, x, .] and of both p[x, x', .] and e.
  std::array<double, 3> of_center{};  // of p[x, v, v]
  of_center[k] = r * r * r / 3;
  of_center[i] = of_center[k] + 3 * s * r * r;
  of_center[j] = of_center[k] + 3 * t * r * r;
  std::array<double, 3> of_spokes{};  // of p[x, x, v]
  for (unsigned m = 0; m < 3; ++m) {
    of_spokes[m] = of_center[m] / 3;
    of_edges_[m] = (of_center[next_of[m]] + of_center[previous[m]]) / 3;  // of p[x, x', v]
  }
  of_spokes[i] += 3 * s * s * r;
  of_spokes[j] += 3 * t * t * r;
  of_edges_[k] += 6 * s * t * r;
  for (unsigned m = 0; m < 3; ++m) {
    of_spokes[m] /= 3;
    of_edges_[m] /= 3;
  }
  for (unsigned m = 0; m < 3; ++m) {
    of_pairs_[m][m] = of_spokes[m];
    of_pairs_[m][next_of[m]] = of_spokes[m] + of_edges_[previous[m]];
    of_pairs_[m][previous[m]] = of_spokes[m] + of_edges_[next_of[m]];
  }
  of_pairs_[i][i] += s * s * s;
  of_pairs_[j][j] += t * t * t;
  of_pairs_[i][j] += 3 * s * s * t;
  of_pairs_[j][i] += 3 * s * t * t;
}

void CubicFace::weigh_edge(unsigned k, FaceWeights& result) {
  const unsigned i = next_of[k];
  const unsigned j = previous[k];
  FaceEdge edge{i,           j,           corners[i].step, corners[j].step - corners[i].step,
                squares_[k], of_edges_[k]};
  const Vec e = corners[k].step - edge.start;
  edge.inner = edge.part(e, squares_[j], squares_[i]);
  if (std::max(std::abs(edge.inner.a), std::abs(edge.inner.b)) > largest_part) {
    of_pairs_[i][k] += edge.weight / 2;
    of_pairs_[j][k] += edge.weight / 2;
    return;
  }
  const Vec middle = corners[i].place + 0.5 * edge.d;
  edge.h = (e - edge.inner.along * edge.d) + edge.inner.lack * middle;
  edge.height = dot(edge.h, edge.h);
  of_pairs_[i][j] += edge.weight * edge.inner.a;
  of_pairs_[j][i] += edge.weight * edge.inner.b;
  const double share = has_opposite[k] ? weigh_across(edge, k, result) : 0;
  const double cosine = 1 - edge.square / 2;
  const Vec slope = (edge.weight * (1 - share) * cosine / 6) * edge.h;
  result.slopes[i] = result.slopes[i] + slope;
  result.slopes[j] = result.slopes[j] + slope;
}

// X_4, and its share. With y = a' x_i + b' x_j - q H (q > 0) and P = p[., ., x_i], the equations for
// p[x_k, x_k, x_i] and p[y, y, x_i] are linear in X and p[H, H, x_i]; without the latter,
//
//   2 q A X = R_i = q^2 P(x_k, x_k) - P(y, y) - (qa - a') B f_i - (qb - b') A P(x_j, x_j)
//                   - ((qa - a') A + (qb - b') B) P(x_i, x_j) - 2/3 q B g_i.H,
//
// where A = qb + b' and B = qa + a'; the same at x_j with A and B in turns. Least squares:
// X = (A R_i + B R_j) / (2 q (A^2 + B^2)). The other face of the edge has 1/q, H -> -q H and the same X
// in its own terms.
double CubicFace::weigh_across(const FaceEdge& edge, unsigned k, FaceWeights& result) {
  const unsigned i = edge.i;
  const unsigned j = edge.j;
  const Vec e = opposites[k].step - edge.start;
  const double from_i = dot(e, e);
  const double from_j = dot(e - edge.d, e - edge.d);
  const double q = -dot(e, edge.h) / edge.height;
  if (!(q > 0)) return 0;
  const FaceEdge::EdgeCoordinates outer = edge.part(e, from_i, from_j);
  const double a_sum = q * edge.inner.b + outer.b;  // A
  const double b_sum = q * edge.inner.a + outer.a;  // B
  // Where the edge is seen from x_k and y at more than a right angle or so, as in few faces of a
  // coarse triangulation, X_4 has no say.
  const double turn = std::clamp(4 * (a_sum + b_sum) / (1 + q) - 2, 0.0, 1.0);
  const double least_height = std::min(1.0, q * q) * edge.height;
  const double share = turn * std::min(1.0, full_share_of_height * least_height / edge.square);
  if (!(share > 0)) return 0;

  const double a_difference = q * edge.inner.a - outer.a;
  const double b_difference = q * edge.inner.b - outer.b;
  const double mixed = a_difference * a_sum + b_difference * b_sum;
  const double scale = edge.weight * share / (2 * q * (a_sum * a_sum + b_sum * b_sum));
  const double w_i = scale * a_sum;
  const double w_j = scale * b_sum;
  of_pairs_[k][i] += q * q * w_i;
  of_pairs_[k][j] += q * q * w_j;
  of_pairs_[i][i] -= w_i * a_difference * b_sum;
  of_pairs_[j][j] -= w_j * b_difference * a_sum;
  of_pairs_[i][j] -= w_i * mixed + w_j * a_difference * b_sum;
  of_pairs_[j][i] -= w_j * mixed + w_i * b_difference * a_sum;
  const double by_height = 2 * q / 3;
  result.slopes[i] = result.slopes[i] - (by_height * w_i * b_sum) * edge.h;
  result.slopes[j] = result.slopes[j] - (by_height * w_j * a_sum) * edge.h;
  // P(y, y) at x_i and x_j: y's own value and gradient.
  result.weights[3 + k] = -(w_i * (1 - from_i / 2) + w_j * (1 - from_j / 2));
  const Vec towards = (w_i + w_j) * e - w_j * edge.d;
  const double radial = (w_i * from_i + w_j * from_j) / 2;
  result.slopes[3 + k] = (towards - radial * opposites[k].place) / 3;
  return share;
}

void CubicFace::collect(FaceWeights& result) const {
  for (unsigned i = 0; i < 3; ++i) {
    double weight = of_pairs_[i][i];
    double radial = 0;
    Vec slope{0, 0, 0};
    for (const unsigned j : {next_of[i], previous[i]}) {
      const double square = squares_[3 - i - j];
      const double w = of_pairs_[i][j];
      weight += w * (1 - square / 2);
      radial += w * square / 2;
      slope = slope + w * (corners[j].step - corners[i].step);
    }
    result.weights[i] = weight;
    result.slopes[i] = result.slopes[i] + (slope + radial * corners[i].place) / 3;
  }
}

}  // namespace rondel::interpolation
