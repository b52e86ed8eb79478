// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Interpolator and apply(): laws of the weights of every method, against locations and each other.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/interpolate.h"
#include "rondel/names.h"
#include "rondel/query.h"
#include "rondel/sites.h"

namespace rondel::fuzz {
namespace {

constexpr std::size_t max_targets = 5;

struct Question {
  std::vector<Point> sites;
  Options options;
  std::vector<Point> targets;
  InterpolationOptions how;
  std::vector<double> field;
};

// The directions of which most is known: those of sites, between two and three of them, opposite.
void add_targets(ByteSource& source, Question& q, Scales scales) {
  const Point& o = q.options.sphere.center;
  for (std::size_t n = 1 + source.below(max_targets); n > 0; --n) {
    Point p = next_site(source, q.targets.empty() ? q.sites : q.targets, scales);
    const std::size_t kind = source.below(5);
    if (kind > 0 && !q.sites.empty()) {
      p = q.sites[source.below(q.sites.size())];
      const double sign = kind == 4 ? -1 : 1;
      p = {sign * (p.x - o.x), sign * (p.y - o.y), sign * (p.z - o.z)};
      for (std::size_t k = 1; k < kind && kind < 4; ++k) {
        const Point& a = q.sites[source.below(q.sites.size())];
        p = {p.x + (a.x - o.x), p.y + (a.y - o.y), p.z + (a.z - o.z)};
      }
      p = {p.x + o.x, p.y + o.y, p.z + o.z};
    }
    const bool is_finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    if (is_finite && p != o) q.targets.push_back(p);
  }
}

// The direction of p, as doubles know it; none where differences overflow.
std::optional<Point> direction(const Point& p, const Point& o) {
  const Point d = {p.x - o.x, p.y - o.y, p.z - o.z};
  const double size = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  if (!std::isfinite(size) || size < 1e-300) return std::nullopt;
  const Point s = {d.x / size, d.y / size, d.z / size};
  const double length = std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
  return Point{s.x / length, s.y / length, s.z / length};
}

bool is_positive(Method method) { return method != Method::hermite && method != Method::cubic; }

// u x (sum of weights times sites) is 0.
void test_direction(const Question& q, std::span<const Index> columns,
                    std::span<const double> weights, const Point& target) {
  const auto u = direction(target, q.options.sphere.center);
  Point sum{};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto x = direction(q.sites[columns[k]], q.options.sphere.center);
    if (!x) return;
    sum = {sum.x + weights[k] * x->x, sum.y + weights[k] * x->y, sum.z + weights[k] * x->z};
  }
  if (!u) return;
  const Point off = {u->y * sum.z - u->z * sum.y, u->z * sum.x - u->x * sum.z,
                     u->x * sum.y - u->y * sum.x};
  require(std::abs(off.x) + std::abs(off.y) + std::abs(off.z) <= 2e-14,
          "the weighted sum of the sites is on the ray of the target");
}

// The weights of one target.
void test_row(const Question& q, std::span<const Index> columns, std::span<const double> weights,
              const Point& target, const Location& location) {
  const Method method = q.how.method;
  double sum = 0;
  double absolute = 0;
  for (const double weight : weights) {
    require(std::isfinite(weight), "a weight is a number");
    require(!is_positive(method) || weight >= 0, "a weight is not negative");
    sum += weight;
    absolute += std::abs(weight);
  }
  const bool is_outside = location.where == Where::outside;
  if (q.how.outside == Outside::nearest || method == Method::nearest) {
    require(!weights.empty(), "where the nearest is asked for, there is a value");
  } else if (is_outside ||
             (method == Method::linear && q.how.normalization == Normalization::unity)) {
    require(weights.empty() == is_outside, "outside is where no face is");
  }
  if (weights.empty()) return;
  if (is_outside || location.where == Where::vertex || method == Method::nearest) {
    require(weights[0] == 1, "at a site, and for the nearest, there is one weight");
    return;
  }
  if (q.how.normalization != Normalization::unity) return;
  require(std::abs(sum - 1) <= 4 * 0x1p-52 * absolute, "weights add up to 1");
  if (is_positive(method)) test_direction(q, columns, weights, target);
}

void test_values(const Question& q, const Interpolator& interpolator, const Weights& weights) {
  const auto values = interpolator.values(q.field, q.targets, q.how);
  require(values.size() == q.targets.size(), "a value for each target");
  std::vector<double> applied(values.size());
  apply(weights, q.field, applied);
  const auto [low, high] = std::ranges::minmax(q.field);
  for (std::size_t t = 0; t < values.size() && is_positive(q.how.method); ++t) {
    require(std::isnan(values[t]) == (weights.offsets[t] == weights.offsets[t + 1]),
            "a value is missing where there is no row");
    if (std::isnan(values[t])) continue;
    const bool is_mean = q.how.shared_place == SharedPlace::mean;
    require(is_mean || values[t] == applied[t], "values are what weights apply to");
    if (q.how.normalization != Normalization::unity) continue;
    require(values[t] >= low - 1e-14 && values[t] <= high + 1e-14, "values are in the range");
  }
}

void test_gradients(const Question& q, const Interpolator& interpolator) {
  if (q.options.model == Model::weighted) return;
  const Weights gradient = interpolator.gradient(q.how.gradient);
  require(gradient.num_rows() == 3 * q.sites.size(), "three rows for each site");
  for (const double weight : gradient.values) require(!std::isnan(weight), "a weight is a number");
  if (q.how.method != Method::hermite && q.how.method != Method::cubic) return;
  const std::vector<double> ones(q.sites.size(), 1);
  const std::vector<Point> flat(q.sites.size());
  InterpolationOptions how = q.how;
  how.normalization = Normalization::unity;
  for (const double value : interpolator.values(ones, flat, q.targets, how)) {
    require(std::isnan(value) || std::abs(value - 1) <= 1e-15, "a constant comes back");
  }
}

// One and all, in any order.
void test_order(const Question& q, const Interpolator& interpolator, const Weights& weights) {
  std::vector<Point> sites(q.sites.rbegin(), q.sites.rend());
  const auto other = delaunay(std::move(sites), q.options);
  if (!other.duplicates().empty()) return;
  Weights turned = Interpolator(other).weights(q.targets, q.how);
  for (Index& column : turned.columns) column = static_cast<Index>(q.sites.size()) - 1 - column;
  require(turned.offsets == weights.offsets && turned.columns == weights.columns &&
              turned.values == weights.values,
          "the order of the sites changes no byte");
  const Weights first = interpolator.weights(std::span(q.targets).first(1), q.how);
  require(std::ranges::equal(first.values, std::span(weights.values).first(weights.offsets[1])),
          "one target has the weights that it has among others");
}

void refuse_wrong_calls(const Question& q, const Interpolator& interpolator) {
  std::vector<Point> bad = q.targets;
  bad.push_back(q.options.sphere.center);
  refuse(q.targets.size(), [&] { return interpolator.weights(bad, q.how); });
  refuse(q.targets.size(), [&] { return interpolator.values(q.field, bad, q.how); });
  refuse(q.targets.size(), [&] { return interpolator.vectors(q.sites, bad, q.how); });
  std::vector<double> out(1);
  refuse(InvalidInput::no_index, [&] {
    apply(Weights{}, q.field, out);
    return 0;
  });
}

void test(const Question& q) {
  const Triangulation triangulation = delaunay(q.sites, q.options);
  const Interpolator interpolator(triangulation);
  if (q.options.model == Model::weighted && q.how.method != Method::nearest) {
    refuse(InvalidInput::no_index, [&] { return interpolator.weights(q.targets, q.how); });
    return;
  }
  const Weights weights = interpolator.weights(q.targets, q.how);
  require(weights.sites_hash == point_set_hash(q.sites), "the hash is that of the sites");
  require(weights.num_rows() == q.targets.size(), "a row for each target");
  require(weights.num_columns == q.sites.size(), "a column for each site");
  const auto locations = Locator(triangulation).locate(q.targets);
  Weights copy;
  for (std::size_t t = 0; t < q.targets.size(); ++t) {
    const std::uint64_t begin = weights.offsets[t];
    const std::uint64_t size = weights.offsets[t + 1] - begin;
    const auto columns = std::span(weights.columns).subspan(begin, size);
    copy.columns.insert(copy.columns.end(), columns.begin(), columns.end());
    copy.end_row();
    if (q.how.shared_place == SharedPlace::mean && !triangulation.duplicates().empty()) continue;
    test_row(q, columns, std::span(weights.values).subspan(begin, size), q.targets[t],
             locations[t]);
  }
  require(copy.offsets == weights.offsets, "rows end where they are ended");
  test_values(q, interpolator, weights);
  test_gradients(q, interpolator);
  test_order(q, interpolator, weights);
  refuse_wrong_calls(q, interpolator);
  std::vector<Point> wind;
  for (const double value : q.field) wind.push_back({value, 1 - value, 0.5});
  for (const Point& v : interpolator.vectors(wind, q.targets, q.how)) {
    require(std::isnan(v.x) == std::isnan(v.y) && std::isnan(v.y) == std::isnan(v.z),
            "a vector is there or it is not");
  }
}

// Sites in rows, the first of which is on a great circle up to rounding, and all others on one side
// of it: some ulps beside a site of the first row the value is the site's.
void test_great_circle(const std::uint8_t* data, std::size_t size, Method method) {
  ByteSource source(data, size);
  const auto number = [&source] { return static_cast<double>(source.small()) + 0.3; };
  const Point origin{};
  const auto x = direction({number(), number(), number()}, origin);
  const Point other = {number(), number(), number()};
  const Point across = {x->y * other.z - x->z * other.y, x->z * other.x - x->x * other.z,
                        x->x * other.y - x->y * other.x};
  const auto z = direction(across, origin);
  if (!z || std::abs(across.x) + std::abs(across.y) + std::abs(across.z) < 1e-3) return;
  const Point y = {z->y * x->z - z->z * x->y, z->z * x->x - z->x * x->z, z->x * x->y - z->y * x->x};
  const auto at = [&](double lon, double lat) {
    const double a = std::cos(lat) * std::cos(lon);
    const double b = std::cos(lat) * std::sin(lon);
    const double c = std::sin(lat);
    const auto off = [&] { return 0x1p-53 * (static_cast<double>(source.below(5)) - 2); };
    return Point{a * x->x + b * y.x + c * z->x + off(), a * x->y + b * y.y + c * z->y + off(),
                 a * x->z + b * y.z + c * z->z + off()};
  };
  const std::size_t length = 3 + source.below(20);
  const std::size_t num_rows = 1 + source.below(4);
  const double step = (1 + static_cast<double>(source.byte())) / 100 / static_cast<double>(length);
  std::vector<Point> sites;
  std::vector<Point> targets;
  std::vector<double> field;
  for (std::size_t i = 0; i < num_rows * length; ++i) {
    const double along = step * static_cast<double>(i % length);
    const double up = std::min(step, 0.3) * static_cast<double>(i / length);
    sites.push_back(at(along, up));
    field.push_back(static_cast<double>(source.byte()));
    if (i < length) targets.push_back(at(along, 0));
  }
  const std::vector<double> values =
      Interpolator(delaunay(sites)).values(field, targets, {.method = method});
  for (std::size_t i = 0; i < length; ++i) {
    require(std::isnan(values[i]) || std::abs(values[i] - field[i]) < 1e-6,
            "beside a site of a great circle the value is the site's");
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  fuzz::Question q;
  q.options.model = source.byte() % 16 == 15 ? Model::weighted : Model::projected;
  q.how.method = static_cast<Method>(source.below(6));
  fuzz::require(
      from_name<Method>(name_of(q.how.method)) == q.how.method && names_of<Method>().size() == 6,
      "a name of its own");
  q.how.outside = source.below(2) == 0 ? Outside::missing : Outside::nearest;
  q.how.shared_place = source.below(3) == 2 ? SharedPlace::mean : SharedPlace::first;
  const bool has_gradients = q.how.method == Method::hermite || q.how.method == Method::cubic;
  const bool is_homogeneous = source.below(4) == 3 && !has_gradients;
  q.how.normalization = is_homogeneous ? Normalization::homogeneous : Normalization::unity;
  q.how.gradient.rings = 1 + static_cast<unsigned>(source.below(3));
  const fuzz::Scales scales = fuzz::next_scales(source);
  const std::size_t limit = fuzz::next_limit(source, 40);
  q.options.sphere = fuzz::next_sphere(source, scales);
  while (!source.is_empty() && q.sites.size() < limit) {
    q.sites.push_back(fuzz::next_site(source, q.sites, scales));
  }
  if (q.options.model == Model::projected) fuzz::remove_center(q.sites, q.options.sphere);
  for (std::size_t i = 0; i < q.sites.size(); ++i) {
    q.field.push_back(static_cast<double>(i * 37 % 11) / 11);
  }
  fuzz::add_targets(source, q, scales);
  if (!q.targets.empty() && !q.sites.empty()) fuzz::test(q);
  fuzz::test_great_circle(data, size, q.how.method);
  return 0;
}
