// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the solid faces as GeoJSON (RFC 7946), each as a feature with the property `sites`, the
// input indices of its corners. Ghost faces are left out: seen from the center they are flat or
// seen from behind, and cover only what other faces cover.
#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

#include "io/geojson_writer.h"
#include "io/number.h"
#include "io/triangle_formats.h"
#include "map/face_map.h"

namespace rondel::io {

void write_geojson(AtomicFile& file, const MeshToWrite& mesh) {
  const map::FaceMap face_map(mesh.triangulation, mesh.execution);
  Index first_solid = 0;
  while (first_solid < mesh.faces.size() && mesh.is_ghost(first_solid)) {
    ++first_solid;
  }
  file.write(features_begin);
  std::atomic<std::size_t> num_without{0};  // faces without a geometry
  const auto append_feature = [&](std::string& text, Index face, map::FaceMap::Pen& pen) {
    begin_feature(text, face == first_solid);
    text += R"("sites":[)";
    for (const Index corner : mesh.faces[face]) {
      append_integer(text, corner);
      text += ',';
    }
    text.back() = ']';
    text += geometry_begin;
    const std::vector<map::LonLatPolygon>& polygons =
        face_map.polygons(mesh.chosen.empty() ? face : mesh.chosen[face], pen);
    if (polygons.empty()) ++num_without;
    append_geometry(text, polygons);
    text += '}';
  };
  mesh.write_faces(file, [&](std::string& text, Index begin, Index end) {
    map::FaceMap::Pen pen;
    for (Index face = begin; face < end; ++face) {
      if (!mesh.is_ghost(face)) append_feature(text, face, pen);
    }
  });
  file.write(features_end);
  if (num_without == 0 || mesh.remarks == nullptr) return;
  const std::size_t num_faces = mesh.faces.size() - mesh.ghost_faces.size();
  mesh.remarks->push_back(
      std::to_string(num_without) + " of " + std::to_string(num_faces) +
      (num_without == 1 ? " triangles has no geometry: it is"
                        : " triangles have no geometry: they are") +
      " narrower than sides are precise, or two corners round to opposite places");
}

}  // namespace rondel::io
