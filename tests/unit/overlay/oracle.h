// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes what rings enclose, and how much of it lies in a convex cell or between meridians and
// parallels, from the definition: by winding numbers, with 77 digits. It shares no code and no
// formula with the overlay.
//
// Every corner is moved by about 1e-50, depending only on its coordinates. So no three corners are on one great
// circle, no case is special, and areas change by 1e-50 times the length of the border.
#pragma once

#include <boost/multiprecision/mpfr.hpp>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "rondel/types.h"

namespace rondel::test {

using Wide = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<77, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

template <class Number>
struct OracleVector {
  Number x{};
  Number y{};
  Number z{};
};

// A unit vector in three precisions.
class OraclePoint {
 public:
  explicit OraclePoint(const Point& given) : rounded_(given), error_(0) {}
  explicit OraclePoint(const OracleVector<Wide>& computed);

  [[nodiscard]] const Point& rounded() const { return rounded_; }
  // How far rounded() is off, but for a factor and 1e-50.
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] const OracleVector<Wide>& wide() const;
  [[nodiscard]] OracleVector<long double> extended() const;

 private:
  Point rounded_;
  double error_;
  mutable std::optional<OracleVector<Wide>> wide_;
};

struct OracleSide {
  OraclePoint from;
  OraclePoint to;
};

// A convex cell, counterclockwise.
struct OracleCell {
  explicit OracleCell(std::vector<Point> ring);
  std::vector<Point> corners;
  Point center{};
  double radius = 0;  // around all of it, as a distance in space
};

// In degrees, at most 180 wide.
struct OracleBox {
  double west;
  double south;
  double east;
  double north;
};

struct OracleAnswer {
  double area = 0;
  double error = 0;  // a bound
};

class RegionOracle {
 public:
  explicit RegionOracle(const std::vector<std::vector<Point>>& rings);

  // The area of what is neither outside nor inside once: 0 if the rings bound a region.
  [[nodiscard]] double excess() const { return excess_; }
  // How many sides are left when those that run to and fro are gone.
  [[nodiscard]] std::size_t num_sides() const { return num_sides_; }
  // The length of all rings.
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] OracleAnswer area(bool in_full) const;
  // The sphere's area less that.
  [[nodiscard]] double missing() const;
  // What of it is in a cell, in 64 bits with a bound of the error, or in 77 digits.
  [[nodiscard]] OracleAnswer piece(const OracleCell& cell, bool in_full) const;
  [[nodiscard]] OracleAnswer piece(const OracleBox& box, bool in_full) const;

 private:
  // A part of the border, with a point for the triangle of both: one for all sides that hang together.
  struct Piece {
    OracleSide side;
    std::shared_ptr<const OraclePoint> origin;
    double radius;  // of the triangle, around the origin
    int turn;       // the triangle's
    int count;      // how often, more in this direction than in the other one
    int left = 0;   // how often the border goes around what is next to it
    int right = 0;
  };
  static Piece piece_of(const OracleSide& side, std::shared_ptr<const OraclePoint> origin,
                        int count);
  static int turns_around(const std::vector<Piece>& pieces, const OraclePoint& place,
                          std::size_t without);
  static int constant_of(const std::vector<Piece>& border);
  static std::vector<Piece> level_set(const std::vector<Piece>& pieces, int level);
  static Wide area_of(const std::vector<Piece>& border);
  static void wind(std::vector<Piece>& pieces, const std::vector<std::size_t>& chains);
  void choose_inside(const std::vector<Piece>& pieces);
  template <class N>
  [[nodiscard]] OracleAnswer area_in() const;
  template <class N>
  [[nodiscard]] OracleAnswer piece_in_cell(const OracleCell& cell) const;
  template <class N>
  [[nodiscard]] OracleAnswer piece_in_box(const OracleBox& box) const;

  std::vector<Piece> border_;
  int constant_ = 0;  // what the triangles' signs around a place inside are short of 1
  double excess_ = 0;
  double length_ = 0;
  std::size_t num_sides_ = 0;
};

// Whether two sides cross each other in the inside of both, in rational numbers of the coordinates as they are.
bool has_crossing(const std::vector<std::vector<Point>>& rings);

}  // namespace rondel::test
