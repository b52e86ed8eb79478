// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/query.h"

#include <algorithm>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "api/dynamic_impl.h"
#include "api/validation.h"
#include "dynamic/query_engine.h"
#include "query/batch.h"
#include "query/directory.h"
#include "query/distance.h"
#include "query/engine.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel {
namespace {

using query::Cursor;
using Limit = std::optional<predicates::Cosine>;

void check_angle(double angle) {
  if (angle >= 0) return;
  throw InvalidInput("the angle " + api::text(angle) + " is negative or not a number", 0);
}

// No limit from 180 degrees on.
Limit limit_of(double angle) {
  if (angle >= std::numbers::pi) return std::nullopt;
  return predicates::cosine_of(angle);
}

// The answers of one range of queries.
struct RangeLists {
  std::span<const Index> queries;
  std::vector<std::uint64_t> ends;
  std::vector<Index> sites;
};

}  // namespace

class Locator::Impl {
 public:
  // `ids`, if any, name the sites.
  explicit Impl(const Triangulation& triangulation, std::vector<Index> ids = {})
      : model_(triangulation.model()),
        sphere_(triangulation.sphere()),
        sites_(triangulation.sites()) {
    auto directory =
        std::make_unique<query::BuiltDirectory>(triangulation, sites_.points(), std::move(ids));
    engine_ = query::make_engine(triangulation, sites_.points(), directory->vertices());
    directory_ = std::move(directory);
  }

  template <models::SphereModel T>
  Impl(const dynamic::Editor<T>& editor, const Options& options)
      : model_(options.model),
        sphere_(options.sphere),
        directory_(std::make_unique<dynamic::HullDirectory<T>>(editor)),
        engine_(std::make_unique<dynamic::HullEngine<T>>(editor, sphere_)) {}

  void validate(std::span<const Point> queries) const {
    api::validate_queries(queries, sphere_.center);
  }
  void validate_site(Index site) const {
    if (directory_->has_site(site)) return;
    throw InvalidInput("there is no site " + std::to_string(site), site);
  }

  [[nodiscard]] bool is_empty() const { return engine_ == nullptr; }
  [[nodiscard]] const query::Engine& engine() const { return *engine_; }
  [[nodiscard]] const Sphere& sphere() const { return sphere_; }
  [[nodiscard]] Model model() const { return model_; }
  [[nodiscard]] Point site(Index i) const { return directory_->site(i); }
  [[nodiscard]] Index vertex_of(Index site) const { return directory_->vertex_of(site); }

  [[nodiscard]] Cursor cursor_at(const Point& p) const {
    Cursor cursor;
    cursor.vertex = directory_->near(p);
    return cursor;
  }
  template <class Answer>
  void for_each_query(std::span<const Point> queries, unsigned threads,
                      const Answer& answer) const {
    const auto sorted = query::sort_queries(queries, sphere_.center, threads);
    query::for_each_range(sorted, queries, *directory_, threads,
                          [&](std::span<const Index> range, Cursor& cursor) {
                            query::for_each_query(range, queries, cursor, answer);
                          });
  }

  [[nodiscard]] Index name(Index vertex) const { return directory_->name(vertex); }
  void rename(std::span<Index> found) const {
    for (Index& v : found) v = name(v);
  }
  [[nodiscard]] Location renamed(Location location) const {
    for (Index& v : location.sites) {
      if (v != no_index) v = name(v);
    }
    if (location.where == Where::edge && location.sites[1] < location.sites[0]) {
      std::swap(location.sites[0], location.sites[1]);
    }
    return location;
  }

  [[nodiscard]] std::vector<Index> within(const Point& p, const Limit& limit,
                                          Cursor& cursor) const {
    std::vector<Index> found;
    engine_->within(p, limit, cursor, found);
    rename(found);
    std::ranges::sort(found);
    return found;
  }
  [[nodiscard]] SiteLists within(std::span<const Point> queries, const Limit& limit,
                                 unsigned threads) const;

 private:
  Model model_;
  Sphere sphere_;
  Sites sites_;  // the others refer to them
  std::unique_ptr<query::Directory> directory_;
  std::unique_ptr<query::Engine> engine_;
};

// The ranges collect their lists apart; these are put together when their lengths are known.
SiteLists Locator::Impl::within(std::span<const Point> queries, const Limit& limit,
                                unsigned threads) const {
  const auto sorted = query::sort_queries(queries, sphere_.center, threads);
  std::vector<RangeLists> ranges;
  std::mutex mutex;
  query::for_each_range(sorted, queries, *directory_, threads,
                        [&](std::span<const Index> range, Cursor& cursor) {
                          RangeLists lists{range, {}, {}};
                          query::for_each_query(range, queries, cursor, [&](Index i, Cursor& at) {
                            const std::size_t begin = lists.sites.size();
                            engine_->within(queries[i], limit, at, lists.sites);
                            const auto found = std::span(lists.sites).subspan(begin);
                            rename(found);
                            std::ranges::sort(found);
                            lists.ends.push_back(lists.sites.size());
                          });
                          const std::lock_guard lock(mutex);
                          ranges.push_back(std::move(lists));
                        });

  SiteLists result;
  result.offsets.resize(queries.size() + 1);
  for (const RangeLists& lists : ranges) {
    std::uint64_t begin = 0;
    for (std::size_t k = 0; k < lists.queries.size(); ++k) {
      result.offsets[lists.queries[k] + 1] = lists.ends[k] - std::exchange(begin, lists.ends[k]);
    }
  }
  std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
  result.sites.resize(result.offsets.back());
  for (const RangeLists& lists : ranges) {
    std::uint64_t begin = 0;
    for (std::size_t k = 0; k < lists.queries.size(); ++k) {
      std::copy(
          lists.sites.begin() + static_cast<std::ptrdiff_t>(begin),
          lists.sites.begin() + static_cast<std::ptrdiff_t>(lists.ends[k]),
          result.sites.begin() + static_cast<std::ptrdiff_t>(result.offsets[lists.queries[k]]));
      begin = lists.ends[k];
    }
  }
  return result;
}

Locator::Locator(const Triangulation& triangulation) {
  const system::ArithmeticScope arithmetic;
  impl_ = std::make_unique<const Impl>(triangulation);
}
Locator::Locator(const DynamicTriangulation& triangulation) {
  const system::ArithmeticScope arithmetic;
  const DynamicTriangulation::Impl& changing = triangulation.impl_->current();
  if (!changing.has_hull()) {
    const Snapshot& now = changing.flat_snapshot();
    impl_ = std::make_unique<const Impl>(now.triangulation, now.ids);
    return;
  }
  impl_ = changing.visit([&changing](const auto& editor) {
    return std::make_unique<const Impl>(editor, changing.options);
  });
}
Locator::~Locator() = default;
Locator::Locator(Locator&& other) noexcept = default;
Locator& Locator::operator=(Locator&& other) noexcept = default;

Location Locator::locate(const Point& query) const {
  const system::ArithmeticScope arithmetic;
  impl_->validate({&query, 1});
  if (impl_->is_empty()) return {};
  Cursor cursor = impl_->cursor_at(query);
  return impl_->renamed(impl_->engine().locate(query, cursor));
}

std::vector<Location> Locator::locate(std::span<const Point> queries,
                                      const Execution& execution) const {
  const system::Call call(execution);
  impl_->validate(queries);
  std::vector<Location> result(queries.size());
  if (impl_->is_empty()) return result;
  impl_->for_each_query(queries, execution.threads, [&](Index i, Cursor& cursor) {
    result[i] = impl_->renamed(impl_->engine().locate(queries[i], cursor));
  });
  return result;
}

Index Locator::nearest(const Point& query) const {
  const system::ArithmeticScope arithmetic;
  impl_->validate({&query, 1});
  if (impl_->is_empty()) return no_index;
  Cursor cursor = impl_->cursor_at(query);
  return impl_->name(impl_->engine().nearest(query, cursor));
}

std::vector<Index> Locator::nearest(std::span<const Point> queries,
                                    const Execution& execution) const {
  const system::Call call(execution);
  impl_->validate(queries);
  std::vector<Index> result(queries.size(), no_index);
  if (impl_->is_empty()) return result;
  impl_->for_each_query(queries, execution.threads, [&](Index i, Cursor& cursor) {
    result[i] = impl_->name(impl_->engine().nearest(queries[i], cursor));
  });
  return result;
}

std::vector<Index> Locator::k_nearest(const Point& query, std::size_t k) const {
  const system::ArithmeticScope arithmetic;
  impl_->validate({&query, 1});
  std::vector<Index> found;
  if (impl_->is_empty()) return found;
  Cursor cursor = impl_->cursor_at(query);
  impl_->engine().k_nearest(query, k, cursor, found);
  impl_->rename(found);
  return found;
}

std::vector<Index> Locator::k_nearest(std::span<const Point> queries, std::size_t k,
                                      const Execution& execution) const {
  const system::Call call(execution);
  impl_->validate(queries);
  std::vector<Index> result;
  if (!queries.empty() && k > result.max_size() / queries.size()) {
    throw InvalidInput("k = " + std::to_string(k) + " for " + std::to_string(queries.size()) +
                           " queries is more than an array can hold",
                       0);
  }
  result.assign(queries.size() * k, no_index);
  if (impl_->is_empty() || k == 0) return result;
  impl_->for_each_query(queries, execution.threads, [&](Index i, Cursor& cursor) {
    std::vector<Index>& found = cursor.scratch.found;
    found.clear();
    impl_->engine().k_nearest(queries[i], k, cursor, found);
    impl_->rename(found);
    std::ranges::copy(found, result.begin() + static_cast<std::ptrdiff_t>(i * k));
  });
  return result;
}

std::vector<Index> Locator::within(const Point& query, double angle) const {
  const system::ArithmeticScope arithmetic;
  impl_->validate({&query, 1});
  check_angle(angle);
  if (impl_->is_empty()) return {};
  Cursor cursor = impl_->cursor_at(query);
  return impl_->within(query, limit_of(angle), cursor);
}

SiteLists Locator::within(std::span<const Point> queries, double angle,
                          const Execution& execution) const {
  const system::Call call(execution);
  impl_->validate(queries);
  check_angle(angle);
  if (!impl_->is_empty()) return impl_->within(queries, limit_of(angle), execution.threads);
  SiteLists none;
  none.offsets.assign(queries.size() + 1, 0);
  return none;
}

double Locator::distance(const Point& query, Index site) const {
  const system::ArithmeticScope arithmetic;
  impl_->validate({&query, 1});
  impl_->validate_site(site);
  const Sphere& sphere = impl_->sphere();
  return impl_->model() == Model::projected
             ? query::angle_between(query, impl_->site(site), sphere.center)
             : query::laguerre_distance(query, impl_->site(site), sphere);
}

std::vector<Index> Locator::neighbors(Index site) const {
  impl_->validate_site(site);
  const Index v = impl_->vertex_of(site);
  if (v == no_index) return {};
  std::vector<Index> found = impl_->engine().neighbors(v);
  impl_->rename(found);
  return found;
}

std::vector<Index> Locator::conflict_region(const Point& query) const {
  const system::ArithmeticScope arithmetic;
  api::validate_queries({&query, 1}, impl_->sphere().center, impl_->model() == Model::projected);
  if (impl_->is_empty()) return {};
  Cursor cursor = impl_->cursor_at(query);
  return impl_->engine().conflict_region(query, cursor);
}

}  // namespace rondel
