// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The canonical order of the faces that a tree has found, from nothing but the ranks of their
// corners.

#include <algorithm>
#include <map>
#include <numeric>

#include "order/spatial_order.h"
#include "property/seam_tree.h"

namespace rondel::test {

// The faces around v that v owns, counterclockwise from the one with the lowest second corner. The
// ring of v takes all of its faces; `faces` are these, turned so that v comes first.
std::vector<Index> SeamTree::owned_in_order(Index v, std::span<const Index> faces,
                                            std::span<const Index> rank) const {
  const auto corner_after = [&](Index f, unsigned steps) {
    const auto at = std::ranges::find(faces_[f], v) - faces_[f].begin();
    return faces_[f][(static_cast<unsigned>(at) + steps) % 3];
  };
  std::map<Index, Index> next;  // from the second corner of a face, which names the face here
  std::vector<Index> owned;
  for (const Index f : faces) {
    next[corner_after(f, 1)] = f;
    if (rank[v] < std::min(rank[corner_after(f, 1)], rank[corner_after(f, 2)])) owned.push_back(f);
  }
  std::ranges::sort(owned, {}, [&](Index f) { return rank[corner_after(f, 1)]; });
  if (owned.empty()) return owned;
  const auto is_owned = [&](Index f) { return std::ranges::find(owned, f) != owned.end(); };
  if (weakened_ == Weakened::owned_faces) {
    // One run of owned faces after the other, by their first corners: the ring of v is not known.
    std::erase_if(next, [&](const auto& entry) { return !is_owned(entry.second); });
    std::vector<Index> starts = owned;
    std::erase_if(starts, [&](Index f) {
      return f != owned.front() && std::ranges::any_of(owned, [&](Index g) {
               return corner_after(g, 2) == corner_after(f, 1);
             });
    });
    // The run that ends where the first one starts comes last.
    std::stable_partition(starts.begin(), starts.end(), [&](Index f) {
      if (f == owned.front()) return true;
      for (auto at = next.find(corner_after(f, 1)); at != next.end();
           at = next.find(corner_after(at->second, 2))) {
        if (at->second == owned.front()) return false;
      }
      return true;
    });
    std::vector<Index> result;
    for (const Index f : starts) {
      auto at = next.find(corner_after(f, 1));
      while (at != next.end() && (at->second == f || at->second != owned.front())) {
        result.push_back(at->second);
        if (result.size() == owned.size()) return result;
        at = next.find(corner_after(at->second, 2));
      }
    }
    return result;
  }
  std::vector<Index> result;
  Index f = owned.front();
  do {
    if (is_owned(f)) result.push_back(f);
    f = next.at(corner_after(f, 2));
  } while (f != owned.front());
  return result;
}

void SeamTree::compare_arrays() {
  auto [order, duplicates, renamed] =
      order::spatial_order(input_.sites, input_.model, {0, 0, 0}, 1);
  order::rename(order, renamed);
  std::vector<Index> rank(input_.sites.size(), no_index);
  for (Index r = 0; r < order.size(); ++r) rank[order[r]] = r;
  std::map<Index, std::vector<Index>> around;  // by rank
  for (Index f = 0; f < faces_.size(); ++f) {
    for (const Index v : faces_[f]) around[rank[v]].push_back(f);
  }
  std::vector<Index> listed;
  for (const auto& [r, faces] : around) {
    const auto owned = owned_in_order(order[r], faces, rank);
    listed.insert(listed.end(), owned.begin(), owned.end());
  }
  std::vector<Index> number(faces_.size(), no_index);
  for (Index i = 0; i < listed.size(); ++i) number[listed[i]] = i;
  for (Index i = 0; i < listed.size(); ++i) {
    const Index f = listed[i];
    const Triple& expected = whole_.faces()[i];
    const auto turn =
        static_cast<unsigned>(std::ranges::find(faces_[f], expected[0]) - faces_[f].begin());
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned at = (turn + k) % 3;
      if (faces_[f][at] != expected[k]) wrong_result_ = "another order of faces";
      if (neighbors_[f][at] == no_index || number[neighbors_[f][at]] != whole_.neighbors()[i][k])
        wrong_result_ = "other neighbors";
    }
  }
}

}  // namespace rondel::test
