// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The steps of rank_build.h, in the order in which run() calls them. Between two of them ranks
// exchange messages through a BspSession, so an exception on one rank ends all of them.

#include "distributed/rank_build.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "distributed/bsp_session.h"
#include "distributed/rank_join.h"
#include "distributed/rank_result.h"

namespace rondel::distributed {
namespace {

// Returns the value of each rank, by rank.
std::vector<std::uint64_t> gather_values(BspSession& session, std::uint64_t value) {
  MessageWriter writer;
  writer.add_value(value);
  std::vector<std::uint64_t> values;
  for (const Bytes& message : session.all_gather(writer.take()))
    values.push_back(MessageReader(message).value<std::uint64_t>());
  return values;
}

std::uint64_t sum(std::span<const std::uint64_t> values) {
  std::uint64_t result = 0;
  for (const std::uint64_t value : values) result += value;
  return result;
}

// The build on one rank. It fills the result step by step; what a step no longer needs is freed.
class RankBuild {
 public:
  RankBuild(BspSession& session, std::span<const Point> mine, const RankLimits& limits,
            const system::Job& options)
      : session_(session),
        mine_(mine),
        limits_(limits),
        options_(options),
        result_(std::make_shared<DistributedTriangulation::Impl>()) {}

  std::shared_ptr<const DistributedTriangulation::Impl> run() {
    counts_ = count_on_ranks(session_, mine_, limits_, options_);
    result_->num_sites = counts_.first_site.back();
    result_->options = options_;
    result_->first_number = limits_.first_number;
    result_->has_points = limits_.keep_points;
    if (limits_.keep_points) result_->landmarks = counts_.all.landmarks();
    triangulate();
    join();
    if (result_->dimension == 2) number();
    finish();
    result_->first_site = std::move(counts_.first_site);
    return std::move(result_);
  }

 private:
  RankBuckets& own() { return result_->own; }

  // Receives the sites of this rank's buckets and triangulates each bucket alone. Throws
  // length_error on all ranks if more sites are open than one rank can join.
  void triangulate() {
    const RankSites sites(session_, mine_, counts_, limits_);
    session_.begin("triangulate");
    const std::size_t first = counts_.plan.first_bucket[session_.rank()];
    own() = triangulate_buckets(sites, counts_, first, counts_.plan.num_buckets(session_.rank()),
                                limits_.keep_points, options_);
    std::uint64_t num_open = 0;
    for (const auto& points : own().open_points) num_open += points.size();
    result_->num_open_sites = sum(gather_values(session_, num_open));
    if (result_->num_open_sites <= max_sites) return;
    throw std::length_error("the faces of " + std::to_string(result_->num_open_sites) + " of " +
                            std::to_string(result_->num_sites) +
                            " sites reach beyond every square; at most " +
                            std::to_string(max_sites) + " can be joined");
  }

  // Sends the open sites and edges to rank 0, which joins them, and takes the part that this rank
  // needs: the faces at its open sites, or below dimension 2, on rank 0, the ring.
  void join() {
    session_.begin("join");
    system::announce(options_, "join", 0);
    std::vector<Bytes> messages(session_.size());
    messages[0] = write_open_buckets(own(), limits_.keep_points);
    own().open_points = {};
    std::vector<Bytes> received = session_.exchange(std::move(messages));
    messages.assign(session_.size(), {});
    if (session_.rank() == 0)
      messages = join_ranks(std::move(received), counts_, limits_.keep_points, options_);
    received = session_.exchange(std::move(messages));
    MessageReader reader(received[0]);
    const auto report = reader.value<JoinedReport>();
    result_->dimension = report.dimension;
    result_->num_ghost_faces = report.num_ghost_faces;
    if (report.dimension == 2) {
      result_->part = read_joined_part(reader, own().open_sites(), own().kept_open_points());
      add_hidden();
    } else if (session_.rank() == 0) {
      result_->ring = reader.values<std::uint64_t>();
      const auto hidden = reader.values<std::uint64_t>();
      own().hidden.insert(own().hidden.end(), hidden.begin(), hidden.end());
      result_->flat_areas = reader.values<SiteArea>();
    }
  }

  // Adds the open sites that no face has to the hidden sites.
  void add_hidden() {
    const JoinedPart& part = result_->part;
    std::vector<bool> is_vertex(part.site_indices.size(), false);
    for (const Triple& face : part.faces.faces) {
      for (const Index s : face) is_vertex[s] = true;
    }
    Index s = part.first_site;
    for (const bulk::Bucket& bucket : own().buckets) {
      for (std::size_t i = 0; i < bucket.border.open_sites.size(); ++i, ++s) {
        if (!is_vertex[s]) own().hidden.push_back(part.site_indices[s]);
      }
    }
  }

  // Numbers the faces that this rank owns, after those of all lower ranks, and tells other ranks
  // the numbers that they need.
  void number() {
    session_.begin("number");
    const JoinedPart& part = result_->part;
    Index first_site = part.first_site;
    Index first_edge = part.first_edge;
    result_->faces.reserve(own().buckets.size());
    for (const bulk::Bucket& bucket : own().buckets) {
      result_->faces.emplace_back(bucket.border, part.faces, first_site, first_edge);
      result_->num_own_faces += result_->faces.back().size();
      first_site += static_cast<Index>(bucket.border.open_sites.size());
      first_edge += static_cast<Index>(bucket.border.open_edges.size());
    }
    const auto num_faces = gather_values(session_, result_->num_own_faces);
    result_->num_faces = sum(num_faces);
    result_->first_face = limits_.first_number + sum(std::span(num_faces).first(session_.rank()));
    result_->numbers = std::make_unique<JoinedNumbers>(part.faces);
    result_->numbers->faces.resize(part.num_faces);
    std::uint64_t next = result_->first_face;
    for (BucketFaces& faces : result_->faces) {
      faces.number(next, *result_->numbers);
      next += faces.size();
    }
    for (const Index f : part.faces.ghost_faces)
      result_->ghost_faces.push_back(result_->numbers->faces[f]);
    std::ranges::sort(result_->ghost_faces);
    tell_numbers();
  }

  // Lists of both ends have the same order, so messages hold numbers alone.
  void tell_numbers() {
    JoinedNumbers& numbers = *result_->numbers;
    std::vector<Bytes> messages(session_.size());
    for (const NumberList& list : result_->part.told) {
      MessageWriter writer;
      for (const Index f : list.faces) writer.add_value(numbers.faces[f]);
      for (const Index e : list.edges) writer.add_value(numbers.at_edge[e]);
      messages[list.rank] = writer.take();
    }
    const std::vector<Bytes> received = session_.exchange(std::move(messages));
    for (const NumberList& list : result_->part.asked) {
      MessageReader reader(received[list.rank]);
      for (const Index f : list.faces) numbers.faces[f] = reader.value<std::uint64_t>();
      for (const Index e : list.edges) numbers.at_edge[e] = reader.value<std::uint64_t>();
    }
    result_->part.told = {};
    result_->part.asked = {};
  }

  // Returns the rank that gave a site.
  [[nodiscard]] std::size_t home_of(std::uint64_t site) const {
    return rank_of_site(site - limits_.first_number, counts_.first_site);
  }

  // Adds the copies that were not scattered to the duplicates: each is at the place of a site that
  // was scattered.
  void add_copies() {
    if (counts_.copies.empty()) return;
    auto& duplicates = result_->duplicates;
    const std::uint64_t first = limits_.first_number + counts_.first_site[session_.rank()];
    std::vector<GlobalDuplicate> merged;
    merged.reserve(duplicates.size() + counts_.copies.size());
    for (const PointCopy& copy : counts_.copies) {
      const std::uint64_t same = first + copy.same;
      const auto known = std::ranges::lower_bound(duplicates, same, {}, &GlobalDuplicate::site);
      const bool is_known = known != duplicates.end() && known->site == same;
      merged.push_back({first + copy.site, is_known ? known->representative : same});
    }
    merged.insert(merged.end(), duplicates.begin(), duplicates.end());
    std::ranges::sort(merged, {}, &GlobalDuplicate::site);
    duplicates = std::move(merged);
    counts_.copies = {};
  }

  // Sends duplicates and hidden sites to the ranks that gave them, and sums the numbers of all
  // ranks.
  void finish() {
    session_.begin("finish");
    const std::uint64_t num_own = own().sites.size();
    std::vector<std::vector<GlobalDuplicate>> duplicates(session_.size());
    std::vector<std::vector<std::uint64_t>> hidden(session_.size());
    for (const GlobalDuplicate& d : own().duplicates) duplicates[home_of(d.site)].push_back(d);
    for (const std::uint64_t site : own().hidden) hidden[home_of(site)].push_back(site);
    std::vector<Bytes> messages(session_.size());
    for (std::size_t rank = 0; rank < session_.size(); ++rank) {
      if (duplicates[rank].empty() && hidden[rank].empty()) continue;
      MessageWriter writer;
      writer.add(duplicates[rank]);
      writer.add(hidden[rank]);
      messages[rank] = writer.take();
    }
    own().duplicates = {};
    own().hidden = {};
    const std::vector<Bytes> received = session_.exchange(std::move(messages));
    for (const Bytes& message : received) {
      if (message.empty()) continue;
      MessageReader reader(message);
      for (const auto& d : reader.values<GlobalDuplicate>()) result_->duplicates.push_back(d);
      for (const auto site : reader.values<std::uint64_t>()) result_->hidden.push_back(site);
    }
    std::ranges::sort(result_->duplicates, {}, &GlobalDuplicate::site);
    add_copies();
    std::ranges::sort(result_->hidden);
    result_->num_duplicates = sum(gather_values(session_, result_->duplicates.size()));
    result_->num_hidden = sum(gather_values(session_, result_->hidden.size()));
    result_->num_vertices = sum(gather_values(session_, num_own)) - result_->num_hidden;
  }

  BspSession& session_;
  std::span<const Point> mine_;
  const RankLimits& limits_;
  const system::Job& options_;
  RankCounts counts_;
  std::shared_ptr<DistributedTriangulation::Impl> result_;
};

}  // namespace

std::shared_ptr<const DistributedTriangulation::Impl> build_on_ranks(Communicator& ranks,
                                                                     std::span<const Point> mine,
                                                                     const RankLimits& limits,
                                                                     const system::Job& options) {
  const system::Call call(options);
  BspSession session(ranks);
  return session.run([&] { return RankBuild(session, mine, limits, options).run(); });
}

}  // namespace rondel::distributed
