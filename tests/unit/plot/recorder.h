// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A pen that keeps what it is told, as polylines.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "globe.h"

namespace rondel::cli {

class Recorder final : public Pen {
 public:
  std::vector<std::vector<Spot>> paths;
  int num_lines = 0;
  int num_curves = 0;

  void move_to(Spot to) override { paths.push_back({to}); }
  void line_to(Spot to) override {
    ++num_lines;
    paths.back().push_back(to);
  }
  void curve_to(Spot control1, Spot control2, Spot to) override {
    ++num_curves;
    const Spot from = paths.back().back();
    constexpr int samples = 16;
    for (int i = 1; i <= samples; ++i) {
      const double t = static_cast<double>(i) / samples, s = 1 - t;
      const double b0 = s * s * s, b1 = 3 * s * s * t, b2 = 3 * s * t * t, b3 = t * t * t;
      paths.back().push_back({b0 * from.x + b1 * control1.x + b2 * control2.x + b3 * to.x,
                              b0 * from.y + b1 * control1.y + b2 * control2.y + b3 * to.y});
    }
  }

  // The area inside the paths, positive for counterclockwise ones.
  [[nodiscard]] double area() const {
    double twice = 0;
    for (const auto& path : paths) {
      for (std::size_t i = 0; i < path.size(); ++i) {
        const Spot p = path[i], q = path[(i + 1) % path.size()];
        twice += p.x * q.y - p.y * q.x;
      }
    }
    return twice / 2;
  }
};

inline double length(Spot p) { return std::hypot(p.x, p.y); }

// Random unit vectors.
class Directions {
 public:
  explicit Directions(unsigned seed) : engine_(seed) {}
  Point next() {
    const double x = normal_(engine_), y = normal_(engine_), z = normal_(engine_);
    return normalized({x, y, z});
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

inline double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace rondel::cli
