// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// check and Triangulation::from_arrays: any list of triangles gives a verdict, and only the
// triangulation is accepted.
#include <algorithm>
#include <set>
#include <utility>

#include "fuzz/fuzz_input.h"
#include "rondel/check.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "support/other_surfaces.h"

namespace rondel::fuzz {
namespace {

std::vector<Triple> normalized(std::vector<Triple> faces) {
  for (Triple& face : faces) {
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
  }
  std::ranges::sort(faces);
  return faces;
}

void change(std::vector<Triple>& faces, ByteSource& source, std::size_t num_sites) {
  const std::size_t f = source.below(faces.size());
  switch (source.byte() % 8) {
    case 0:
      faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(f));
      break;
    case 1:
      faces.push_back(faces[f]);
      break;
    case 2:
      std::swap(faces[f][0], faces[f][1]);
      break;
    case 3:
      faces[f][source.below(3)] = source.byte();
      break;
    case 4: {  // one site takes the part of another everywhere
      const auto from = static_cast<Index>(source.below(num_sites));
      const auto to = static_cast<Index>(source.below(num_sites));
      for (Triple& face : faces) std::ranges::replace(face, from, to);
      break;
    }
    default:
      test::flip_edge(faces, f, source.below(3));
  }
}

// Whether each side of a face is that of one other face, the other way round.
bool is_closed(const std::vector<Triple>& faces) {
  std::set<std::pair<Index, Index>> sides;
  for (const Triple& f : faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!sides.emplace(f[i], f[(i + 1) % 3]).second) return false;
    }
  }
  return std::ranges::all_of(sides, [&](const auto& side) {
    return sides.contains({side.second, side.first});
  });
}

// Whether the arrays of `built`, with these faces instead of its own, are taken.
bool are_taken(const Triangulation& built, const std::vector<Triple>& faces,
               const Options& options) {
  const TriangulationParts parts = {.dimension = built.dimension(),
                                    .faces = faces,
                                    .neighbors = built.neighbors(),
                                    .ghost_faces = built.ghost_faces(),
                                    .ring = built.ring(),
                                    .duplicates = built.duplicates(),
                                    .hidden = built.hidden()};
  try {
    const Triangulation taken = Triangulation::from_arrays(built.sites(), parts, options);
    return std::ranges::equal(taken.faces(), faces);
  } catch (const InvalidInput&) {
    return false;
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  Options options;
  options.model = source.byte() % 2 == 0 ? Model::projected : Model::weighted;
  const std::size_t num_changes = source.below(8);
  std::vector<std::uint8_t> changes(3 * num_changes);
  for (std::uint8_t& byte : changes) byte = source.byte();
  const fuzz::Scales scales = fuzz::next_scales(source);
  options.sphere = fuzz::next_sphere(source, scales);
  const std::vector<Point> sites = fuzz::all_sites(source, 14, scales, options);

  const Triangulation built = delaunay(sites, options);
  std::vector<Triple> faces(built.faces().begin(), built.faces().end());
  fuzz::ByteSource how(changes.data(), changes.size());
  while (!how.is_empty() && !faces.empty()) fuzz::change(faces, how, sites.size());
  const bool is_right =
      fuzz::normalized(faces) == fuzz::normalized({built.faces().begin(), built.faces().end()});
  const CheckReport report = check(sites, faces, options);
  fuzz::require(report.is_valid == is_right, is_right
                                                 ? "the triangulation is accepted: " + report.reason
                                                 : "only the triangulation is accepted");
  const bool are_taken = fuzz::are_taken(built, faces, options);
  fuzz::require(are_taken || !std::ranges::equal(faces, built.faces()), "own arrays are taken");
  fuzz::require(!are_taken || fuzz::is_closed(faces),
                "arrays that are taken form a closed surface");
  fuzz::require(report.is_valid == report.reason.empty(), "a refusal has a reason");
  fuzz::require(report.reason.find('\n') == std::string::npos, "a reason is one line");
  return 0;
}
