// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Locator: the public functions of rondel/query.h, for single queries and for ranges. Each
// validates its arguments, then asks a query::Engine, which walks through the triangulation from a
// vertex nearby. The vertices are those of a finished triangulation (query::Built) or of one that
// may change; after a change such a locator throws InvalidInput.

#include "rondel/query.h"

#include <algorithm>
#include <mutex>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "api/dynamic_impl.h"
#include "api/triangulation_impl.h"
#include "api/validation.h"
#include "query/batch.h"
#include "query/built.h"
#include "query/distance.h"
#include "query/engine.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/mutex.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using query::Cursor;
using query::Limit;

// Throws InvalidInput for an angle that is negative or NaN.
void check_angle(double angle) {
  if (angle >= 0) return;
  throw InvalidInput("the angle " + system::shortest_text(angle) + " is negative or not a number");
}

// Returns the limit of within() for an angle in radians; there is none from a half turn on.
Limit limit_of(double angle, const Sphere& sphere) {
  if (angle >= std::numbers::pi) return {};
  return {predicates::cosine_of(angle), sphere.squared_radius};
}

// The answers of one range of queries: sizes[k] sites belong to queries[k], one list after another.
struct RangeLists {
  std::vector<Index> queries;
  std::vector<Index> sizes;
  std::vector<Index> sites;
};

}  // namespace

std::string_view name_of(Where where) noexcept {
  return system::name_in({"vertex", "edge", "face", "outside"}, where);
}

// Queries are points; sites and vertices have the names that they have outside: their index, or
// their id in a triangulation that may change.
class Locator::Impl {
 public:
  // For a finished triangulation, whose sites are called by their indices.
  explicit Impl(const Triangulation& triangulation)
      : Impl(triangulation, {}, triangulation.sites().points()) {}

  // For a snapshot of a triangulation that may change, `asked`: its sites are called `ids` outside,
  // and `points_by_id` are their points.
  Impl(const Triangulation& triangulation, std::span<const Index> ids,
       std::span<const Point> points_by_id, const DynamicTriangulation::Impl* asked = nullptr)
      : model_(triangulation.model()),
        sphere_(triangulation.sphere()),
        points_(points_by_id),
        asked_(asked),
        num_changes_(asked == nullptr ? 0 : asked->num_changes),
        built_(std::in_place, triangulation, ids),
        engine_(built_->graph()) {}

  // For a triangulation that may change and has a hull, which is used without a copy.
  template <class Editor>
  Impl(const DynamicTriangulation::Impl& changing, const Editor& editor)
      : model_(changing.options.model),
        sphere_(changing.options.sphere),
        points_(editor.places().points()),
        asked_(&changing),
        num_changes_(changing.num_changes),
        changing_(&changing),
        engine_(editor.graph()) {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // Throws InvalidInput for the first query that is not finite or, for rays, the center of the
  // sphere, and if the triangulation has changed.
  void validate(std::span<const Point> queries, bool are_rays = true) const {
    require_current();
    api::validate_queries(queries, sphere_.center, are_rays);
  }
  // Throws InvalidInput if there is no such site.
  void validate_site(Index site) const {
    require_current();
    if (changing_ ? changing_->is_alive(site) : built_->has_site(site)) return;
    throw InvalidInput("there is no site " + std::to_string(site), site);
  }

  [[nodiscard]] bool is_empty() const { return built_ && built_->num_vertices() == 0; }
  [[nodiscard]] const query::Engine& engine() const { return engine_; }
  [[nodiscard]] const Sphere& sphere() const { return sphere_; }
  [[nodiscard]] Model model() const { return model_; }
  [[nodiscard]] Point site(Index i) const { return points_[i]; }
  // Returns the vertex at the place of a site; no_index if the site is hidden.
  [[nodiscard]] Index vertex_of(Index site) const {
    if (built_) return built_->vertex_of(site);
    return changing_->visit([site](const auto& e) {
      const Index place = e.places().place_of(site);
      return e.hull()->is_vertex(place) ? place : no_index;
    });
  }

  // Returns a vertex near a point, where a walk to it begins. Precondition: there is a vertex.
  [[nodiscard]] Index near(const Point& p) const {
    if (built_) return built_->near(p);
    return changing_->visit([&p](const auto& e) { return e.vertex_near(p); });
  }
  [[nodiscard]] Cursor cursor_at(const Point& p) const {
    Cursor cursor;
    cursor.vertex = near(p);
    return cursor;
  }

  // Returns ask(query, cursor) for one query, or `none` where there is no vertex.
  template <class Answer, class Ask>
  [[nodiscard]] Answer answer(const Point& query, Answer none, const Ask& ask,
                              bool is_ray = true) const {
    const system::ArithmeticScope arithmetic;
    validate({&query, 1}, is_ray);
    if (is_empty()) return none;
    Cursor cursor = cursor_at(query);
    return ask(query, cursor);
  }
  // Returns the answers to a range of queries, in its order.
  template <class Answer, class Ask>
  [[nodiscard]] std::vector<Answer> answers(std::span<const Point> queries,
                                            const Execution& execution, const Answer& none,
                                            const Ask& ask) const {
    const system::Call call(execution);
    validate(queries);
    std::vector<Answer> result(queries.size(), none);
    if (is_empty()) return result;
    for_each_query(queries, execution.threads,
                   [&](Index i, Cursor& cursor) { result[i] = ask(queries[i], cursor); });
    return result;
  }

  // Calls work(range, cursor) for ranges of queries that are near each other, in parallel.
  template <class Work>
  void for_each_range(std::span<const Point> queries, unsigned threads, const Work& work) const {
    query::for_each_range(
        queries, model_, sphere_.center, threads, [this](const Point& p) { return near(p); }, work);
  }
  // Calls answer(i, cursor) for every query i; the order does not show in the answers.
  template <class Answer>
  void for_each_query(std::span<const Point> queries, unsigned threads,
                      const Answer& answer) const {
    for_each_range(queries, threads, [&](std::span<const Index> range, Cursor& cursor) {
      query::for_each_query(range, queries, cursor, answer);
    });
  }

  [[nodiscard]] CompressedRows<Index> within(std::span<const Point> queries, const Limit& limit,
                                             unsigned threads) const;

 private:
  void require_current() const {
    if (asked_ == nullptr || asked_->num_changes == num_changes_) return;
    throw InvalidInput("the triangulation has changed since the locator was made");
  }

  Model model_;
  Sphere sphere_;
  std::span<const Point> points_;
  const DynamicTriangulation::Impl* asked_ = nullptr;  // what may change
  std::uint64_t num_changes_ = 0;                      // of it, when this was made
  // One of these two, and what is asked of it.
  std::optional<const query::Built> built_;
  const DynamicTriangulation::Impl* changing_ = nullptr;
  query::Engine engine_;
};

// Ranges of queries collect their lists apart; these are put together when their lengths are known,
// in the order of the queries, whichever thread was first.
CompressedRows<Index> Locator::Impl::within(std::span<const Point> queries, const Limit& limit,
                                            unsigned threads) const {
  std::vector<RangeLists> ranges;
  system::Mutex mutex;
  for_each_range(queries, threads, [&](std::span<const Index> range, Cursor& cursor) {
    RangeLists lists;
    lists.queries.assign(range.begin(), range.end());
    query::for_each_query(range, queries, cursor, [&](Index i, Cursor& at) {
      const std::size_t before = lists.sites.size();
      engine_.within(queries[i], limit, at, lists.sites);
      lists.sizes.push_back(static_cast<Index>(lists.sites.size() - before));
    });
    const std::lock_guard lock(mutex);
    ranges.push_back(std::move(lists));
  });

  CompressedRows<Index> result;
  result.offsets = system::join_rows(
      threads, queries.size(), std::move(ranges),
      [](std::size_t /*range*/, const RangeLists& lists, std::size_t k) {
        return lists.queries[k];
      },
      system::JoinedColumn{&RangeLists::sites, result.values});
  return result;
}

Locator::Locator(const Triangulation& triangulation)
    : impl_([&] {
        const system::ArithmeticScope arithmetic;
        api::require_delaunay(triangulation, {});
        return std::make_unique<const Impl>(triangulation);
      }()) {}
Locator::Locator(const DynamicTriangulation& triangulation) {
  const system::ArithmeticScope arithmetic;
  // Below dimension 2 there is no hull to walk through, so a snapshot is searched instead.
  const DynamicTriangulation::Impl& changing = triangulation.impl_->indexed();
  if (!changing.has_hull()) {
    const Snapshot& now = changing.flat_snapshot();
    impl_ = std::make_unique<const Impl>(now.triangulation, now.ids, changing.places().points(),
                                         &changing);
    return;
  }
  impl_ = changing.visit(
      [&changing](const auto& editor) { return std::make_unique<const Impl>(changing, editor); });
}
Locator::~Locator() = default;
Locator::Locator(Locator&& other) noexcept = default;
Locator& Locator::operator=(Locator&& other) noexcept = default;

Location Locator::locate(const Point& query) const {
  return impl_->answer(query, Location(), [this](const Point& p, Cursor& cursor) {
    return impl_->engine().locate(p, cursor);
  });
}

std::vector<Location> Locator::locate(std::span<const Point> queries,
                                      const Execution& execution) const {
  return impl_->answers(queries, execution, Location(), [this](const Point& p, Cursor& cursor) {
    return impl_->engine().locate(p, cursor);
  });
}

Index Locator::nearest(const Point& query) const {
  return impl_->answer(query, no_index, [this](const Point& p, Cursor& cursor) {
    return impl_->engine().nearest(p, cursor);
  });
}

std::vector<Index> Locator::nearest(std::span<const Point> queries,
                                    const Execution& execution) const {
  return impl_->answers(queries, execution, no_index, [this](const Point& p, Cursor& cursor) {
    return impl_->engine().nearest(p, cursor);
  });
}

std::vector<Index> Locator::k_nearest(const Point& query, std::size_t k) const {
  return impl_->answer(query, std::vector<Index>(), [&](const Point& p, Cursor& cursor) {
    std::vector<Index> found;
    impl_->engine().k_nearest(p, k, cursor, found);
    return found;
  });
}

std::vector<Index> Locator::k_nearest(std::span<const Point> queries, std::size_t k,
                                      const Execution& execution) const {
  const system::Call call(execution);
  impl_->validate(queries);
  std::vector<Index> result;
  // The product may overflow, so it is tested before it is computed.
  if (!queries.empty() && k > result.max_size() / queries.size()) {
    throw InvalidInput("k = " + std::to_string(k) + " for " + std::to_string(queries.size()) +
                       " queries is more than an array can hold");
  }
  result.assign(queries.size() * k, no_index);
  if (impl_->is_empty() || k == 0) return result;
  impl_->for_each_query(queries, execution.threads, [&](Index i, Cursor& cursor) {
    std::vector<Index>& found = cursor.scratch.found;
    found.clear();
    impl_->engine().k_nearest(queries[i], k, cursor, found);
    std::ranges::copy(found, result.begin() + static_cast<std::ptrdiff_t>(i * k));
  });
  return result;
}

std::vector<Index> Locator::within(const Point& query, double angle) const {
  const system::ArithmeticScope arithmetic;
  impl_->validate({&query, 1});
  check_angle(angle);
  if (impl_->is_empty()) return {};
  std::vector<Index> found;
  Cursor cursor = impl_->cursor_at(query);
  impl_->engine().within(query, limit_of(angle, impl_->sphere()), cursor, found);
  return found;
}

CompressedRows<Index> Locator::within(std::span<const Point> queries, double angle,
                                      const Execution& execution) const {
  const system::Call call(execution);
  impl_->validate(queries);
  check_angle(angle);
  if (!impl_->is_empty())
    return impl_->within(queries, limit_of(angle, impl_->sphere()), execution.threads);
  CompressedRows<Index> none;
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
  return impl_->engine().neighbors(v);
}

std::vector<Index> Locator::conflict_region(const Point& query) const {
  return impl_->answer(
      query, std::vector<Index>(),
      [this](const Point& p, Cursor& cursor) { return impl_->engine().conflict_region(p, cursor); },
      impl_->model() == Model::projected);
}

}  // namespace rondel
