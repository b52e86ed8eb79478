// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that property tests share.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "support/generators.h"
#include "support/hull_oracle.h"

namespace rondel::test {

inline Triangulation triangulate(const SiteSet& set, Model model) {
  Options options;
  options.model = model;
  options.sphere = set.sphere;
  return delaunay(set.sites, options);
}

// A named kind, a size, a seed and a model: what RapidCheck chooses and shrinks.
struct Input {
  std::size_t kind;
  std::size_t size;
  std::uint64_t seed;
  Model model;

  [[nodiscard]] const Generator& generator() const { return generators()[kind]; }
  [[nodiscard]] SiteSet make() const {
    return generator().make(generator().has_long_integers ? std::min<std::size_t>(size, 40) : size,
                            seed);
  }
};

inline void showValue(const Input& input, std::ostream& out) {
  out << input.generator().name << " n=" << input.size << " seed=" << input.seed
      << (input.model == Model::projected ? " projected" : " weighted");
}

inline rc::Gen<Input> inputs(std::size_t max_size) {
  return rc::gen::map(
      rc::gen::tuple(
          rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::size_t>(0, generators().size())),
          rc::gen::inRange<std::size_t>(3, max_size), rc::gen::inRange<std::uint64_t>(0, 1000),
          rc::gen::arbitrary<bool>()),
      [](const auto& t) {
        const auto& [kind, size, seed, is_weighted] = t;
        const bool weighted = is_weighted || generators()[kind].weighted_only;
        return Input{kind, size, seed, weighted ? Model::weighted : Model::projected};
      });
}

inline std::vector<std::size_t> random_order(std::size_t size, std::uint64_t seed) {
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random(seed).shuffle(order);
  return order;
}

inline std::set<Triple> face_set(const Triangulation& t, bool solid_only = false) {
  std::set<Triple> faces;
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (!solid_only || !t.is_ghost(f)) faces.insert(lowest_first(t.faces()[f]));
  }
  return faces;
}

// The facets, which do not depend on how ties are broken, each from its lowest corner, reversed if
// wanted.
inline std::set<std::vector<Index>> facets(const Triangulation& t, bool is_reversed = false) {
  const CompressedRows<Index> polygons = merge_cocircular(t);
  std::set<std::vector<Index>> result;
  for (std::size_t i = 0; i + 1 < polygons.offsets.size(); ++i) {
    std::vector<Index> ring(
        polygons.values.begin() + static_cast<std::ptrdiff_t>(polygons.offsets[i]),
        polygons.values.begin() + static_cast<std::ptrdiff_t>(polygons.offsets[i + 1]));
    if (is_reversed) std::reverse(ring.begin() + 1, ring.end());
    result.insert(ring);
  }
  return result;
}

// Whether some conflict test was decided by the perturbation.
inline bool has_ties(const Triangulation& t) { return t.report().rungs.perturbed > 0; }

// Fixed seed and RONDEL_TEST_SCALE times `count` cases.
template <typename Property>
void expect_for_all(std::size_t count, Property&& property) {
  rc::detail::TestParams params;
  params.seed = 2010;
  params.maxSuccess = static_cast<int>(scaled(count));
  const auto result = rc::detail::checkTestable(std::forward<Property>(property),
                                                rc::detail::TestMetadata{}, params);
  std::ostringstream message;
  rc::detail::printResultMessage(result, message);
  EXPECT_TRUE(result.template is<rc::detail::SuccessResult>()) << message.str();
}

}  // namespace rondel::test
