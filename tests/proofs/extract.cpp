// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the formulas of the filters as terms of Coq (rounding.v): what a filter compares to accept a
// sign, and the value whose sign that is. The formulas are those of the library, whose sources
// are compiled here with numbers that remember how they were computed.
//
//     extract >formulas.v
//
// A filter runs on points of which it is sure; all comparisons and operations of this run are recorded.
// Then it runs again for each outcome that its comparisons may have. A comparison that only another
// outcome leads to, as a second try of an unsure filter, is an error: no theorem would be about it. So is
// a sign where no comparison with a limit has held. Branches on equality, or on exponents, are those of the
// points.
//
// Comparisons with a constant other than 0 guard against underflow; they, and those that are named as
// choices, keep their outcome in these runs.
#include "traced.h"

// The headers of the standard library come before: they need their own double. A `long double` is one
// number, too; its formulas are checked with its own unit.
#define double ::rondel::proofs::Number
#define long
#define private public
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
#undef private

namespace rondel {
Sign orientation(const Point& /*a*/, const Point& /*b*/, const Point& /*c*/,
                 const Sphere& /*sphere*/) {
  throw proofs::NextRung();
}
}  // namespace rondel

namespace rondel::proofs {
namespace {

using predicates::Vector;

int num_given = 0;
int num_words = 0;

Number given(double value) { return {value, add_operation("Given", {num_given++}, value)}; }
// Elements of braces are evaluated in their order.
Vector given_vector(double x, double y, double z) { return {given(x), given(y), given(z)}; }
predicates::Pair given_pair(double x, double y) { return {given(x), given(y)}; }
Point given_point(double x, double y, double z) { return {given(x), given(y), given(z)}; }

// Words of pairs, which are of no use alone.
using exact::SplitPoint;
Number given_word(double value) {
  const int number = num_words++;
  return {value, add_operation("Word", {}, number)};
}
Point given_words(double x, double y, double z) {
  return {given_word(x), given_word(y), given_word(z)};
}
SplitPoint given_split_point(double x, double y, double z) {
  return {given_words(x, y, z), given_words(0x1p-60, 0x1p-61, 0x1p-62)};
}
exact::Vector3<exact::DoubleDouble> given_pairs_of_doubles(double x, double y, double z) {
  const SplitPoint p = given_split_point(x, y, z);
  return {{p.hi.x, p.lo.x}, {p.hi.y, p.lo.y}, {p.hi.z, p.lo.z}};
}

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

// Roots, quotients and high words of pairs, which terms have not: they are given as numbers from 100 on, and what
// they are of is written down as terms of its own.
std::vector<int> cuts;

// Products with powers of two, each by a shift of its own, which a definition takes as an argument.
std::vector<int> scaled;

// Pairs that are given, in the order of their use; they follow the numbers that are given.
std::vector<int> pairs;

std::size_t place_in(std::vector<int>& list, int item) {
  const auto found = std::ranges::find(list, item);
  const auto place = static_cast<std::size_t>(found - list.begin());
  if (found == list.end()) list.push_back(item);
  return place;
}

std::string given_term(std::size_t number) { return "(Given " + std::to_string(number) + ")"; }

std::string term(int place) {
  const Operation& operation = operations[static_cast<std::size_t>(place)];
  if (operation.name == "Constant") return constant(operation.value);
  if (operation.name == "High" || std::ranges::find(cuts, place) != cuts.end()) {
    return given_term(100 + place_in(cuts, place));
  }
  if (operation.name == "Given") return given_term(static_cast<std::size_t>(operation.operands[0]));
  if (operation.name == "Pair") {
    return given_term(static_cast<std::size_t>(num_given) + place_in(pairs, place));
  }
  if (operation.name == "Scaled") {
    return "(Scaled " + term(operation.operands[0]) + " (shift " +
           std::to_string(place_in(scaled, place)) + "%nat))";
  }
  std::string text = "(" + operation.name;
  for (const int operand : operation.operands) text += " " + term(operand);
  return text + ")";
}

// The whole formula, the same text in each run.
std::string whole(int place) {
  const Operation& operation = operations[static_cast<std::size_t>(place)];
  if (operation.name == "Constant") return constant(operation.value);
  std::string text = "(" + operation.name;
  if (operation.name == "Given") return text + " " + std::to_string(operation.operands[0]) + ")";
  if (operation.name == "Word") return text + " " + constant(operation.value) + ")";
  for (const int operand : operation.operands) text += " " + whole(operand);
  if (operation.name == "Pair") {
    for (const auto& [words, pair] : given_pairs) {
      if (pair == place) text += " " + whole(words.first) + " " + whole(words.second);
    }
  }
  return text + ")";
}

std::string whole(const Comparison& comparison) {
  return whole(comparison.left) + " > " + whole(comparison.right);
}

bool is_guard(const Comparison& comparison) {
  const auto is_constant = [](int place) {
    const Operation& operation = operations[static_cast<std::size_t>(place)];
    return operation.name == "Constant" && operation.value != 0;
  };
  return is_constant(comparison.left) || is_constant(comparison.right);
}

void start_run() {
  operations.clear();
  comparisons.clear();
  given_pairs.clear();
  num_given = 0;
  num_words = 0;
}

// Written last, if a filter compares what it does not when it is sure.
std::ostringstream errors;

// What the sure runs compare, with their outcomes.
std::map<std::string, bool> known;

// Whether a run has a comparison with a limit that held. Signs and what is fixed are none.
bool has_accepted(const std::vector<bool>& outcomes, const std::map<std::string, bool>& fixed) {
  std::size_t num_asked = 0;
  for (const Comparison& comparison : comparisons) {
    if (fixed.contains(whole(comparison))) continue;
    const auto is_zero = [](int place) {
      const Operation& operation = operations[static_cast<std::size_t>(place)];
      return operation.name == "Constant" && operation.value == 0;
    };
    const bool is_sign = is_zero(comparison.left) || is_zero(comparison.right);
    if (outcomes[num_asked++] && !is_sign) return true;
  }
  return false;
}

// Runs a filter for all outcomes of its comparisons but those that are fixed.
template <class Filter>
void run_all(const std::string& name, Filter filter, const std::map<std::string, bool>& fixed) {
  std::set<std::string> unknown;
  std::vector<bool> outcomes;
  do {
    std::size_t num_asked = 0;
    start_run();
    outcome = [&](const Comparison& comparison) {
      const auto found = fixed.find(whole(comparison));
      if (found != fixed.end()) return found->second;
      if (num_asked == outcomes.size()) outcomes.push_back(false);
      return static_cast<bool>(outcomes[num_asked++]);
    };
    bool is_answered = false;
    try {
      is_answered = static_cast<int>(filter()) != 0;
    } catch (const NextRung&) {
    }
    outcome = nullptr;
    if (is_answered && !has_accepted(outcomes, fixed)) {
      errors << name << " answers where no comparison has accepted\n";
    }
    for (const Comparison& comparison : comparisons) {
      const std::string text = whole(comparison);
      if (!known.contains(text)) unknown.insert(text);
    }
    while (!outcomes.empty() && outcomes.back()) outcomes.pop_back();
    if (!outcomes.empty()) outcomes.back() = true;
  } while (!outcomes.empty());
  for (const std::string& text : unknown) {
    errors << name << " compares what no theorem is about:\n  " << text << "\n";
  }
}

void write_definition(const std::string& name, const std::string& text) {
  const bool is_shifted = text.find("(shift ") != std::string::npos || !scaled.empty();
  std::cout << "Definition " << name << (is_shifted ? " (shift : nat -> Z)" : "")
            << " : term := " << text << ".\n";
}

void write_cut(const std::string& name, std::size_t number) {
  const Operation operation = operations[static_cast<std::size_t>(cuts[number])];
  for (std::size_t k = 0; k < operation.operands.size(); ++k) {
    write_definition(
        name + "_" + operation.name + "_" + std::to_string(100 + number) + (k == 0 ? "_of" : "_by"),
        term(operation.operands[k]));
  }
}

void write_comparisons(const std::string& name) {
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const auto& [left, right, is_greater] = comparisons[i];
    const std::string place = name + "_" + std::to_string(i);
    const std::string of_left = term(left);
    const std::string of_right = term(right);
    write_definition(place + "_left", of_left);
    write_definition(place + "_right", of_right);
    std::cout << "(* " << operations[static_cast<std::size_t>(left)].value
              << (is_greater ? " > " : " <= ") << operations[static_cast<std::size_t>(right)].value
              << " *)\n";
  }
}

// What a filter compares that is sure. The next write() is of the same filter, on other points.
template <class Filter>
void write_sure(const std::string& name, Filter filter) {
  start_run();
  try {
    filter();
  } catch (const NextRung&) {
    errors << name << " is not sure of points of which it should be\n";
  }
  std::cout << "\n(* " << name << ": " << num_given << " numbers are given. *)\n";
  cuts.clear();
  scaled.clear();
  pairs.clear();
  for (std::size_t i = 0; i < operations.size(); ++i) {
    const std::string& kind = operations[i].name;
    if (kind != "Root" && kind != "Quotient") continue;
    write_cut(name, place_in(cuts, static_cast<int>(i)));
  }
  const std::size_t num_written = cuts.size();
  write_comparisons(name);
  for (std::size_t i = num_written; i < cuts.size(); ++i) write_cut(name, i);
  for (const Comparison& comparison : comparisons) {
    known[whole(comparison)] = comparison.is_greater;
  }
}

// The same, and that it compares nothing else when it is unsure; as `part` does, where the first run begins or
// ends with other filters. `choices` are numbers of comparisons whose outcome is kept.
template <class Filter, class Part>
void write(const std::string& name, Filter filter, Part part, std::set<std::size_t> choices = {}) {
  write_sure(name, filter);
  std::map<std::string, bool> fixed;
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const std::string text = whole(comparisons[i]);
    if (is_guard(comparisons[i]) || choices.contains(i)) fixed[text] = comparisons[i].is_greater;
  }
  run_all(name, part, fixed);
  known.clear();
}
template <class Filter>
void write(const std::string& name, Filter filter, std::set<std::size_t> choices = {}) {
  write(name, filter, filter, std::move(choices));
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
    return predicates::side_of_plane_filter(b, c, d, p);
  });
  write("orientation", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.2, 0.8, 0.1);
    const Point c = given_point(0.1, 0.3, 0.7);
    const Point o = given_point(0.05, 0.02, 0.01);
    return predicates::filter(a, b, c, o);
  });
  write("orientation_extended", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.2, 0.8, 0.1);
    const Point c = given_point(0.1, 0.3, 0.7);
    const Point o = given_point(0.05, 0.02, 0.01);
    return predicates::orientation_extended(a, b, c, o);
  });
  write("orientation_wide", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.2, 0.8, 0.1);
    const Point c = given_point(0.1, 0.3, 0.7);
    const Point o = given_point(0.05, 0.02, 0.01);
    return predicates::wide_filter(a, b, c, o);
  });
  write("plane_double_double", [] {
    const predicates::PlaneSteps steps = {given_pairs_of_doubles(0.9, 0.1, 0.2),
                                          given_pairs_of_doubles(0.2, 0.8, 0.1),
                                          given_pairs_of_doubles(0.1, 0.3, 0.7)};
    return predicates::side_of_plane_double_double(steps);
  });
  write("circle_double_double", [] {
    const SplitPoint b = given_split_point(0.9, 0.1, 0.2);
    const SplitPoint c = given_split_point(0.2, 0.8, 0.1);
    const SplitPoint d = given_split_point(0.1, 0.3, 0.7);
    const SplitPoint p = given_split_point(0.05, 0.02, 0.01);
    return predicates::side_of_circle_double_double(b, c, d, p);
  });
  write("angle_double_double", [] {
    const SplitPoint a = given_split_point(0.2, 0.8, 0.1);
    const SplitPoint b = given_split_point(0.9, 0.1, 0.2);
    const SplitPoint p = given_split_point(0.05, 0.02, 0.01);
    return predicates::compare_angle_double_double(a, b, p);
  });
  for (const bool is_positive : {true, false}) {
    write(is_positive ? "within_angle_double_double" : "within_angle_behind_double_double", [=] {
      const Number t = given(0.1);
      const SplitPoint a = given_split_point(0.2, 0.8, 0.1);
      const SplitPoint p = given_split_point(0.05, 0.02, 0.01);
      return predicates::is_within_angle_double_double(a, p, {is_positive, t});
    });
  }
  write("direction_orientation", [] {
    const Vector a = given_vector(0.9, 0.1, 0.2);
    const Vector b = given_vector(0.2, 0.8, 0.1);
    const Vector c = given_vector(0.1, 0.3, 0.7);
    return predicates::orientation_filter(a, b, c);
  });
  write_sure("circle_plane", [] {
    const Vector b = given_vector(0.9, 0.1, 0.2);
    const Vector c = given_vector(0.2, 0.8, 0.1);
    const Vector d = given_vector(0.1, 0.3, 0.7);
    const Vector p = given_vector(0.05, 0.02, 0.01);
    return predicates::side_of_circle_filter(b, c, d, p);
  });
  write("circle", [] {
    // So close that the plain form is not sure.
    const double h = 0x1p-30;
    const Vector b = given_vector(0.6, h, 0.8);
    const Vector c = given_vector(0.6 - 0.8 * h, 0, 0.8 + 0.6 * h);
    const Vector d = given_vector(0.6 + 0.8 * h, -h, 0.8 - 0.6 * h);
    const Vector p = given_vector(0.6, 0, 0.8);
    return predicates::side_of_circle_filter(b, c, d, p);
  });
  write("sure_side", [] {
    const Vector b = given_vector(0.9, 0.1, 0.2);
    const Vector c = given_vector(0.2, 0.8, 0.1);
    const Vector d = given_vector(0.1, 0.3, 0.7);
    const Vector p = given_vector(0.05, 0.02, 0.01);
    const Vector bc = c - b;
    const Vector bd = d - b;
    return predicates::sure_side_of_face(b, cross(bc, bd), dot(bc, bc), dot(bd, bd), p);
  });
  write("angle", [] {
    const Vector b = given_vector(0.9, 0.1, 0.2);
    const Vector a = given_vector(0.2, 0.8, 0.1);
    const Vector p = given_vector(0.05, 0.02, 0.01);
    return predicates::compare_angle_filter(dot(a - p, a - p), dot(b - p, b - p));
  });
  write("within_angle", [] {
    const Vector a = given_vector(0.2, 0.8, 0.1);
    const Vector p = given_vector(0.05, 0.02, 0.01);
    const Number t = given(0.1);
    return predicates::is_within_angle_filter(a, p, {true, t});
  });
  write("within_angle_behind", [] {
    const Vector a = given_vector(0.2, 0.8, 0.1);
    const Vector p = given_vector(0.05, 0.02, 0.01);
    const Number t = given(0.1);
    return predicates::is_within_angle_filter(a, p, {false, t});
  });
  write("power", [] {
    const Point a = given_point(0.2, 0.8, 0.1);
    const Point b = given_point(0.9, 0.1, 0.2);
    const Point p = given_point(0.5, 0.2, 0.1);
    const Point o = given_point(0.05, 0.02, 0.01);
    predicates::FourPoints<Model::weighted> points{{a, b, p, p}, o};
    return predicates::compare_power(points, 0, 1, 2).sign;
  });
  write("within_power", [] {
    const Point a = given_point(0.2, 0.8, 0.1);
    const Point p = given_point(0.9, 0.1, 0.2);
    const Point o = given_point(0.05, 0.02, 0.01);
    const Number t = given(0.1);
    const Number squared_radius = given(2.0);
    return predicates::is_within_power_filter(a, p, {true, t}, {o, squared_radius});
  });
  write("turn", [] {
    const predicates::Pair o = given_pair(0.1, 0.2);
    const predicates::Pair p = given_pair(0.9, 0.3);
    const predicates::Pair q = given_pair(0.4, 0.7);
    return predicates::filter(o, p, q);
  });
  write(
      "ray_order",
      [] {
        const Point a = given_point(0.9, 0.1, 0.2);
        const Point b = given_point(0.8, 0.3, 0.1);
        const Point o = given_point(0.05, 0.02, 0.01);
        return predicates::compare_rays(a, b, o);
      },
      [] {
        const Vector a = given_vector(0.9, 0.1, 0.2);
        const Vector b = given_vector(0.8, 0.3, 0.1);
        const Vector o = given_vector(0.05, 0.02, 0.01);
        return predicates::compare_slopes_filter(a - o, b - o, 1, 0);
      });
  write(
      "line",
      [] {
        const Point p = given_point(0.9, 0.1, 0.2);
        const Point q = given_point(0.2, 0.8, 0.1);
        const Point y = given_point(0.1, 0.3, 0.7);
        return overlay::TracedLine(p, q).is_left(y);
      },
      [] {
        const Point p = given_point(0.9, 0.1, 0.2);
        const Point q = given_point(0.2, 0.8, 0.1);
        const Point y = given_point(0.1, 0.3, 0.7);
        const overlay::TracedLine line(p, q);
        return line.is_sure(line.rough_side(y));
      });
  write(
      "edge",
      [] {
        const Point y = given_point(0.9, 0.1, 0.2);
        const Point z = given_point(0.2, 0.8, 0.1);
        const Point p = given_point(0.1, 0.3, 0.7);
        return overlay::CoverEdge(y, z).is_left(p);
      },
      [] {
        const Point y = given_point(0.9, 0.1, 0.2);
        const Point z = given_point(0.2, 0.8, 0.1);
        const Point p = given_point(0.1, 0.3, 0.7);
        const overlay::CoverEdge edge(y, z);
        return edge.is_sure(edge.scaled_distance(p));
      });
  write("side", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.2, 0.8, 0.1);
    const Point p = given_point(0.1, 0.3, 0.7);
    return arrangement::SidedArc(a, b).side(p);
  });
  write("change", [] {
    const Point a = given_point(0.9, 0.1, 0.2);
    const Point b = given_point(0.2, 0.8, 0.1);
    const Point y = given_point(0.1, 0.3, 0.7);
    return overlay::sign_of_change(a, b, y);
  });
  write(
      "change_at_end",
      [] {
        const Point p = given_point(0.9, 0.1, 0.2);
        const Point q = given_point(0.2, 0.8, 0.1);
        return overlay::TracedLine(p, q).is_left(p);
      },
      [] {
        const Point p = given_point(0.9, 0.1, 0.2);
        const Point q = given_point(0.2, 0.8, 0.1);
        const overlay::TracedLine line(p, q);
        return overlay::sign_of_change_at_end(p, line.step(), p);
      });
  write("near_end",
        [] {
          const Vector normal = given_vector(0.1, 0.2, 0.3);
          const Number limit = given(1e-15);
          const Point from = given_point(0.9, 0.1, 0.2);
          const Point to = given_point(0.2, 0.8, 0.1);
          const Point p = given_point(0.9, 0.2, 0.2);
          return overlay::sign_by_nearer_end(normal, limit, from, to, p);
        },
        {0});
  write_sure("direction", [] {
    const Point p = given_point(0.9, 0.1, 0.2);
    const Point o = given_point(0.05, 0.02, 0.01);
    predicates::direction(p, o);
  });
  write_sure("norm", [] {
    const Vector v = given_vector(0.9, 0.1, 0.2);
    (void)(dot(v, v) > 0);
  });
  known.clear();  // these are no filters
  write("plane_line", [] {
    const predicates::Pair a = given_pair(0.1, 0.2);
    const predicates::Pair b = given_pair(0.9, 0.3);
    const predicates::Pair c = given_pair(0.7, 0.1);  // to the right, which is asked last
    return overlay::side_of_line({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
  });
}

}  // namespace
}  // namespace rondel::proofs

int main() {
  std::cout << "(* Written by extract.cpp. *)\n"
               "From Coq Require Import ZArith.\nFrom Rondel Require Import rounding.\n"
               "Open Scope Z_scope.\n";
  rondel::proofs::write_all();
  std::cerr << rondel::proofs::errors.str();
  return rondel::proofs::errors.str().empty() ? 0 : 1;
}
