// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Converts the polygons of files into cells, and their lines into arcs.
//
// in    features with rings and lines of longitudes and latitudes
// out   a cell and lines for each feature
// index features
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "map/polygon_features.h"
#include "overlay/plane_arcs.h"
#include "overlay/plane_sweep.h"
#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/polygon_files.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The cells and lines of features.
struct ConvertedFeatures {
  CellRings cells;
  CompressedRows<PlaneSide> sides;  // what arcs stand for, as in CellTable; no rows if geodesic
  FeatureLines lines;               // divided together with the sides of the cells
  std::vector<CellFacts> facts;     // of each file
};

// Converts all features. The facts have the faults of features that were repaired, and remarks on
// these and on features that rounding of their corners has left without an area. Throws FileError
// for polygons that bound no region, with the feature, the ring and a place, and for lines that do
// not tell which way they go, unless they are to be repaired.
ConvertedFeatures converted_features(map::PolygonFeatures& features, const PolygonOptions& options,
                                     const Execution& execution);

// Whether someone reads what is wrong with features that are repaired. It may take as long to find as
// the repair.
enum class FaultTexts : std::uint8_t {
  full,
  brief,  // a fault is known to be there, and not always where
};

// Returns the cells of converted_features() alone, or throws as that does.
CellRings cells_of_features(map::PolygonFeatures& features, const PolygonOptions& options,
                            const Execution& execution);

// Returns for each feature what is wrong with it, or an empty text.
std::vector<std::string> faults_of_features(const map::PolygonFeatures& features,
                                            const PolygonOptions& options,
                                            const Execution& execution);

// --- the steps, one file each ---

// Detects rings around a pole that straight lines in longitude and latitude do not represent.
//
// index sides of a ring: side k leads from corner k to the next one
// Returns the index of the only side of a ring that spans more than 180 degrees of longitude, for a
// ring on one side of the equator: if this side led the other way round, the ring would go around
// the pole. Returns nothing if there is no such side, or if it lies at the pole, or if it is
// between two sides along meridians as a side of a box is.
std::optional<std::size_t> lone_long_side(std::span<const LonLat> ring);

// A side that spans more than 180 degrees of longitude and less than a turn, not at a pole.
struct LongSide {
  std::size_t feature;
  std::size_t ring;
  LonLat from, to;
};

// Returns the sides of features that go the long way around the globe, as a box does that was meant
// to cross the antimeridian.
std::vector<LongSide> long_sides(const map::PolygonFeatures& features);

// Adds a remark to each file whose polygons have such sides. Those of rings that were told to go the
// shorter way are none.
void tell_of_long_sides(const std::vector<LongSide>& sides, const map::PolygonFeatures& features,
                        std::vector<CellFacts>& facts);

// Adds corners to neighboring features where only one of them has a corner on their common border.
//
// Inserts corners into sides of rings: those of other features and of lines that lie on the side up
// to rounding, and those of the same feature that lie there after a shift by 360 degrees. Inserts
// all corners into lines. Sides are then straight only up to rounding, and neighbors have the same
// corners. Positions that are equal but for the rounding of a turn of the globe become equal
// before. A ring that is so thin that it may run to and fro after that keeps its former positions
// in `thin_positions`. Returns the features of which sides meet in corners that were inserted, with
// the rings that they had before: where sides cross in such a corner, they touch after that.
struct FeatureBefore {
  std::size_t feature;
  std::vector<map::LonLatRing> rings;
};
std::vector<FeatureBefore> share_corners(map::PolygonFeatures& features, unsigned threads);

// --- lines of features; a side of more than 180 degrees of longitude goes the shorter way around
// --- the globe

// Throws FeatureFault for a line of a feature that has such a side, unless it is to be repaired, or
// that is more than ten turns of the globe away.
void require_lines(const map::PolygonFeatures& features, std::size_t feature, bool is_repaired);

// Appends the sides of all lines. A line in one place has one side without a length.
void append_line_sides(const map::PolygonFeatures& features, std::vector<PlaneSide>& sides);

// Returns lines of divided sides, of which the first one is side `first`.
FeatureLines divided_lines(const map::PolygonFeatures& features, const DividedSides& divided,
                           std::size_t first);

// Returns lines along great circles. Throws FeatureFault for a side between opposite places.
FeatureLines geodesic_lines(const map::PolygonFeatures& features);

// Positions may be this many turns of the globe away.
constexpr double max_turns = 10;

// Returns "longitude latitude" in degrees, with 10 significant digits.
std::string text_of_place(const LonLat& place);
std::string text_of_place(const Point& place);

// Returns a name for a ring of a feature, such as "ring 0 of part 2" for the shell of the third
// polygon.
std::string ring_name(const std::vector<map::LonLatRing>& rings, Index ring);

// A feature that is not valid, and what is wrong with it.
class FeatureFault : public FileError {
 public:
  FeatureFault(const std::string& message, std::size_t feature, std::string fault)
      : FileError(message), feature_(feature), fault_(std::move(fault)) {}
  [[nodiscard]] std::size_t feature() const { return feature_; }
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  std::size_t feature_;
  std::string fault_;
};

// Throws FeatureFault with the name of the file, the feature and what is wrong with it.
[[noreturn]] void refuse_feature(const map::PolygonFeatures& features, std::size_t feature,
                                 const std::string& what);

// Returns cells whose sides are great circles, of which cell i is feature i. A ring of a shell is
// around its smaller side, and a hole is around the part that it removes.
//
// 1. Sides of a feature that lead back and forth between two corners cancel. A feature whose parts
//    cover the sphere is in `whole`.
// 2. FileError is thrown for a ring whose sides all cancel, for holes that leave nothing of their
//    polygon, for parts that overlap, and for sides of a feature that cross.
CellRings geodesic_cells(const map::PolygonFeatures& features, const Execution& execution,
                         FaultTexts texts = FaultTexts::full);

// A ring of arcs, and the positions of its corners.
struct GeodesicRing {
  std::vector<LonLat> positions;
  std::vector<Point> corners;
};

// Returns a ring oriented with the inside of its polygon to the left, so that a shell is around its
// smaller side.
GeodesicRing geodesic_ring(const map::LonLatRing& ring);

// True if a feature with geodesic sides is valid at first sight: its rings touch neither each other
// nor themselves, and agree on what is inside. False says nothing.
bool is_plainly_valid(std::span<const map::LonLatRing> rings, const Execution& execution);

// Returns the cell of such a feature, as geodesic_cells() does; or nothing, which says nothing.
std::optional<CellRings> plain_cell(std::span<const map::LonLatRing> rings,
                                    const Execution& execution);

// Throws FileError if a hole of the feature is outside of its polygon or in another hole.
void refuse_geodesic_holes(const map::PolygonFeatures& features, std::size_t feature,
                           const Execution& execution);

}  // namespace rondel::overlay
