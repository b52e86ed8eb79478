// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the solid faces as GeoJSON (RFC 7946), each as a feature with the property `sites`, the
// input indices of its corners. Ghost faces are left out: seen from the center they are flat or
// seen from behind, and cover only what other faces cover.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "io/geojson_writer.h"
#include "io/number.h"
#include "io/triangle_formats.h"
#include "map/arc.h"
#include "map/face_map.h"

namespace rondel::io {
namespace {

// Corners as the input has them, in the place of those that unit vectors give back: 10.5 for
// 10.499999999999998. All faces of a site have it in one place.
class GivenCorners {
 public:
  GivenCorners(const map::FaceMap& face_map, const MeshToWrite& mesh)
      : face_map_(face_map), given_(mesh.table.positions) {}

  // Returns the polygons of a face, in `changed` if they change.
  const std::vector<map::LonLatPolygon>& operator()(
      const Triple& face, const std::vector<map::LonLatPolygon>& drawn,
      std::vector<map::LonLatPolygon>& changed) const {
    if (given_.empty()) return drawn;
    changed = drawn;
    for (const Index corner : face) {
      const LonLat& from = face_map_.position(corner);
      const LonLat& to = given_[corner];
      if (from == to || !is_rounding(from, to)) continue;
      for (map::LonLatPolygon& polygon : changed) {
        std::ranges::replace(polygon.ring, from, to);
      }
    }
    return changed;
  }

 private:
  // True if two positions differ by less than what is one place on a map; not so at its edges.
  static bool is_rounding(const LonLat& p, const LonLat& q) {
    constexpr double most = map::merge_distance / 4 * map::degrees_per_radian;
    return std::abs(p.lon_deg - q.lon_deg) <= most && std::abs(p.lat_deg - q.lat_deg) <= most &&
           std::abs(p.lon_deg) < 180 && std::abs(q.lon_deg) < 180 && std::abs(q.lat_deg) < 90;
  }

  const map::FaceMap& face_map_;
  std::span<const LonLat> given_;
};

}  // namespace

void write_geojson(AtomicFile& file, const MeshToWrite& mesh) {
  const map::FaceMap face_map(mesh.triangulation, mesh.execution);
  const GivenCorners given(face_map, mesh);
  Index first_solid = 0;
  while (first_solid < mesh.faces.size() && mesh.is_ghost(first_solid)) {
    ++first_solid;
  }
  file.write(features_begin);
  struct Pens {
    map::FaceMap::Pen drawn;
    map::FaceMap::Pen changed;
  };
  const auto append_feature = [&](std::string& text, Index face, Pens& pens) {
    begin_feature(text, face == first_solid);
    text += R"("sites":[)";
    for (const Index corner : mesh.faces[face]) {
      append_integer(text, corner);
      text += ',';
    }
    text.back() = ']';
    text += geometry_begin;
    const Index drawn = mesh.chosen.empty() ? face : mesh.chosen[face];
    append_geometry(text,
                    given(mesh.faces[face], face_map.polygons(drawn, pens.drawn), pens.changed));
    text += '}';
  };
  mesh.write_faces(file, [&](std::string& text, Index begin, Index end) {
    Pens pens;
    for (Index face = begin; face < end; ++face) {
      if (!mesh.is_ghost(face)) append_feature(text, face, pens);
    }
  });
  file.write(features_end);
}

}  // namespace rondel::io
