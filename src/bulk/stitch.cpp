// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/stitch.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include "bulk/seam_faces.h"
#include "system/large_arrays.h"
#include "system/parallel.h"
#include "topology/canonical_order.h"
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

// A face of a block that is not moved in place: its final name, and what it had before.
struct Copied {
  Index final;
  Triple corners;
  Triple neighbors;
};

// The faces that the sites of some blocks own, of these blocks and of the seam. Their final names
// are begin ... end-1.
struct Section {
  std::span<const BlockResult> blocks;
  Index begin = 0;
  Index end = 0;
  Index sites_begin = 0;  // seam sites
  Index sites_end = 0;
  std::vector<Run> runs;  // from and to places of this section, in the order of both names
  std::vector<Copied> copied;
};

// A seam site of a square: which faces it owns, by their final names, if some of its faces are open.
struct OpenSite {
  bool is_open = false;
  Index faces_begin = 0;
  Index faces_end = 0;
};

// Puts the faces of one section in canonical order, and copies those that others will be written
// over.
class Numbering {
 public:
  // Writes final names by preliminary ones to `final_of`, and where the faces of open sites are.
  Numbering(const SeamFaces& seam, Section& section, LargeVector<Index>& final_of,
            std::span<OpenSite> open)
      : seam_(seam), section_(section), final_of_(final_of), open_(open), next_(section.begin) {}

  // Returns false if they do not fit.
  bool run() {
    Index s = section_.sites_begin;
    for (const BlockResult& block : section_.blocks) {
      Index face = block.faces_begin;
      for (const SeamSite& site : block.seam_sites) {
        append(face, site.faces_begin);
        if (!open_.empty() && open_[s].is_open) {
          append_open(s++);
        } else {
          append_owned(s++);
        }
        face = site.faces_end;
      }
      append(face, block.faces_end);
    }
    return next_ == section_.end;
  }

 private:
  // Faces of the block.
  void append(Index begin, Index end) {
    std::iota(final_of_.begin() + begin, final_of_.begin() + end, next_);
    const Index first = std::clamp(section_.begin, begin, end);
    const Index last = std::clamp(section_.end, first, end);
    for (Index f = begin; f < first; ++f) copy(f);
    if (first < last) section_.runs.push_back({first, last, final_of_[first]});
    for (Index f = last; f < end; ++f) copy(f);
    next_ += end - begin;
  }

  void copy(Index face) {
    section_.copied.push_back({final_of_[face], seam_.corners(face), seam_.neighbors(face)});
  }

  // The faces that seam site s owns, those of its block and those of the seam.
  void append_owned(Index s) {
    const SeamSite& site = seam_.sites()[s];
    const auto of_seam = seam_.owned_by(s);
    if (of_seam.empty()) return append(site.faces_begin, site.faces_end);
    faces_.clear();
    if (site.faces_begin == site.faces_end && seam_.are_in_order()) {
      faces_.assign(of_seam.begin(), of_seam.end());
    } else {
      walk_around(site.rank, of_seam[0]);
    }
    topology::start_with_first(faces_, [this](Index f) { return seam_.corners(f)[1]; });
    for (const Index f : faces_) {
      final_of_[f] = next_++;
      if (f < seam_.names_begin()) copy(f);
    }
  }

  // Does the same for a site of which not all faces are known; the faces are appended as they come.
  void append_open(Index s) {
    const SeamSite& site = seam_.sites()[s];
    open_[s].faces_begin = next_;
    append(site.faces_begin, site.faces_end);
    for (const Index f : seam_.owned_by(s)) final_of_[f] = next_++;
    open_[s].faces_end = next_;
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
  Section& section_;
  LargeVector<Index>& final_of_;
  std::span<OpenSite> open_;  // by seam site, or empty
  Index next_;
  std::vector<Index> faces_;
};

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

// Seam sites that are on no face of the seam have no face at all.
void list_hidden(const SeamFaces& seam, std::span<const Index> names, unsigned threads,
                 TriangulationArrays& arrays) {
  constexpr std::size_t grain = 4096;
  const std::size_t num_sites = seam.sites().size();
  std::vector<unsigned char> is_vertex(num_sites, 0);
  system::parallel_for(threads, num_sites, grain, [&](std::size_t begin, std::size_t end) {
    for (const Index f : seam.owned_by(static_cast<Index>(begin), static_cast<Index>(end))) {
      for (const Index v : seam.seam_corners(f))
        std::atomic_ref(is_vertex[v]).store(1, std::memory_order_relaxed);
    }
  });
  for (std::size_t s = 0; s < num_sites; ++s) {
    if (is_vertex[s] == 0) arrays.hidden.push_back({names[seam.sites()[s].rank], no_index});
  }
  std::ranges::sort(arrays.hidden, {}, &Hidden::site);
}

// Calls work(section) for all sections, in parallel.
template <class Work>
void for_each(std::vector<Section>& sections, unsigned threads, Work work) {
  system::parallel_for(threads, sections.size(), 1,
                       [&](std::size_t i, std::size_t /*end*/) { work(sections[i]); });
}

// Makes as few sections as keep the threads busy, since faces near their ends are copied. The
// sections are still empty.
std::vector<Section> make_sections(std::span<const BlockResult> results, const SeamFaces& seam,
                                   unsigned threads) {
  const std::size_t num_sections = threads == 1 ? 1 : 4 * std::size_t{threads};
  const std::size_t num_blocks = system::num_pieces(results.size(), num_sections);
  std::vector<Section> sections;
  Section next;
  for (; !results.empty(); results = results.subspan(next.blocks.size())) {
    next.blocks = results.first(std::min(num_blocks, results.size()));
    for (const BlockResult& block : next.blocks) {
      next.sites_end += static_cast<Index>(block.seam_sites.size());
      next.end += block.faces_end - block.faces_begin;
    }
    next.end += static_cast<Index>(seam.owned_by(next.sites_begin, next.sites_end).size());
    sections.push_back(next);
    next.begin = next.end;
    next.sites_begin = next.sites_end;
  }
  return sections;
}

// Names all faces and puts them where they belong. Returns their final names, or none if the parts do
// not fit. Neighbors may be missing if sites are open.
template <bool is_open>
LargeVector<Index> put_in_order(const SeamFaces& seam, std::span<const Index> names,
                                std::span<OpenSite> open, unsigned threads,
                                std::vector<Section> sections, TriangulationArrays& arrays) {
  LargeVector<Index> final_of(seam.names_end());
  std::atomic<bool> fits = true;
  for_each(sections, threads, [&](Section& section) {
    if (!Numbering(seam, section, final_of, open).run()) fits = false;
  });
  if (!fits) return {};
  const auto final_name = [&](Index f) {
    return is_open && f == no_index ? no_index : final_of[f];
  };
  for_each(sections, threads, [&](const Section& section) {
    const auto put = [&](const Triple& v, const Triple& n, Index to) {
      arrays.faces[to] = {names[v[0]], names[v[1]], names[v[2]]};
      arrays.neighbors[to] = {final_name(n[0]), final_name(n[1]), final_name(n[2])};
    };
    move_runs(section.runs,
              [&](Index from, Index to) { put(arrays.faces[from], arrays.neighbors[from], to); });
    for (const Copied& face : section.copied) put(face.corners, face.neighbors, face.final);
    for (const Index f : seam.owned_by(section.sites_begin, section.sites_end))
      put(seam.corners(f), seam.neighbors(f), final_of[f]);
  });
  arrays.faces.resize(sections.back().end);
  arrays.neighbors.resize(sections.back().end);
  arrays.dimension = 2;
  return final_of;
}

}  // namespace

bool stitch(std::span<const BlockResult> results, const SeamFaces& seam,
            std::span<const Index> names, unsigned threads, TriangulationArrays& arrays) {
  list_hidden(seam, names, threads, arrays);
  const std::size_t expected = 2 * (names.size() - arrays.hidden.size()) - 4;
  std::vector<Section> sections = make_sections(results, seam, threads);
  if (sections.back().end != expected) return false;
  const auto final_of = put_in_order<false>(seam, names, {}, threads, std::move(sections), arrays);
  if (final_of.empty()) return false;
  for (const Index f : seam.ghost_faces()) arrays.ghost_faces.push_back(final_of[f]);
  std::ranges::sort(arrays.ghost_faces);
  return true;
}

std::vector<SeamSite> stitch_open(std::span<const BlockResult> results, const SeamFaces& seam,
                                  std::span<const Index> names, unsigned threads, OpenSeam& open,
                                  TriangulationArrays& arrays) {
  std::vector<OpenSite> open_sites(seam.sites().size());
  for (const Index s : open.seam_sites) open_sites[s].is_open = true;
  const auto final_of = put_in_order<true>(seam, names, open_sites, threads,
                                           make_sections(results, seam, threads), arrays);
  for (SeamEdge& edge : open.edges) edge.face = final_of[edge.face];
  std::vector<SeamSite> sites;
  for (const Index s : open.seam_sites)
    sites.push_back({seam.sites()[s].rank, open_sites[s].faces_begin, open_sites[s].faces_end});
  return sites;
}

}  // namespace rondel::bulk
