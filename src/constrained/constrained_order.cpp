// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces are dealt to their owners, which are counted before. If few have changed, what is between
// the faces of owners that have one of these, or had one, moves up or down as a whole or stays. The
// faces of such an owner are put in order by a walk around it.

#include "constrained/constrained_order.h"

#include <algorithm>
#include <utility>

#include "system/large_arrays.h"
#include "system/parallel.h"
#include "system/row_assembly.h"
#include "topology/mesh.h"

namespace rondel::constrained {
namespace {

using topology::next_corner;

bool is_solid(std::uint8_t state) { return (state & ghost_face) == 0; }

// Puts the faces of an owner in order, counterclockwise from the first one: that with the earlier
// second corner, or the solid one if two have the same. rank(corner) is the rank of a corner.
template <class Faces, class Rank>
void sort_around(const Faces& all, const Rank& rank, std::span<Index> own) {
  if (own.size() < 2) return;
  const auto starts_before = [&](Index g, Index h) {
    const Index v = rank(all.faces[g][1]);
    const Index w = rank(all.faces[h][1]);
    return v != w ? v < w : is_solid(all.states[g]) && !is_solid(all.states[h]);
  };
  std::ranges::iter_swap(own.begin(), std::ranges::min_element(own, starts_before));
  if (own.size() == 2) return;
  Index f = own[0];
  const Index v = all.faces[f][0];
  unsigned corner = 0;
  for (std::size_t found = 1; found < own.size();) {
    f = all.neighbors[f][next_corner[corner]];
    corner = topology::corner_of(all.faces[f], v);
    if (corner == 0) own[found++] = f;
  }
}

void renumber(std::vector<Index>& faces, std::span<const Index> place) {
  for (Index& f : faces) f = place[f];
  std::ranges::sort(faces);
}

// Returns the faces in canonical order.
LargeVector<Index> order_of(const FacesToOrder& all) {
  system::RowPlaces<Index> places(all.names.size());
  for (const Triple& face : all.faces) places.count(face[0]);
  places.sum();
  LargeVector<Index> order(all.faces.size());
  for (Index f = 0; f < order.size(); ++f) order[places.place(all.faces[f][0])] = f;
  const std::vector<Index> offsets = std::move(places).offsets();
  for (Index v = 0; v < all.names.size(); ++v) {
    if (all.is_touched[v] == 0) continue;
    const std::size_t size = offsets[v + 1] - offsets[v];
    sort_around(
        all, [](Index rank) { return rank; }, std::span(order).subspan(offsets[v], size));
  }
  return order;
}

// Faces that follow each other, within which those move that have not changed.
struct FaceRange {
  Index begin;
  Index end;
};

// Finds the places of faces of which some have changed.
class PlacesOfFaces {
 public:
  // The changed faces are sorted.
  PlacesOfFaces(const FacesInPlace& all, std::span<const ChangedFace> changed)
      : all_(all), changed_(changed), place_(all.faces.size()) {}

  void find() {
    std::vector<ChangedFace> taken;  // with their owners now, by these
    taken.reserve(changed_.size());
    for (const ChangedFace& c : changed_) taken.push_back({c.face, owner_now(c.face)});
    std::ranges::sort(taken, {}, &ChangedFace::owner);
    auto left = changed_.begin();
    auto next = taken.begin();
    while (next != taken.end() || left != changed_.end()) {
      const Index owner = std::min(left != changed_.end() ? left->owner : no_index,
                                   next != taken.end() ? next->owner : no_index);
      skip_to(owner, left != changed_.end() ? left->face : static_cast<Index>(place_.size()));
      if (next_ == face_) begin_ = face_;
      own_.clear();
      for (; face_ < place_.size() && owner_before(face_) == owner; ++face_) {
        if (!is_changed(face_)) own_.push_back(face_);
      }
      while (left != changed_.end() && left->owner == owner) ++left;
      for (; next != taken.end() && next->owner == owner; ++next) own_.push_back(next->face);
      sort_around(
          all_, [this](Index corner) { return all_.ranks[corner]; }, std::span(own_));
      for (const Index f : own_) place_[f] = next_++;
      if (next_ == face_) ranges_.push_back({begin_, face_});
    }
    for (; face_ < place_.size(); ++face_) place_[face_] = face_;
  }

  [[nodiscard]] std::span<const Index> places() const { return place_; }

  // Moves the values of faces to the places of these.
  template <class Value>
  void move(std::span<Value> values) const {
    std::vector<Value> of_changed;
    of_changed.reserve(changed_.size());
    for (const ChangedFace& c : changed_) of_changed.push_back(values[c.face]);
    std::vector<Value> before;
    for (const auto& [begin, end] : ranges_) {
      before.assign(values.begin() + begin, values.begin() + end);
      for (Index f = begin; f < end; ++f) {
        if (!is_changed(f)) values[place_[f]] = before[f - begin];
      }
    }
    for (std::size_t i = 0; i < changed_.size(); ++i) {
      values[place_[changed_[i].face]] = of_changed[i];
    }
  }

 private:
  [[nodiscard]] bool is_changed(Index f) const { return (all_.states[f] & changed_face) != 0; }
  [[nodiscard]] Index owner_now(Index f) const { return all_.ranks[all_.faces[f][0]]; }
  [[nodiscard]] Index owner_before(Index f) const {
    if (!is_changed(f)) return owner_now(f);
    return std::ranges::lower_bound(changed_, f, {}, &ChangedFace::face)->owner;
  }

  // Places the faces of the owners before this one, which have not changed. The bound is a face of
  // this owner or a later one.
  void skip_to(Index owner, Index bound) {
    Index low = face_;
    Index high = bound;
    for (Index step = 1; high > low; step *= 2) {
      const Index f = high - std::min(high - low, step);
      if (owner_before(f) < owner) {
        low = f + 1;
        break;
      }
      high = f;
    }
    while (low < high) {
      const Index middle = low + (high - low) / 2;
      if (owner_before(middle) < owner) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    while (face_ < low) place_[face_++] = next_++;
  }

  const FacesInPlace& all_;
  std::span<const ChangedFace> changed_;
  LargeVector<Index> place_;
  std::vector<FaceRange> ranges_;
  Index face_ = 0;   // the first one without a place, of those that have not changed
  Index next_ = 0;   // the first place without a face
  Index begin_ = 0;  // of the range, where these differ
  std::vector<Index> own_;
};

}  // namespace

void write_in_order(const FacesToOrder& all, unsigned threads, TriangulationArrays& arrays,
                    std::vector<std::uint8_t>& sides) {
  const LargeVector<Index> order = order_of(all);
  LargeVector<Index> place(order.size());
  for (Index i = 0; i < order.size(); ++i) place[order[i]] = i;
  arrays.faces.resize(order.size());
  arrays.neighbors.resize(order.size());
  sides.resize(order.size());
  constexpr std::size_t grain = 16384;
  system::parallel_for(threads, order.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Index f = order[i];
      for (unsigned j = 0; j < 3; ++j) {
        arrays.faces[i][j] = all.names[all.faces[f][j]];
        arrays.neighbors[i][j] = place[all.neighbors[f][j]];
      }
      sides[i] = all.sides[f];
    }
  });
  renumber(arrays.ghost_faces, place);
}

void put_in_order(const FacesInPlace& all, unsigned threads, std::vector<ChangedFace>& changed,
                  std::vector<Index>& ghost_faces) {
  if (changed.empty()) return;
  std::ranges::sort(changed, {}, &ChangedFace::face);
  PlacesOfFaces found(all, changed);
  found.find();
  const std::span<const Index> place = found.places();
  constexpr std::size_t grain = 16384;
  system::parallel_for(threads, place.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (Triple& neighbors : all.neighbors.subspan(begin, end - begin)) {
      for (Index& neighbor : neighbors) neighbor = place[neighbor];
    }
  });
  found.move(all.faces);
  found.move(all.neighbors);
  found.move(all.sides);
  renumber(ghost_faces, place);
}

}  // namespace rondel::constrained
