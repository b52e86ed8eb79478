// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "support/simulated_ranks.h"

#include <ctime>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

namespace rondel::test {
namespace {

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

class SimulatedRanks::Rank final : public Communicator {
 public:
  Rank(SimulatedRanks& all, int rank) : all_(all), rank_(rank), cost_(&costs()["begin"]) {
    seconds_ = thread_seconds();
  }

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return all_.size_; }

  std::vector<Bytes> all_gather(Bytes mine) override {
    return exchange(std::vector<Bytes>(static_cast<std::size_t>(size()), mine));
  }

  std::vector<Bytes> exchange(std::vector<Bytes> messages) override {
    if (all_.on_call) all_.on_call(rank_, num_calls_);
    ++num_calls_;
    ++cost_->num_calls;
    const auto self = static_cast<std::size_t>(rank_);
    for (std::size_t r = 0; r < messages.size(); ++r)
      cost_->bytes_sent += r == self ? 0 : messages[r].size();
    return all_.meet(self, std::move(messages));
  }

  void begin(std::string_view phase) override {
    end_phase();
    cost_ = &costs()[std::string(phase)];
    if (all_.on_begin) all_.on_begin(rank_, phase);
  }

  void end_phase() {
    const double now = thread_seconds();
    cost_->cpu_seconds += now - std::exchange(seconds_, now);
  }

 private:
  [[nodiscard]] std::map<std::string, PhaseCost>& costs() {
    return all_.costs_[static_cast<std::size_t>(rank_)];
  }

  SimulatedRanks& all_;
  int rank_;
  PhaseCost* cost_;
  double seconds_ = 0;
  std::uint64_t num_calls_ = 0;
};

std::vector<std::string> SimulatedRanks::run(const std::function<void(Communicator&)>& work) {
  const auto num_ranks = static_cast<std::size_t>(size_);
  costs_.assign(num_ranks, {});
  given_.assign(num_ranks, {});
  received_.assign(num_ranks, {});
  num_there_ = 0;
  num_gone_ = 0;
  std::vector<std::string> errors(num_ranks);
  std::vector<std::thread> threads;
  threads.reserve(num_ranks);
  // No rank begins before all have a thread: what one does must not make the start of another fail.
  std::unique_lock start(mutex_);
  for (std::size_t r = 0; r < num_ranks; ++r) {
    threads.emplace_back([this, r, &errors, &work] {
      {
        std::unique_lock lock(mutex_);
        take_turn(lock);
      }
      try {
        Rank rank(*this, static_cast<int>(r));
        work(rank);
        rank.end_phase();
      } catch (const std::exception& error) {
        errors[r] = error.what();
      }
      leave();
    });
  }
  start.unlock();
  for (std::thread& thread : threads) thread.join();
  return errors;
}

void SimulatedRanks::take_turn(std::unique_lock<std::mutex>& lock) {
  changed_.wait(lock, [this] { return !is_turn_taken_; });
  is_turn_taken_ = true;
}

std::vector<Communicator::Bytes> SimulatedRanks::meet(std::size_t rank,
                                                      std::vector<Bytes> messages) {
  std::unique_lock lock(mutex_);
  given_[rank] = std::move(messages);
  if (++num_there_ == size_) {
    for (std::size_t to = 0; to < received_.size(); ++to) {
      received_[to].clear();
      for (auto& given : given_) received_[to].push_back(std::move(given[to]));
    }
    num_there_ = 0;
    ++num_meetings_;
    changed_.notify_all();
  } else {
    const std::uint64_t meeting = num_meetings_;
    is_turn_taken_ = false;
    changed_.notify_all();
    changed_.wait(lock, [&] { return num_meetings_ != meeting || num_gone_ != 0; });
    const bool has_met = num_meetings_ != meeting;
    take_turn(lock);
    if (!has_met) throw std::runtime_error("a rank has gone");
  }
  return std::move(received_[rank]);
}

void SimulatedRanks::leave() {
  const std::lock_guard lock(mutex_);
  is_turn_taken_ = false;
  ++num_gone_;
  changed_.notify_all();
}

std::uint64_t SimulatedRanks::bytes_sent(std::string_view phase) const {
  std::uint64_t result = 0;
  for (const auto& of_rank : costs_) {
    const auto found = of_rank.find(std::string(phase));
    if (found != of_rank.end()) result += found->second.bytes_sent;
  }
  return result;
}

std::uint64_t SimulatedRanks::bytes_sent() const {
  std::uint64_t result = 0;
  for (const auto& of_rank : costs_) {
    for (const auto& [phase, cost] : of_rank) result += cost.bytes_sent;
  }
  return result;
}

double SimulatedRanks::cpu_seconds() const {
  double result = 0;
  for (const auto& of_rank : costs_) {
    for (const auto& [phase, cost] : of_rank) result += cost.cpu_seconds;
  }
  return result;
}

}  // namespace rondel::test
