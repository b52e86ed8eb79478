// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the formulas of the filters as terms of Coq (rounding.v): what a filter compares to accept a
// sign, and the value whose sign that is. The formulas are those of the library, whose sources
// are compiled here with numbers that remember how they were computed.
//
//     extract >formulas.v
//
// A filter runs once, on points of which it is sure; all comparisons and operations of this run are
// recorded. No filter branches but on the comparisons, and on which of two numbers is larger.
#include "traced.h"

// The headers of the standard library come before: they need their own double. A `long double` is one
// number, too; its formulas are checked with its own unit.
#define double ::rondel::proofs::Number
#define long
#include "arrangement/sided_arc.h"
#include "overlay/perturbed_predicates.cpp"
#include "overlay/plane.h"
#include "predicates/compare_distance.cpp"
#include "predicates/orientation.cpp"
#include "predicates/points.cpp"
#include "predicates/ray_order.cpp"
#include "predicates/side_of_circle.cpp"
#include "predicates/side_of_circle_wide.cpp"
#include "predicates/side_of_plane.cpp"
#include "predicates/turn.cpp"
#include "predicates/within_angle.cpp"
#undef double
#undef long

namespace rondel::proofs {
namespace {

using predicates::Vector;

int num_given = 0;

Number given(double value) { return {value, add_operation("Given", {num_given++}, value)}; }
// Elements of braces are evaluated in their order.
Vector given_vector(double x, double y, double z) { return {given(x), given(y), given(z)}; }
predicates::Pair given_pair(double x, double y) { return {given(x), given(y)}; }
Point given_point(double x, double y, double z) { return {given(x), given(y), given(z)}; }

// m 2^e with an odd m.
std::string constant(double value) {
  if (value == 0) return "(Constant 0 0)";
  int exponent = 0;
  double mantissa = std::ldexp(std::frexp(value, &exponent), 53);
  exponent -= 53;
  while (std::fmod(mantissa, 2) == 0) {
    mantissa /= 2;
    ++exponent;
  }
  return "(Constant (" + std::to_string(static_cast<std::int64_t>(mantissa)) + ") (" +
         std::to_string(exponent) + "))";
}

// Roots and quotients, which terms have not: they are given as numbers from 100 on, and what they are of is
// written down as terms of its own.
std::vector<int> cuts;

// Products with powers of two, each by a shift of its own, which a definition takes as an argument.
std::vector<int> scaled;

std::string term(int place) {
  const Operation& operation = operations[static_cast<std::size_t>(place)];
  if (operation.name == "Constant") return constant(operation.value);
  const auto cut = std::ranges::find(cuts, place);
  if (cut != cuts.end()) return "(Given " + std::to_string(100 + (cut - cuts.begin())) + ")";
  if (operation.name == "Given") return "(Given " + std::to_string(operation.operands[0]) + ")";
  if (operation.name == "Scaled") {
    const auto found = std::ranges::find(scaled, place);
    const auto number = found - scaled.begin();
    if (found == scaled.end()) scaled.push_back(place);
    return "(Scaled " + term(operation.operands[0]) + " (shift " + std::to_string(number) +
           "%nat))";
  }
  std::string text = "(" + operation.name;
  for (const int operand : operation.operands) text += " " + term(operand);
  return text + ")";
}

template <class Filter>
void write(const std::string& name, Filter filter) {
  operations.clear();
  comparisons.clear();
  num_given = 0;
  filter();
  std::cout << "\n(* " << name << ": " << num_given << " numbers are given. *)\n";
  cuts.clear();
  scaled.clear();
  for (std::size_t i = 0; i < operations.size(); ++i) {
    const Operation& operation = operations[i];
    if (operation.name != "Root" && operation.name != "Quotient") continue;
    for (std::size_t k = 0; k < operation.operands.size(); ++k) {
      std::cout << "Definition " << name << "_" << operation.name << "_" << 100 + cuts.size()
                << (k == 0 ? "_of" : "_by") << " : term := " << term(operation.operands[k])
                << ".\n";
    }
    cuts.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const auto& [left, right, is_greater] = comparisons[i];
    const std::string place = name + "_" + std::to_string(i);
    const std::string of_left = term(left);
    const std::string of_right = term(right);
    const char* argument = scaled.empty() ? "" : " (shift : nat -> Z)";
    std::cout << "Definition " << place << "_left" << argument << " : term := " << of_left << ".\n"
              << "Definition " << place << "_right" << argument << " : term := " << of_right
              << ".\n"
              << "(* " << operations[static_cast<std::size_t>(left)].value
              << (is_greater ? " > " : " <= ") << operations[static_cast<std::size_t>(right)].value
              << " *)\n";
  }
}

void write_constant(const std::string& name, const Number& value) {
  std::cout << "\nDefinition " << name << " : term := " << constant(value.value) << ".\n";
}

void write_all() {
  write_constant("direction_error", predicates::direction_error);
  write_constant("arrangement_radius", arrangement_radius);
  write("plane", [] {
    const Vector b = given_vector(0.9, 0.1, 0.2);
    const Vector c = given_vector(0.2, 0.8, 0.1);
    const Vector d = given_vector(0.1, 0.3, 0.7);
    const Vector p = given_vector(0.05, 0.02, 0.01);
    predicates::side_of_plane_filter(b, c, d, p);
  });
  write("orientation", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.2, 0.8, 0.1);
    const Point c = given_point(0.1, 0.3, 0.7);
    const Point o = given_point(0.05, 0.02, 0.01);
    predicates::filter(a, b, c, o);
  });
  write("orientation_extended", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.2, 0.8, 0.1);
    const Point c = given_point(0.1, 0.3, 0.7);
    const Point o = given_point(0.05, 0.02, 0.01);
    predicates::orientation_extended(a, b, c, o);
  });
  write("orientation_wide", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.2, 0.8, 0.1);
    const Point c = given_point(0.1, 0.3, 0.7);
    const Point o = given_point(0.05, 0.02, 0.01);
    predicates::wide_filter(a, b, c, o);
  });
  // The template with which pairs of doubles are multiplied; what is given are exact pairs.
  write_constant("angle_double_double_bound",
                 predicates::angle_double_double_bound * predicates::angle_double_double_bound);
  write("double_double_distances", [] {
    const Vector b = given_vector(0.9, 0.1, 0.2);
    const Vector a = given_vector(0.2, 0.8, 0.1);
    (void)(dot(b, b) - dot(a, a) > 0);
  });
  write_constant("circle_double_double_bound", predicates::circle_double_double_bound);
  write_constant("plane_double_double_bound",
                 predicates::plane_double_double_bound * predicates::plane_double_double_bound);
  write("double_double_determinant", [] {
    const Vector b = given_vector(0.9, 0.1, 0.2);
    const Vector c = given_vector(0.2, 0.8, 0.1);
    const Vector d = given_vector(0.1, 0.3, 0.7);
    (void)(-det(b, c, d) > 0);
  });
  write("direction_orientation", [] {
    const Vector a = given_vector(0.9, 0.1, 0.2);
    const Vector b = given_vector(0.2, 0.8, 0.1);
    const Vector c = given_vector(0.1, 0.3, 0.7);
    predicates::orientation_filter(a, b, c);
  });
  write("circle_plane", [] {
    const Vector b = given_vector(0.9, 0.1, 0.2);
    const Vector c = given_vector(0.2, 0.8, 0.1);
    const Vector d = given_vector(0.1, 0.3, 0.7);
    const Vector p = given_vector(0.05, 0.02, 0.01);
    predicates::side_of_circle_filter(b, c, d, p);
  });
  write("circle", [] {
    // So close that the plain form is not sure.
    const double h = 0x1p-30;
    const Vector b = given_vector(0.6, h, 0.8);
    const Vector c = given_vector(0.6 - 0.8 * h, 0, 0.8 + 0.6 * h);
    const Vector d = given_vector(0.6 + 0.8 * h, -h, 0.8 - 0.6 * h);
    const Vector p = given_vector(0.6, 0, 0.8);
    predicates::side_of_circle_filter(b, c, d, p);
  });
  write("angle", [] {
    const Vector b = given_vector(0.9, 0.1, 0.2);
    const Vector a = given_vector(0.2, 0.8, 0.1);
    const Vector p = given_vector(0.05, 0.02, 0.01);
    predicates::compare_angle_filter(dot(a - p, a - p), dot(b - p, b - p));
  });
  write("within_angle", [] {
    const Vector a = given_vector(0.2, 0.8, 0.1);
    const Vector p = given_vector(0.05, 0.02, 0.01);
    const Number t = given(0.1);
    predicates::is_within_angle_filter(a, p, {true, t});
  });
  write("within_angle_behind", [] {
    const Vector a = given_vector(0.2, 0.8, 0.1);
    const Vector p = given_vector(0.05, 0.02, 0.01);
    const Number t = given(0.1);
    predicates::is_within_angle_filter(a, p, {false, t});
  });
  write("power", [] {
    const Point a = given_point(0.2, 0.8, 0.1);
    const Point b = given_point(0.9, 0.1, 0.2);
    const Point p = given_point(0.5, 0.2, 0.1);
    const Point o = given_point(0.05, 0.02, 0.01);
    predicates::FourPoints<Model::weighted> points{{a, b, p, p}, o};
    (void)predicates::compare_power(points, 0, 1, 2);
  });
  write("within_power", [] {
    const Point a = given_point(0.2, 0.8, 0.1);
    const Point p = given_point(0.9, 0.1, 0.2);
    const Point o = given_point(0.05, 0.02, 0.01);
    const Number t = given(0.1);
    const Number squared_radius = given(2.0);
    predicates::is_within_power_filter(a, p, {true, t}, {o, squared_radius});
  });
  write("turn", [] {
    const predicates::Pair o = given_pair(0.1, 0.2);
    const predicates::Pair p = given_pair(0.9, 0.3);
    const predicates::Pair q = given_pair(0.4, 0.7);
    predicates::filter(o, p, q);
  });
  write("ray_order", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.8, 0.3, 0.1);
    const Point o = given_point(0.05, 0.02, 0.01);
    predicates::compare_rays(a, b, o);
  });
  write("line", [] {
    const Point p = given_point(0.9, 0.1, 0.2);
    const Point q = given_point(0.2, 0.8, 0.1);
    const Point y = given_point(0.1, 0.3, 0.7);
    (void)overlay::TracedLine(p, q).is_left(y);
  });
  write("edge", [] {
    const Point y = given_point(0.9, 0.1, 0.2);
    const Point z = given_point(0.2, 0.8, 0.1);
    const Point p = given_point(0.1, 0.3, 0.7);
    (void)overlay::CoverEdge(y, z).is_left(p);
  });
  write("side", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.2, 0.8, 0.1);
    const Point p = given_point(0.1, 0.3, 0.7);
    (void)arrangement::SidedArc(a, b).side(p);
  });
  write("change", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.2, 0.8, 0.1);
    const Point y = given_point(0.1, 0.3, 0.7);
    overlay::sign_of_change(a, b, y);
  });
  write("change_at_end", [] {
    const Point p = given_point(0.9, 0.1, 0.2);
    const Point q = given_point(0.2, 0.8, 0.1);
    (void)overlay::TracedLine(p, q).is_left(p);
  });
  write("near_end", [] {
    const Vector normal = given_vector(0.1, 0.2, 0.3);
    const Number limit = given(1e-15);
    const Point from = given_point(0.9, 0.1, 0.2);
    const Point to = given_point(0.2, 0.8, 0.1);
    const Point p = given_point(0.9, 0.2, 0.2);
    overlay::sign_by_nearer_end(normal, limit, from, to, p);
  });
  write("direction", [] {
    const Point p = given_point(0.9, 0.1, 0.2);
    const Point o = given_point(0.05, 0.02, 0.01);
    predicates::direction(p, o);
  });
  write("norm", [] {
    const Vector v = given_vector(0.9, 0.1, 0.2);
    (void)(dot(v, v) > 0);
  });
  write("plane_line", [] {
    const predicates::Pair a = given_pair(0.1, 0.2);
    const predicates::Pair b = given_pair(0.9, 0.3);
    const predicates::Pair c = given_pair(0.4, 0.7);
    overlay::side_of_line({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
  });
}

}  // namespace
}  // namespace rondel::proofs

int main() {
  std::cout << "(* Written by extract.cpp. *)\n"
               "From Coq Require Import ZArith.\nFrom Rondel Require Import rounding.\n"
               "Open Scope Z_scope.\n";
  rondel::proofs::write_all();
}
