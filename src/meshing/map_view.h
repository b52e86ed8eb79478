// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A map of some places for a picture: Lambert's azimuthal equal-area projection around their middle
// where all of them are within 90 degrees of it, else longitude and latitude.
//
//     x = k east . p    y = -k north . p    k = sqrt(2 / (1 + center . p))
//
// (J. P. Snyder, Map Projections, 1987, chapter 24, in unit vectors.)
//
// in    unit vectors
// out   pixels; y grows downward
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "rondel/types.h"

namespace rondel::meshing {

struct MapPixel {
  double x = 0;
  double y = 0;
};

class MapView {
 public:
  // The map of at most this size, with its corner at the top left there.
  struct MapFrame {
    MapPixel corner;
    double width = 0;
    double height = 0;
  };

  // Precondition: there are places. The frame becomes as large as the map.
  MapView(std::span<const Point> places, const MapFrame& most);

  [[nodiscard]] const MapFrame& frame() const { return frame_; }
  [[nodiscard]] MapPixel pixel(const Point& p) const;

  // Returns the outline of a triangle. In longitude and latitude it may reach beyond the map, by up to
  // a turn, which is so many pixels; one around a pole goes along it.
  [[nodiscard]] std::vector<MapPixel> outline(const std::array<Point, 3>& triangle) const;
  [[nodiscard]] double pixels_of_turn() const { return is_round_ ? 0 : frame_.width; }

  // Returns meridians and parallels, with their degrees where they enter the map, as SVG.
  [[nodiscard]] std::string lines() const;

 private:
  [[nodiscard]] MapPixel plane(const Point& p) const;
  [[nodiscard]] MapPixel to_pixel(const MapPixel& in_plane) const;
  struct Lines {
    std::string path;
    std::string texts;
  };
  void append_line(double value_deg, bool is_meridian, double along_begin_deg, double along_end_deg,
                   Lines& lines) const;

  bool is_round_ = true;  // azimuthal
  Point center_;
  Point east_;
  Point north_;
  double scale_ = 1;
  MapPixel least_;  // of the plane
  MapFrame frame_;
  LonLat least_deg_ = {540, 90};  // of the places, longitudes around that of the center
  LonLat greatest_deg_ = {-540, -90};
};

}  // namespace rondel::meshing
