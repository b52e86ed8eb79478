// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// countries_bench FILE [TURNS] (FILE of countries.py): set operations on countries by Rondel, by S2
// and by GEOS, which computes in the plane of longitude and latitude, all with one thread:
//
// union         of all countries
// intersection  of each country with itself, moved by a tenth of a degree to the east
//
// Sides of countries cross here and there, since the file has rounded positions. So Rondel and GEOS
// repair them before the clock starts, each for itself, S2 gets those of Rondel, and countries that S2
// finds invalid then are left out. Making operands is not measured. Each turn moves all countries by
// another angle, so that no program gets an input twice. Prints one JSON object with medians in
// seconds of the processor.

#include <geos_c.h>
#include <s2/s2debug.h>
#include <s2/s2error.h>
#include <s2/s2latlng.h>
#include <s2/s2polygon.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "measure.h"
#include "rondel/rondel.h"
#include "rondel/set_operations.h"

namespace {

using rondel::Index;

using Ring = std::vector<std::array<double, 2>>;  // degrees
using Polygon = std::vector<Ring>;                // the outer ring first
using Country = std::vector<Polygon>;

std::vector<Country> read_countries(const char* path) {
  std::vector<Country> countries;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line == "country") {
      countries.emplace_back();
    } else if (line == "polygon") {
      countries.back().emplace_back();
    } else {
      std::istringstream numbers(line);
      Ring ring;
      for (double lon, lat; numbers >> lon >> lat;) ring.push_back({lon, lat});
      countries.back().back().push_back(std::move(ring));
    }
  }
  return countries;
}

std::vector<const Ring*> rings_of(const Country& country) {
  std::vector<const Ring*> rings;
  for (const Polygon& polygon : country) {
    for (const Ring& ring : polygon) rings.push_back(&ring);
  }
  return rings;
}

std::vector<Country> moved(std::vector<Country> countries, double east) {
  for (Country& country : countries) {
    for (Polygon& polygon : country) {
      for (Ring& ring : polygon) {
        for (auto& position : ring) position[0] += east;
      }
    }
  }
  return countries;
}

// Returns the valid polygons of countries.
rondel::CellRings rondel_cells(const std::vector<Country>& countries) {
  rondel::CellRings cells;
  for (const Country& country : countries) {
    for (const Ring* ring : rings_of(country)) {
      for (const auto& position : *ring) {
        const S2Point p = S2LatLng::FromDegrees(position[1], position[0]).Normalized().ToPoint();
        cells.corners.push_back(static_cast<Index>(cells.points.size()));
        cells.points.push_back({p.x(), p.y(), p.z()});
      }
      cells.end_ring();
    }
    cells.end_cell();
  }
  return rondel::repaired(cells);
}

std::unique_ptr<S2Polygon> s2_polygon(const rondel::CellRings& cells, std::size_t cell) {
  std::vector<std::unique_ptr<S2Loop>> loops;
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    std::vector<S2Point> points;
    for (const Index corner : cells.corners_of(r)) {
      const rondel::Point& p = cells.points[corner];
      points.emplace_back(p.x, p.y, p.z);
    }
    loops.push_back(std::make_unique<S2Loop>(points, S2Debug::DISABLE));
  }
  auto polygon = std::make_unique<S2Polygon>();
  polygon->set_s2debug_override(S2Debug::DISABLE);
  polygon->InitOriented(std::move(loops));
  return polygon;
}

std::vector<std::unique_ptr<S2Polygon>> s2_polygons(const rondel::CellRings& cells) {
  std::vector<std::unique_ptr<S2Polygon>> polygons;
  for (std::size_t k = 0; k < cells.num_cells(); ++k) polygons.push_back(s2_polygon(cells, k));
  return polygons;
}

void leave_out_invalid(std::vector<Country>& countries) {
  const rondel::CellRings cells = rondel_cells(countries);
  std::vector<Country> valid;
  for (std::size_t k = 0; k < countries.size(); ++k) {
    S2Error error;
    if (!s2_polygon(cells, k)->FindValidationError(&error)) valid.push_back(countries[k]);
  }
  countries = std::move(valid);
}

GEOSGeometry* geos_ring(const Ring& ring) {
  const auto size = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* positions = GEOSCoordSeq_create(size + 1, 2);
  for (unsigned k = 0; k <= size; ++k) {
    GEOSCoordSeq_setXY(positions, k, ring[k % size][0], ring[k % size][1]);
  }
  return GEOSGeom_createLinearRing(positions);
}

GEOSGeometry* geos_country(const Country& country) {
  std::vector<GEOSGeometry*> polygons;
  for (const Polygon& polygon : country) {
    std::vector<GEOSGeometry*> holes;
    for (std::size_t k = 1; k < polygon.size(); ++k) holes.push_back(geos_ring(polygon[k]));
    polygons.push_back(GEOSGeom_createPolygon(geos_ring(polygon[0]), holes.data(),
                                              static_cast<unsigned>(holes.size())));
  }
  GEOSGeometry* given = GEOSGeom_createCollection(GEOS_MULTIPOLYGON, polygons.data(),
                                                  static_cast<unsigned>(polygons.size()));
  GEOSGeometry* valid = GEOSMakeValid(given);
  GEOSGeom_destroy(given);
  return valid;
}

std::vector<GEOSGeometry*> geos_countries(const std::vector<Country>& countries) {
  std::vector<GEOSGeometry*> made;
  for (const Country& country : countries) made.push_back(geos_country(country));
  return made;
}

// Returns seconds of the processor, which other work on the machine changes less.
template <class Work>
double seconds_of(const Work& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// The seconds of each turn.
struct Seconds {
  std::vector<double> rondel;
  std::vector<double> s2;
  std::vector<double> geos;
};

void unite(const std::vector<Country>& countries, Seconds& seconds) {
  const rondel::CellRings cells = rondel_cells(countries);
  seconds.rondel.push_back(seconds_of([&] { rondel::unite(cells, {.threads = 1}); }));
  std::vector<std::unique_ptr<S2Polygon>> polygons = s2_polygons(cells);
  seconds.s2.push_back(seconds_of([&] { S2Polygon::DestructiveUnion(std::move(polygons)); }));
  std::vector<GEOSGeometry*> made = geos_countries(countries);
  GEOSGeometry* all = GEOSGeom_createCollection(GEOS_GEOMETRYCOLLECTION, made.data(),
                                                static_cast<unsigned>(made.size()));
  GEOSGeometry* united = nullptr;
  seconds.geos.push_back(seconds_of([&] { united = GEOSUnaryUnion(all); }));
  if (united == nullptr) std::fprintf(stderr, "GEOS has no union\n");
  GEOSGeom_destroy(united);
  GEOSGeom_destroy(all);
}

void intersect(const std::vector<Country>& countries, Seconds& seconds) {
  constexpr double shift = 0.1;
  const std::vector<Country> others = moved(countries, shift);
  const rondel::CellRings first = rondel_cells(countries);
  const rondel::CellRings second = rondel_cells(others);
  std::vector<std::array<Index, 2>> pairs;
  for (Index k = 0; k < first.num_cells(); ++k) pairs.push_back({k, k});
  seconds.rondel.push_back(seconds_of([&] {
    rondel::combine_pairs(first, second, pairs, rondel::SetOperation::intersection, {.threads = 1});
  }));
  const auto s2_first = s2_polygons(first);
  const auto s2_second = s2_polygons(second);
  seconds.s2.push_back(seconds_of([&] {
    for (std::size_t k = 0; k < s2_first.size(); ++k) {
      S2Polygon result;
      result.InitToIntersection(*s2_first[k], *s2_second[k]);
    }
  }));
  const std::vector<GEOSGeometry*> geos_first = geos_countries(countries);
  const std::vector<GEOSGeometry*> geos_second = geos_countries(others);
  seconds.geos.push_back(seconds_of([&] {
    for (std::size_t k = 0; k < geos_first.size(); ++k) {
      GEOSGeom_destroy(GEOSIntersection(geos_first[k], geos_second[k]));
    }
  }));
  for (GEOSGeometry* geometry : geos_first) GEOSGeom_destroy(geometry);
  for (GEOSGeometry* geometry : geos_second) GEOSGeom_destroy(geometry);
}

void ignore(const char* /*format*/, ...) {}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: countries_bench FILE [TURNS]\n");
    return 2;
  }
  const int turns = argc > 2 ? std::atoi(argv[2]) : 5;
  FLAGS_s2debug = false;
  initGEOS(ignore, ignore);
  std::vector<Country> countries = read_countries(argv[1]);
  leave_out_invalid(countries);
  std::size_t num_corners = 0;
  for (const Country& country : countries) {
    for (const Ring* ring : rings_of(country)) num_corners += ring->size();
  }
  rondel::bench::keep_freed_memory();
  Seconds of_union;
  Seconds of_intersection;
  for (int turn = 0; turn < turns; ++turn) {
    constexpr double step = 0.01;
    const std::vector<Country> input = moved(countries, step * turn);
    unite(input, of_union);
    intersect(input, of_intersection);
  }
  finishGEOS();
  using rondel::bench::median;
  rondel::bench::print_json({{"countries", static_cast<double>(countries.size())},
                             {"corners", static_cast<double>(num_corners)},
                             {"union_rondel", median(of_union.rondel)},
                             {"union_s2", median(of_union.s2)},
                             {"union_geos", median(of_union.geos)},
                             {"intersection_rondel", median(of_intersection.rondel)},
                             {"intersection_s2", median(of_intersection.s2)},
                             {"intersection_geos", median(of_intersection.geos)}});
}
