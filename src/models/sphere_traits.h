// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What algorithms ask of the sites: the paper's traits class. Sites are named by an index, in a
// build by their spatial rank. Traits hold sites in the forms that predicates read, and decide
// nothing: predicates/conflict.h and predicates/orientation.h do, with the traits as their source of
// points.
//
// There are two models of both concepts, ProjectedPoints (the paper, section 4.1) and WeightedPoints
// (section 4.2). They differ in the side of a site with respect to a face, circle or plane, and in
// what follows from it: weighted sites can be hidden.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include "predicates/conflict.h"
#include "rondel/types.h"

namespace rondel::models {

// What walks, conflict regions and insertions read. query::Target has it, too: the sites of a model
// and one more point.
template <class T>
concept SphereTraits = predicates::PointSource<T> && requires(const T& sites, Index a) {
  // Whether an insertion can turn a vertex, or the new site, into a hidden site.
  { T::hides_sites } -> std::convertible_to<bool>;
  // The number of distinct sites, which are 0, 1, ...
  { sites.size() } -> std::same_as<Index>;
  // Site a, and the vector from the center to it, in doubles: for walks, which may guess.
  { sites.coordinates(a) } -> std::same_as<predicates::Vector>;
  { sites.from_center(a) } -> std::same_as<predicates::Vector>;
};

// What builds and triangulations that change ask beyond this: sites that are stored. They are
// input[order[0]], input[order[1]], ...; both arrays outlive the model.
template <class T>
concept SphereModel = SphereTraits<T> && std::default_initializable<T> &&
    requires(T& sites, const T& stored, Index a, std::size_t room, std::span<const Point> input,
             std::span<const Index> order, const Point& center) {
  // Takes all sites, in the memory that is there.
  sites.assign(input, order, center);
  // Says that the arrays have moved or grown, and are otherwise what they were.
  sites.rebind(input, order);
  // Says that site a has become input[order[a]], for a <= size(), and does as rebind does.
  sites.set(a, input, order);
  // Says that what was site order[i] becomes site i, for all i, and that there are no others.
  // Makes room for this many. rebind follows.
  sites.reorder(order, room);
  // Asks for the memory of coordinates(a).
  stored.prefetch(a);
};

// Stored sites that can all move at once.
template <class T>
concept MovingSphereModel = SphereModel<T> &&
    requires(T& sites, unsigned threads, std::span<const Point> input,
             std::span<const Index> order) {
  // Says that all sites may have become other points of these arrays. Returns the largest square of
  // the length by which from_center() of a site a has changed, of those where in_use[a], the third
  // argument, is there and not no_index.
  { sites.move_all(input, order, order, threads) } -> std::same_as<double>;
};

}  // namespace rondel::models
