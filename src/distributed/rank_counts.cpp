// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/rank_counts.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "api/validation.h"
#include "distributed/bucket_cuts.h"
#include "distributed/site_counts.h"

namespace rondel::distributed {
namespace {

// A square has at most a twentieth of a rank's share, so that no rank has 5 % more than its share.
constexpr std::uint64_t squares_of_rank = 20;

// Returns how many sites a square may have: a part of the share of a rank, at most a bucket's.
std::uint64_t max_square_sites(std::uint64_t num_sites, std::size_t num_ranks,
                               std::uint64_t max_bucket_sites) {
  const std::uint64_t share =
      num_ranks == 1 ? num_sites : num_sites / (squares_of_rank * num_ranks);
  return std::clamp<std::uint64_t>(share, 1, max_bucket_sites);
}

// Returns the least depth with which uniform sites need one round.
int depth_for(std::size_t num_ranks) {
  int depth = 3;
  while (depth < BucketCounts::usual_depth &&
         (std::size_t{6} << (2 * depth)) < 16 * squares_of_rank * num_ranks) {
    ++depth;
  }
  return depth;
}

// Returns where the slice of a rank begins, if all ranks add up a slice of `size` values.
std::size_t slice_begin(std::size_t size, std::size_t rank, std::size_t num_ranks) {
  return size / num_ranks * rank + std::min(rank, size % num_ranks);
}

class RankCounter {
 public:
  RankCounter(BspSession& session, std::span<const Point> mine, const RankLimits& limits,
              const system::Job& options)
      : session_(session), mine_(mine), limits_(limits), options_(options) {}

  RankCounts run() {
    session_.begin("count");
    find_first_sites();
    look_at_sites();
    bool needs_round = true;
    while (needs_round) {
      system::obey_stop();
      const auto received = session_.exchange(slices_of_counts());
      read(session_.all_gather(sum_slices(received)));
      needs_round = counts_->end_round();
    }
    result_.plan = plan_ranks(counts_->cuts(), session_.size(), limits_.max_bucket_sites);
    return std::move(result_);
  }

 private:
  // Tells the number of sites to all ranks, so that each knows the index of its first one.
  void find_first_sites() {
    api::validate(options_, 0);
    MessageWriter writer;
    writer.add_value<std::uint64_t>(mine_.size());
    const auto received = session_.all_gather(writer.take());
    result_.first_site.push_back(0);
    for (const Bytes& message : received) {
      MessageReader reader(message);
      result_.first_site.push_back(result_.first_site.back() + reader.value<std::uint64_t>());
    }
  }

  // Checks the sites and computes their keys. If several ranks have invalid sites, the exception of
  // the lowest rank is thrown everywhere, and so the first invalid site is reported.
  void look_at_sites() {
    constexpr std::size_t cached_sites = std::size_t{1} << 15;  // a piece that fits the cache, as
                                                                // memory is slow
    result_.all = bulk::AllSites(options_);
    result_.keys.resize(mine_.size());
    for (std::size_t begin = 0; begin < mine_.size(); begin += cached_sites) {
      const std::size_t size = std::min(cached_sites, mine_.size() - begin);
      const auto sites = mine_.subspan(begin, size);
      api::validate_some(sites, options_, result_.first_site[session_.rank()] + begin);
      result_.all.add(sites);
      find_keys(sites, options_, std::span(result_.keys).subspan(begin, size));
    }
    result_.copies = find_copies(mine_, options_.threads);
    remove_copies();
    counts_.emplace(
        max_square_sites(result_.first_site.back(), session_.size(), limits_.max_bucket_sites),
        depth_for(session_.size()));
  }

  void remove_copies() {
    if (result_.copies.empty()) return;
    auto copy = result_.copies.begin();
    std::size_t num_kept = 0;
    for (std::size_t i = 0; i < result_.keys.size(); ++i) {
      if (copy != result_.copies.end() && copy->site == i) {
        ++copy;
      } else {
        result_.keys[num_kept++] = result_.keys[i];
      }
    }
    result_.keys.resize(num_kept);
  }

  // Counts the sites of this rank, and returns for each rank the slice of counts that it adds up.
  std::vector<Bytes> slices_of_counts() {
    counts_->add(result_.keys);
    const std::vector<std::uint64_t> counts = counts_->counts_of_round();
    num_counts_ = counts.size();
    std::vector<Bytes> messages;
    for (std::size_t rank = 0; rank < session_.size(); ++rank) {
      const std::size_t begin = slice_begin(num_counts_, rank, session_.size());
      const std::size_t end = slice_begin(num_counts_, rank + 1, session_.size());
      MessageWriter writer;
      writer.add_values(std::span(counts).subspan(begin, end - begin));
      messages.push_back(writer.take());
    }
    return messages;
  }

  // Returns the sums of one slice over all ranks, with what is known of all sites.
  [[nodiscard]] Bytes sum_slices(std::span<const Bytes> received) const {
    const std::size_t begin = slice_begin(num_counts_, session_.rank(), session_.size());
    const std::size_t end = slice_begin(num_counts_, session_.rank() + 1, session_.size());
    std::vector<std::uint64_t> sums(end - begin, 0);
    std::vector<std::uint64_t> counts(sums.size());
    for (const Bytes& message : received) {
      MessageReader(message).read_values(std::span(counts));
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += counts[i];
    }
    MessageWriter writer;
    writer.add_value(result_.all);
    writer.add_values(std::span<const std::uint64_t>(sums));
    return writer.take();
  }

  // Puts the slices of sums together; each rank then goes on with the same counts.
  void read(std::span<const Bytes> received) {
    std::vector<std::uint64_t> counts(num_counts_);
    for (std::size_t rank = 0; rank < received.size(); ++rank) {
      const std::size_t begin = slice_begin(num_counts_, rank, session_.size());
      const std::size_t end = slice_begin(num_counts_, rank + 1, session_.size());
      MessageReader reader(received[rank]);
      result_.all.add(reader.value<bulk::AllSites>());
      reader.read_values(std::span(counts).subspan(begin, end - begin));
    }
    counts_->set_counts_of_round(counts);
  }

  BspSession& session_;
  std::span<const Point> mine_;
  const RankLimits& limits_;
  const system::Job& options_;
  std::optional<BucketCounts> counts_;
  std::size_t num_counts_ = 0;
  RankCounts result_;
};

}  // namespace

RankCounts count_on_ranks(BspSession& session, std::span<const Point> mine,
                          const RankLimits& limits, const system::Job& options) {
  return RankCounter(session, mine, limits, options).run();
}

}  // namespace rondel::distributed
