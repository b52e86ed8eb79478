// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Builds by ranks: together they have what delaunay(), areas() and circumcenters() find, whatever the sites,
// their shares, the squares and the rounds; and where the work of a rank fails, all fail with the same line.
#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "fuzz/block_sites.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/distributed.h"
#include "support/simulated_ranks.h"

namespace rondel::fuzz {
namespace {

// Hands all to another communicator, and fails when so many phases have begun.
class FailingRanks final : public Communicator {
 public:
  FailingRanks(Communicator& ranks, unsigned max_phases, bool& has_failed)
      : ranks_(ranks), max_phases_(max_phases), has_failed_(has_failed) {}

  [[nodiscard]] int rank() const override { return ranks_.rank(); }
  [[nodiscard]] int size() const override { return ranks_.size(); }
  std::vector<Bytes> all_gather(Bytes mine) override { return ranks_.all_gather(std::move(mine)); }
  std::vector<Bytes> exchange(std::vector<Bytes> messages) override {
    return ranks_.exchange(std::move(messages));
  }
  void begin(std::string_view phase) override {
    ranks_.begin(phase);
    if (num_phases_++ != max_phases_) return;
    has_failed_ = true;
    throw std::runtime_error("as it was told");
  }

 private:
  Communicator& ranks_;
  unsigned max_phases_;
  bool& has_failed_;
  unsigned num_phases_ = 0;
};

struct Shares {
  std::vector<std::size_t> begin;  // of each rank, and behind the last one
  DistributedOptions options;
  unsigned failing_rank;
  unsigned max_phases;  // of that one
};

template <class T>
void append(std::span<const T> part, std::vector<T>& all) {
  all.insert(all.end(), part.begin(), part.end());
}

template <class Row>
std::vector<GlobalTriple> widened(std::span<const Row> rows) {
  std::vector<GlobalTriple> result;
  for (const Row& row : rows) result.push_back({row[0], row[1], row[2]});
  return result;
}

void require_totals(const DistributedTriangulation& part, const Triangulation& expected) {
  require(part.dimension() == expected.dimension(), "the dimension");
  require(part.num_sites() == expected.num_sites(), "the sites");
  require(part.num_vertices() == expected.num_vertices(), "the vertices");
  require(part.num_faces() == expected.num_faces(), "the number of faces");
  require(part.num_ghost_faces() == expected.num_ghost_faces(), "the number of ghost faces");
  require(part.num_duplicates() == expected.duplicates().size(), "the number of duplicates");
  require(part.num_hidden() == expected.hidden().size(), "the number of hidden sites");
  require(part.num_open_sites() <= part.num_sites(), "the open sites");
}

template <class T>
bool are_same_bits(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

void require_parts(std::span<const std::optional<DistributedTriangulation>> parts,
                   std::span<const double> all_areas, const Triangulation& expected) {
  std::vector<GlobalTriple> faces;
  std::vector<GlobalTriple> neighbors;
  std::vector<std::uint64_t> ghost_faces;
  std::vector<std::uint64_t> ring;
  std::vector<std::uint64_t> hidden;
  std::vector<std::uint64_t> owned;
  std::vector<GlobalDuplicate> duplicates;
  std::vector<Point> centers;
  for (const auto& part : parts) {
    require_totals(*part, expected);
    if (part->dimension() == 2) require(part->first_face() == faces.size(), "the first face");
    part->visit_faces([&](std::span<const GlobalTriple> rows) { append(rows, faces); });
    part->visit_neighbors([&](std::span<const GlobalTriple> rows) { append(rows, neighbors); });
    require(part->first_face() + part->num_own_faces() == faces.size(), "the rank's faces");
    part->visit_circumcenters([&](std::span<const Point> rows) { append(rows, centers); });
    append(part->ghost_faces(), ghost_faces);
    append(part->ring(), ring);
    append(part->hidden(), hidden);
    append(part->owned_sites(), owned);
    append(part->duplicates(), duplicates);
  }
  require(faces == widened(expected.faces()), "the faces");
  require(neighbors == widened(expected.neighbors()), "the neighbors");
  require(std::ranges::equal(ghost_faces, expected.ghost_faces()), "the ghost faces");
  require(std::ranges::equal(ring, expected.ring()), "the ring");
  require(std::ranges::equal(hidden, expected.hidden(), {}, {}, &Hidden::site), "the hidden sites");
  require(std::ranges::equal(duplicates, expected.duplicates(),
                             [](const GlobalDuplicate& a, const Duplicate& b) {
                               return a.site == b.site && a.representative == b.representative;
                             }),
          "the duplicates");
  require(are_same_bits<Point>(centers, circumcenters(expected)), "the circumcenters");
  require(are_same_bits<double>(all_areas, areas(expected)), "the areas");
  std::ranges::sort(owned);
  require(std::ranges::adjacent_find(owned) == owned.end(), "a site has one owner");
}

void test_ranks(const SiteSet& set, const Options& options, const Shares& shares) {
  const std::size_t num_ranks = shares.begin.size() - 1;
  std::vector<std::optional<DistributedTriangulation>> parts(num_ranks);
  std::vector<std::vector<double>> areas_of(num_ranks);
  std::vector<int> failed(num_ranks, -1);
  bool has_failed = false;  // ranks run one at a time
  test::SimulatedRanks ranks(static_cast<int>(num_ranks));
  const auto errors = ranks.run([&](Communicator& of_rank) {
    const auto r = static_cast<std::size_t>(of_rank.rank());
    FailingRanks rank(of_rank, r == shares.failing_rank ? shares.max_phases : 1000, has_failed);
    const auto mine =
        std::span(set.sites).subspan(shares.begin[r], shares.begin[r + 1] - shares.begin[r]);
    try {
      parts[r] = delaunay(rank, mine, shares.options, options, {.threads = 1});
      areas_of[r] = areas(rank, *parts[r], {.threads = 1});
    } catch (const DistributedError& error) {
      failed[r] = error.rank();
    }
  });
  for (const std::string& error : errors) require(error.empty(), error);
  if (has_failed) {
    for (const int rank : failed)
      require(rank == static_cast<int>(shares.failing_rank), "one rank fails, and so do all");
  } else {
    std::vector<double> all_areas;
    for (const auto& part : areas_of) append(std::span<const double>(part), all_areas);
    require_parts(parts, all_areas, delaunay(set.sites, options));
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  const std::uint8_t mode = source.byte();
  fuzz::Shares shares;
  const std::size_t num_ranks = 1 + source.below(6);
  shares.options = {1 + source.below(300), 1 + source.below(60), true};
  shares.failing_rank = source.byte();  // mostly none of them
  shares.max_phases = static_cast<unsigned>(source.below(8));
  std::vector<std::size_t> cuts;
  for (std::size_t i = 1; i < num_ranks; ++i) cuts.push_back(source.below(fuzz::max_num_sites));
  const Model model = mode % 2 == 0 ? Model::weighted : Model::projected;
  const test::SiteSet set = fuzz::block_sites(source, model);
  for (std::size_t& cut : cuts) cut = std::min(cut, set.sites.size());
  std::ranges::sort(cuts);
  shares.begin.push_back(0);
  shares.begin.insert(shares.begin.end(), cuts.begin(), cuts.end());
  shares.begin.push_back(set.sites.size());
  fuzz::test_ranks(set, {.model = model, .sphere = set.sphere}, shares);
  return 0;
}
