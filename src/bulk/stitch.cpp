// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/stitch.h"

#include <algorithm>
#include <utility>

#include "bulk/seam_faces.h"
#include "rondel/large_vector.h"
#include "system/parallel.h"
#include "topology/mesh.h"

namespace rondel::bulk {
namespace {

using topology::next_corner;

// Preliminary names begin ... end-1 become final, final + 1, ...
struct Run {
  Index begin;
  Index end;
  Index final;
};

// Puts all faces in canonical order.
class Numbering {
 public:
  Numbering(std::span<const BlockResult> results, const SeamFaces& seam) : seam_(seam) {
    Index site = 0;
    for (const BlockResult& block : results) {
      Index face = block.faces_begin;
      for (const SeamSite& s : block.seam_sites) {
        append(face, s.faces_begin);
        append_owned(site++);
        face = s.faces_end;
      }
      append(face, block.faces_end);
    }
  }

  // Of faces of the blocks, in their order.
  [[nodiscard]] std::span<const Run> block_runs() const { return block_runs_; }
  // Of single faces of the blocks that come later than in their order, since the owner's first face
  // is one of the seam.
  [[nodiscard]] std::span<const Run> late_runs() const { return late_runs_; }
  // Of single faces of the seam.
  [[nodiscard]] std::span<const Run> seam_runs() const { return seam_runs_; }
  [[nodiscard]] Index num_faces() const { return num_faces_; }

 private:
  void append(Index begin, Index end) {
    if (begin == end) return;
    runs_of(begin).push_back({begin, end, num_faces_});
    num_faces_ += end - begin;
  }

  std::vector<Run>& runs_of(Index face) {
    if (face >= seam_.names_begin()) return seam_runs_;
    return block_runs_.empty() || block_runs_.back().begin < face ? block_runs_ : late_runs_;
  }

  // Those of seam site s, from blocks and seam. The faces that a site owns start with the one with
  // the smallest second corner.
  void append_owned(Index s) {
    const SeamSite& site = seam_.sites()[s];
    const auto of_seam = seam_.owned_by(s);
    if (of_seam.empty()) return append(site.faces_begin, site.faces_end);
    faces_.clear();
    if (site.faces_begin == site.faces_end) {
      faces_.assign(of_seam.begin(), of_seam.end());
    } else {
      walk_around(site.rank, of_seam[0]);
    }
    const auto second = [this](Index f) { return seam_.corners(f)[1]; };
    std::rotate(faces_.begin(), std::ranges::min_element(faces_, {}, second), faces_.end());
    for (const Index f : faces_) append(f, f + 1);
  }

  // Lists the faces that the site of this rank owns, counterclockwise from one of them.
  void walk_around(Index rank, Index start) {
    Index f = start;
    do {
      const Triple v = seam_.corners(f);
      const auto corner = static_cast<unsigned>(std::ranges::find(v, rank) - v.begin());
      if (corner == 0) faces_.push_back(f);
      f = seam_.neighbors(f)[next_corner[corner]];
    } while (f != start);
  }

  const SeamFaces& seam_;
  std::vector<Run> block_runs_;
  std::vector<Run> late_runs_;
  std::vector<Run> seam_runs_;
  std::vector<Index> faces_;
  Index num_faces_ = 0;
};

// Calls piece(run) for all runs, in parallel.
template <class Piece>
void for_runs(std::span<const Run> runs, unsigned threads, Piece piece) {
  constexpr std::size_t grain = 1024;
  system::parallel_for(threads, runs.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) piece(runs[i]);
  });
}

// Calls move(f, g) for all faces of the runs, preliminary and final name, so that no face is moved
// to where another one waits. The order of the runs does not change, so no run moves over one that
// moves the other way; of those that move the same way, the one in front goes first.
template <class Move>
void move_runs(std::span<const Run> runs, Move move) {
  const auto move_down = [&move](const Run& run) {
    for (Index f = run.begin; f < run.end; ++f) move(f, run.final + (f - run.begin));
  };
  const auto move_up = [&move](const Run& run) {
    for (Index f = run.end; f > run.begin; --f) move(f - 1, run.final + (f - 1 - run.begin));
  };
  for (std::size_t i = 0; i < runs.size();) {
    std::size_t end = i;
    while (end < runs.size() && runs[end].final > runs[end].begin) ++end;
    for (std::size_t j = end; j > i; --j) move_up(runs[j - 1]);
    for (i = end; i < runs.size() && runs[i].final <= runs[i].begin; ++i) move_down(runs[i]);
  }
}

// Seam sites that are on no face of the region have no face at all.
void list_hidden(const SeamFaces& seam, std::span<const Index> names, TriangulationArrays& arrays) {
  std::vector<bool> is_vertex(seam.sites().size(), false);
  const Index first = seam.names_begin();
  for (Index s = 0; s < seam.sites().size(); ++s) {
    for (const Index f : seam.owned_by(s)) {
      for (const Index v : seam.seam_corners(f - first)) is_vertex[v] = true;
    }
  }
  for (Index s = 0; s < seam.sites().size(); ++s) {
    if (!is_vertex[s]) arrays.hidden.push_back({names[seam.sites()[s].rank], no_index});
  }
  std::ranges::sort(arrays.hidden, {}, &Hidden::site);
}

// The number of every face when all are in their places, by its number before.
LargeVector<Index> final_numbers(const Numbering& numbering, std::size_t num_faces,
                                 unsigned threads) {
  LargeVector<Index> final_of(num_faces);
  const auto set_final = [&](const Run& run) {
    for (Index f = run.begin; f < run.end; ++f) final_of[f] = run.final + (f - run.begin);
  };
  for_runs(numbering.block_runs(), threads, set_final);
  for_runs(numbering.late_runs(), threads, set_final);
  for_runs(numbering.seam_runs(), threads, set_final);
  return final_of;
}

}  // namespace

bool stitch(std::span<const BlockResult> results, TriangulationArrays seam_arrays,
            std::span<const Index> names, unsigned threads, TriangulationArrays& arrays) {
  const SeamFaces seam(results, {arrays.faces, arrays.neighbors}, std::move(seam_arrays));
  list_hidden(seam, names, arrays);
  const std::size_t expected = 2 * (names.size() - arrays.hidden.size()) - 4;
  if (!seam.fits()) return false;
  const Numbering numbering(results, seam);
  if (numbering.num_faces() != expected) return false;

  const Index names_begin = seam.names_begin();
  const auto final_of = final_numbers(numbering, names_begin + seam.num_all(), threads);
  LargeVector<Triple>& faces = arrays.faces;
  LargeVector<Triple>& neighbors = arrays.neighbors;
  const auto set_face = [&](const Triple& v, Index to) {
    faces[to] = {names[v[0]], names[v[1]], names[v[2]]};
  };
  const auto set_neighbors = [&](const Triple& n, Index to) {
    neighbors[to] = {final_of[n[0]], final_of[n[1]], final_of[n[2]]};
  };
  struct Late {
    Triple corners;
    Triple neighbors;
  };
  std::vector<Late> late;
  for (const Run& run : numbering.late_runs())
    late.push_back({faces[run.begin], neighbors[run.begin]});
  if (threads == 1) {
    move_runs(numbering.block_runs(), [&](Index from, Index to) {
      set_face(faces[from], to);
      set_neighbors(neighbors[from], to);
    });
  } else {
    for_runs(numbering.block_runs(), threads, [&](const Run& run) {
      for (Index f = run.begin; f < run.end; ++f) {
        set_face(faces[f], f);
        set_neighbors(neighbors[f], f);
      }
    });
    const auto move_all = [&](LargeVector<Triple>& values) {
      move_runs(numbering.block_runs(), [&](Index from, Index to) { values[to] = values[from]; });
    };
    system::parallel_invoke(
        threads, [&] { move_all(faces); }, [&] { move_all(neighbors); });
  }
  for (std::size_t i = 0; i < late.size(); ++i) {
    set_face(late[i].corners, numbering.late_runs()[i].final);
    set_neighbors(late[i].neighbors, numbering.late_runs()[i].final);
  }
  for_runs(numbering.seam_runs(), threads, [&](const Run& run) {
    set_face(seam.corners(run.begin), run.final);
    set_neighbors(seam.neighbors(run.begin), run.final);
  });
  arrays.faces.resize(expected);
  arrays.neighbors.resize(expected);
  arrays.dimension = 2;
  for (const Index f : seam.ghost_faces()) {
    if (seam.is_inside(f)) arrays.ghost_faces.push_back(final_of[names_begin + f]);
  }
  std::ranges::sort(arrays.ghost_faces);
  return true;
}

}  // namespace rondel::bulk
