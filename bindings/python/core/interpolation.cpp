// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "rondel/constrained_interpolate.h"
#include "rondel/interpolate.h"
#include "rondel/regrid.h"
#include "rondel/weights.h"

namespace rondel::python {
namespace {

using FieldsIn = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using VectorsIn = nb::ndarray<const double, nb::shape<-1, -1, 3>, nb::c_contig, nb::device::cpu>;

std::span<const double> numbers_of(const FieldsIn& fields) {
  return {fields.data(), fields.size()};
}
std::span<const Point> vectors_of(const VectorsIn& fields) {
  return {reinterpret_cast<const Point*>(fields.data()), fields.size() / 3};
}

Weights weights_from_arrays(const OffsetsIn& offsets, const IndicesIn& columns,
                            const NumbersIn& values, std::size_t num_columns,
                            std::uint64_t sites_hash, std::uint64_t targets_hash) {
  const auto numbers = rows_of<double>(values);
  const auto indices = rows_of<Index>(columns);
  const auto ends = rows_of<std::uint64_t>(offsets);
  return {.offsets = {ends.begin(), ends.end()},
          .columns = {indices.begin(), indices.end()},
          .values = {numbers.begin(), numbers.end()},
          .num_columns = num_columns,
          .sites_hash = sites_hash,
          .targets_hash = targets_hash};
}

// Returns a getter of an array of the object `self`.
template <class T, auto member>
auto vector_getter() {
  return [](const nb::object& self) {
    const auto& numbers = nb::cast<const Weights&>(self).*member;
    return array_of<T>(self, std::span(numbers));
  };
}

// Returns the sums of rows, or with `has_largest` the values of the largest part of each.
ArrayOut<double> apply_weights(const Weights& weights, const FieldsIn& fields, double fill,
                               double max_missing, bool has_largest, unsigned threads,
                               bool keeps_sums) {
  const std::size_t count = fields.shape(0) * weights.num_rows();
  return to_array<double>(watched_quietly(count, threads, [&](const Execution& execution) {
    std::vector<double> out(count);
    const ApplyOptions options{.fill = fill, .max_missing = max_missing, .keeps_sums = keeps_sums};
    (has_largest ? apply_largest_share : apply)(weights, numbers_of(fields), out, fields.shape(0),
                                                options, execution);
    return out;
  }));
}

Weights bilinear_of_axes(const NumbersIn& lon, const NumbersIn& lat, const PairsIn& targets,
                         bool are_single) {
  return unlocked([&] {
    const auto lons = rows_of<double>(lon);
    const auto lats = rows_of<double>(lat);
    return bilinear_weights(
        {.lon_deg = {lons.begin(), lons.end()}, .lat_deg = {lats.begin(), lats.end()}},
        rows_of<LonLat>(targets), are_single ? single_rounding_deg : double_rounding_deg);
  });
}

Weights renumbered_weights(const Weights& self, const IndicesIn& rows, std::size_t num_rows,
                           const IndicesIn& columns, std::size_t num_columns) {
  return unlocked([&] {
    return renumbered(self, rows_of<Index>(rows), num_rows, rows_of<Index>(columns), num_columns);
  });
}

Weights weights_with_rows(const Weights& self, const IndicesIn& mask, const Weights* others) {
  return unlocked([&] { return with_rows(self, rows_of<std::int32_t>(mask), others); });
}

Weights weights_without_columns(const Weights& self, const IndicesIn& mask) {
  return unlocked([&] { return without_columns(self, rows_of<std::int32_t>(mask)); });
}

void add_weights(nb::module_& module) {
  nb::class_<Weights>(module, "Weights")
      .def_static("from_arrays", &weights_from_arrays, nb::arg("offsets").noconvert(),
                  nb::arg("columns").noconvert(), nb::arg("values").noconvert(),
                  nb::arg("num_columns"), nb::arg("sites_hash"), nb::arg("targets_hash"))
      .def_prop_ro("offsets", vector_getter<std::int64_t, &Weights::offsets>())
      .def_prop_ro("columns", vector_getter<std::int32_t, &Weights::columns>())
      .def_prop_ro("values", vector_getter<double, &Weights::values>())
      .def_ro("num_columns", &Weights::num_columns)
      .def_ro("sites_hash", &Weights::sites_hash)
      .def_ro("targets_hash", &Weights::targets_hash)
      .def(
          "know_places",  // for weights that were just made
          [](Weights& self, std::uint64_t sites, std::uint64_t targets) {
            if (self.sites_hash == 0) self.sites_hash = sites;
            if (self.targets_hash == 0) self.targets_hash = targets;
          },
          nb::arg("sites_hash"), nb::arg("targets_hash"))
      .def("renumbered", &renumbered_weights, nb::arg("rows").noconvert(), nb::arg("num_rows"),
           nb::arg("columns").noconvert(), nb::arg("num_columns"))
      .def("with_rows", &weights_with_rows, nb::arg("mask").noconvert(), nb::arg("others").none())
      .def("without_columns", &weights_without_columns, nb::arg("mask").noconvert())
      .def("choose_values", [](const Weights& self) { return choose_values(self); })
      .def("apply", &apply_weights, nb::arg("fields").noconvert(), nb::arg("fill"),
           nb::arg("max_missing"), nb::arg("has_largest"), nb::arg("threads"),
           nb::arg("keeps_sums") = false);
  module.def(
      "covered_enough",
      [](const NumbersIn& fractions, double max_missing) {
        return to_array<std::int32_t>(covered_enough(rows_of<double>(fractions), max_missing));
      },
      nb::arg("fractions").noconvert(), nb::arg("max_missing"));
  module.def("bilinear_weights", &bilinear_of_axes, nb::arg("lon").noconvert(),
             nb::arg("lat").noconvert(), nb::arg("targets").noconvert(), nb::arg("are_single"));
  module.def(
      "repeated_places",
      [](const NumbersIn& lon, const NumbersIn& lat) {
        const auto lons = rows_of<double>(lon);
        const auto lats = rows_of<double>(lat);
        std::vector<std::pair<Index, Index>> pairs;
        for (const auto& [site, representative] : repeated_places(
                 {.lon_deg = {lons.begin(), lons.end()}, .lat_deg = {lats.begin(), lats.end()}})) {
          pairs.emplace_back(site, representative);
        }
        return pairs;
      },
      nb::arg("lon").noconvert(), nb::arg("lat").noconvert());
}

ArrayOut<double> values_at(const Interpolator& self, const FieldsIn& fields,
                           const std::optional<VectorsIn>& gradients, const PointsIn& targets,
                           const InterpolationOptions& options, unsigned threads,
                           const nb::object& listener) {
  return to_array<double>(
      watched(targets.shape(0), threads, listener, [&](const Execution& execution) {
        if (!gradients) {
          return self.values(numbers_of(fields), points_of(targets), options, execution);
        }
        return self.values(numbers_of(fields), vectors_of(*gradients), points_of(targets), options,
                           execution);
      }));
}

void add_options(nb::module_& module) {
  module.attr("METHODS") = names_in_python<Method>();
  nb::class_<InterpolationOptions>(module, "InterpolationOptions")
      .def(
          "__init__",
          [](InterpolationOptions* self, nb::handle method, nb::handle outside,
             nb::handle duplicates, nb::handle normalization, unsigned rings) {
            new (self) InterpolationOptions{
                .method = named<Method>("method", method),
                .outside = named<Outside>("outside", outside),
                .shared_place = named<SharedPlace>("duplicates", duplicates),
                .normalization = named<Normalization>("normalization", normalization),
                .gradient = {.rings = rings}};
          },
          nb::kw_only(), nb::arg("method").none(), nb::arg("outside").none(),
          nb::arg("duplicates").none(), nb::arg("normalization").none(), nb::arg("rings"));
}

LinearOptions linear(const InterpolationOptions& options) {
  return {.outside = options.outside,
          .shared_place = options.shared_place,
          .normalization = options.normalization};
}

void add_constrained_interpolator(nb::module_& module) {
  nb::class_<ConstrainedInterpolator>(module, "ConstrainedInterpolator")
      .def(
          "__init__",
          [](ConstrainedInterpolator* self, const ConstrainedTriangulation& result) {
            new (self)
                ConstrainedInterpolator(unlocked([&] { return ConstrainedInterpolator(result); }));
          },
          nb::arg("result"))
      .def(
          "weights",
          [](const ConstrainedInterpolator& self, const PointsIn& targets,
             const InterpolationOptions& options, unsigned threads, const nb::object& listener) {
            return watched(targets.shape(0), threads, listener, [&](const Execution& execution) {
              return self.weights(points_of(targets), linear(options), execution);
            });
          },
          nb::arg("targets").noconvert(), nb::arg("options"), nb::arg("threads"),
          nb::arg("progress").none())
      .def(
          "values",
          [](const ConstrainedInterpolator& self, const FieldsIn& fields, const PointsIn& targets,
             const InterpolationOptions& options, unsigned threads, const nb::object& listener) {
            return to_array<double>(
                watched(targets.shape(0), threads, listener, [&](const Execution& execution) {
                  return self.values(numbers_of(fields), points_of(targets), linear(options),
                                     execution);
                }));
          },
          nb::arg("fields").noconvert(), nb::arg("targets").noconvert(), nb::arg("options"),
          nb::arg("threads"), nb::arg("progress").none());
}

void add_hash(nb::module_& module) {
  module.def(
      "point_set_hash",
      [](const PointsIn& points) {
        return unlocked([&] { return point_set_hash(points_of(points)); });
      },
      nb::arg("points").noconvert());
}

}  // namespace

void add_interpolation(nb::module_& module) {
  add_weights(module);
  add_options(module);
  add_constrained_interpolator(module);
  add_hash(module);
  nb::class_<Interpolator>(module, "Interpolator")
      .def(
          "__init__",
          [](Interpolator* self, const Triangulation& t) {
            new (self) Interpolator(unlocked([&] { return Interpolator(t); }));
          },
          nb::arg("triangulation"))
      .def(
          "weights",
          [](const Interpolator& self, const PointsIn& targets, const InterpolationOptions& options,
             unsigned threads, const nb::object& listener) {
            return watched(targets.shape(0), threads, listener, [&](const Execution& execution) {
              return self.weights(points_of(targets), options, execution);
            });
          },
          nb::arg("targets").noconvert(), nb::arg("options"), nb::arg("threads"),
          nb::arg("progress").none())
      .def(
          "nearest_d2s_weights",
          [](const Interpolator& self, const PointsIn& sources, unsigned threads) {
            return watched_quietly(sources.shape(0), threads, [&](const Execution& execution) {
              return nearest_d2s_weights(self, points_of(sources), execution);
            });
          },
          nb::arg("sources").noconvert(), nb::arg("threads"))
      .def("values", &values_at, nb::arg("fields").noconvert(),
           nb::arg("gradients").noconvert().none(), nb::arg("targets").noconvert(),
           nb::arg("options"), nb::arg("threads"), nb::arg("progress").none())
      .def(
          "gradient",
          [](const Interpolator& self, std::size_t size, unsigned rings, nb::handle undetermined,
             unsigned threads, const nb::object& listener) {
            const GradientOptions options{
                .rings = rings, .undetermined = named<Undetermined>("undetermined", undetermined)};
            return watched(size, threads, listener, [&](const Execution& execution) {
              return self.gradient(options, execution);
            });
          },
          nb::arg("size"), nb::arg("rings"), nb::arg("undetermined").none(), nb::arg("threads"),
          nb::arg("progress").none())
      .def(
          "vectors",
          [](const Interpolator& self, const VectorsIn& fields, const PointsIn& targets,
             const InterpolationOptions& options, unsigned threads, const nb::object& listener) {
            return points_out(
                watched(targets.shape(0), threads, listener, [&](const Execution& execution) {
                  return self.vectors(vectors_of(fields), points_of(targets), options, execution);
                }));
          },
          nb::arg("fields").noconvert(), nb::arg("targets").noconvert(), nb::arg("options"),
          nb::arg("threads"), nb::arg("progress").none());
}

}  // namespace rondel::python
