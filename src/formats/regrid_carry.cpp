// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_carry.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "rondel/remap.h"
#include "rondel/weights.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel::formats {
namespace {

constexpr double missing_value = std::numeric_limits<double>::quiet_NaN();

template <class T>
void add_bytes(std::span<const T> values, RegridRanks::Message& message) {
  const auto bytes = std::as_bytes(values);
  message.insert(message.end(), bytes.begin(), bytes.end());
}

// Takes so many values from the begin of a message.
template <class T>
std::vector<T> take_values(std::size_t count, std::span<const std::byte>& message) {
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), message.data(), count * sizeof(T));
  message = message.subspan(count * sizeof(T));
  return values;
}

}  // namespace

void deal_units(const RegridRanks& ranks, std::size_t first, std::size_t end,
                const std::function<RegridRanks::Message(std::size_t)>& compute,
                const std::function<void(std::size_t, std::span<const std::byte>)>& take) {
  for (std::size_t begin = first; begin < end; begin += ranks.size) {
    const std::size_t own = begin + ranks.rank;
    RegridRanks::Message message;
    if (own < end) message = compute(own);
    const std::vector<RegridRanks::Message> messages = ranks.gather(std::move(message));
    for (std::size_t r = 0; r < messages.size() && begin + r < end; ++r) {
      take(begin + r, messages[r]);
    }
  }
}

// The values of one or several fields at the sources, as far as a tile needs them: read when they
// are asked for if sources are between parallels, and otherwise once.
class TileCarrier::SourceValues {
 public:
  SourceValues(const ArrayToCarry& job, std::size_t first, std::size_t count,
               const Execution& execution)
      : job_(job), first_(first), components_(job.file.components(job.array)) {
    if (job.has_windows) return;
    whole_.resize(count * components_ * job.sources);
    job.file.read(job.array, first, whole_, execution);
    for (std::size_t row = 0; job.areas_of_sources != nullptr && row < count; ++row) {
      job.areas_of_sources->divide(0, std::span(whole_).subspan(row * job.sources, job.sources));
    }
    take_values_that_are_there(job.coincident, job.sources, whole_);
  }
  // Returns the values of all fields at all sources, unless they are read when they are asked for.
  [[nodiscard]] std::span<const double> whole() const { return whole_; }
  // Returns the values of a component of a field at the sources from `begin` on; the first component
  // is asked for first.
  std::span<const double> of(std::size_t field, std::size_t component, std::size_t begin,
                             std::size_t count) {
    if (!whole_.empty()) {
      const std::size_t row = field * components_ + component;
      return std::span(whole_).subspan(row * job_.sources + begin, count);
    }
    if (component == 0) {
      window_.resize(components_ * count);
      job_.file.read_points(job_.array, first_ + field, begin, window_);
      if (job_.areas_of_sources != nullptr) job_.areas_of_sources->divide(begin, window_);
    }
    return std::span(window_).subspan(component * count, count);
  }

 private:
  const ArrayToCarry& job_;
  std::size_t first_;
  std::size_t components_;
  std::vector<double> whole_;
  std::vector<double> window_;
};

TileCarrier::TileCarrier(const RegridTiles& tiles, const RegridPlan& plan, const ArrayToCarry& job,
                         RegridOutput& out, const RegridRanks& ranks, const Execution& execution)
    : tiles_(tiles), plan_(plan), job_(job), out_(out), ranks_(ranks), execution_(execution) {}

void TileCarrier::run() {
  std::size_t first = out_.skip_fields(job_.num_fields, job_.targets);
  while (first < job_.num_fields) {
    const std::size_t count = std::min(plan_.fields_at_once, job_.num_fields - first);
    carry_group(first, count);
    first += count;
  }
}

void TileCarrier::carry_group(std::size_t first, std::size_t count) {
  std::size_t begin = 0;
  while (plan_.is_streamed && begin < tiles_.num_tiles() && out_.skip(tiles_.num_targets(begin))) {
    ++begin;
  }
  SourceValues values(job_, first, count, execution_);
  const std::size_t num_rows = count * job_.file.components(job_.array);
  std::vector<double> carried;
  if (ranks_.is_first() && !plan_.is_streamed) {
    carried.assign(num_rows * job_.targets, missing_value);
  }
  const auto take = [&](std::size_t number, std::span<const Index> targets,
                        std::span<const double> found) {
    if (plan_.is_streamed) {
      out_.write(job_.file.at_targets(job_.array, {found.begin(), found.end()}, targets));
    } else {
      for (std::size_t k = 0; k < found.size(); ++k) {
        carried[k / targets.size() * job_.targets + targets[k % targets.size()]] = found[k];
      }
    }
    system::announce(execution_, "regrid", first * tiles_.num_tiles() + count * (number + 1),
                     job_.num_fields * tiles_.num_tiles());
  };
  if (ranks_.size == 1) {
    for_tiles(begin, tiles_.num_tiles(), [&](std::size_t number, RemapTile& tile) {
      take(number, tile.targets, values_at(tile, values, count));
    });
  } else {
    const auto compute = [&](std::size_t number) {
      RegridRanks::Message message;
      for_tiles(number, number + 1, [&](std::size_t, RemapTile& tile) {
        add_bytes(std::span<const Index>(tile.targets), message);
        add_bytes(std::span<const double>(values_at(tile, values, count)), message);
      });
      return message;
    };
    deal_units(ranks_, begin, tiles_.num_tiles(), compute,
               [&](std::size_t number, std::span<const std::byte> message) {
                 const std::size_t num_targets = tiles_.num_targets(number);
                 const auto targets = take_values<Index>(num_targets, message);
                 take(number, targets, take_values<double>(num_rows * num_targets, message));
               });
  }
  if (plan_.is_streamed) return;
  if (job_.complete && ranks_.is_first()) job_.complete(values.whole(), carried);
  out_.write(job_.file.at_targets(job_.array, std::move(carried)));
}

// The values of the sources of the part follow each other there.
std::vector<double> TileCarrier::applied_second(RemapTile& tile, SourceValues& values,
                                                std::size_t num_rows,
                                                const ApplyOptions& rules) const {
  const std::size_t components = job_.file.components(job_.array);
  std::vector<double> result(num_rows * tile.targets.size(), missing_value);
  if (tile.sources.empty()) return result;
  std::vector<double> in;
  in.reserve(num_rows * tile.sources.size());
  for (std::size_t row = 0; row < num_rows; ++row) {
    const auto window =
        values.of(row / components, row % components, tile.first_source, tile.weights.num_columns);
    for (const Index source : tile.sources) in.push_back(window[source - tile.first_source]);
  }
  SecondOrderRemap weights(std::move(tile.part), covered_enough(tile.fractions, job_.max_missing));
  weights.apply(in, result, rules, execution_);
  return result;
}

std::vector<double> TileCarrier::values_at(RemapTile& tile, SourceValues& values,
                                           std::size_t count) const {
  std::vector<double> result = applied(tile, values, count);
  if (job_.areas_of_sources == nullptr) return result;
  const std::vector<double> areas = areas_of_sums(tile.areas, tile.fractions, job_.norm);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] *= areas[k % areas.size()];
  return result;
}

std::vector<double> TileCarrier::applied(RemapTile& tile, SourceValues& values,
                                         std::size_t count) const {
  const std::size_t num_targets = tile.targets.size();
  const std::size_t components = job_.file.components(job_.array);
  std::vector<double> result(count * components * num_targets);
  const ApplyOptions rules{
      .fill = missing_value, .max_missing = job_.max_missing, .keeps_sums = job_.keeps_sums};
  const std::vector<std::int32_t> covered = covered_enough(tile.fractions, job_.max_missing);
  if (tile.part.order == 2) return applied_second(tile, values, count * components, rules);
  for (std::size_t row = 0; row < count * components; ++row) {
    const auto out = std::span(result).subspan(row * num_targets, num_targets);
    const auto in =
        values.of(row / components, row % components, tile.first_source, tile.weights.num_columns);
    if (job_.is_largest_share) {
      apply_largest_share(tile.weights, in, out, 1, rules, execution_);
    } else {
      apply(tile.weights, in, out, 1, rules, execution_);
    }
    for (std::size_t r = 0; r < covered.size(); ++r) {
      if (covered[r] == 0) out[r] = missing_value;
    }
  }
  return result;
}

// Where several tiles are in memory at a time, each thread computes one.
void TileCarrier::for_tiles(std::size_t begin, std::size_t end,
                            const std::function<void(std::size_t, RemapTile&)>& visit) const {
  std::vector<RemapTile> tiles(std::min(plan_.tiles_at_once, end - begin));
  for (std::size_t first = begin; first < end; first += tiles.size()) {
    const std::size_t count = std::min(tiles.size(), end - first);
    if (tiles.size() == 1) {
      tiles[0] = tiles_.tile(first, execution_);
    } else {
      system::parallel_for(execution_.threads, count, 1, [&](std::size_t k, std::size_t /*end*/) {
        tiles[k] = tiles_.tile(first + k, {.threads = 1});
      });
    }
    for (std::size_t k = 0; k < count; ++k) {
      visit(first + k, tiles[k]);
      tiles[k] = {};
    }
  }
}

}  // namespace rondel::formats
