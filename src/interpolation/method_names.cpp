// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The names of methods and of their options, in the order of the enumerators.

#include <algorithm>
#include <array>
#include <cstddef>

#include "rondel/interpolate.h"
#include "rondel/regrid.h"

namespace rondel {
namespace {

constexpr std::array<std::string_view, 6> method_names = {"nearest", "linear",  "laplace",
                                                          "sibson",  "hermite", "cubic"};
constexpr std::array<std::string_view, 2> regrid_method_names = {"bilinear", "nearest_d2s"};
constexpr std::array<std::string_view, 3> outside_names = {"nan", "nearest", "error"};
constexpr std::array<std::string_view, 3> shared_place_names = {"first", "mean", "error"};
constexpr std::array<std::string_view, 2> normalization_names = {"unity", "homogeneous"};
constexpr std::array<std::string_view, 2> undetermined_names = {"zero", "missing"};

template <std::size_t N, class Value>
std::string_view name_in(const std::array<std::string_view, N>& names, Value value) {
  const auto k = static_cast<std::size_t>(value);
  return k < N ? names[k] : std::string_view();
}

}  // namespace

std::string_view name_of(Method method) noexcept { return name_in(method_names, method); }
std::string_view name_of(RegridMethod method) noexcept {
  return name_in(regrid_method_names, method);
}
std::string_view name_of(Outside outside) noexcept { return name_in(outside_names, outside); }
std::string_view name_of(SharedPlace shared_place) noexcept {
  return name_in(shared_place_names, shared_place);
}
std::string_view name_of(Normalization normalization) noexcept {
  return name_in(normalization_names, normalization);
}
std::string_view name_of(Undetermined undetermined) noexcept {
  return name_in(undetermined_names, undetermined);
}

std::optional<Method> method_of(std::string_view name) noexcept {
  const auto at = std::ranges::find(method_names, name);
  if (at == method_names.end()) return std::nullopt;
  return static_cast<Method>(at - method_names.begin());
}

}  // namespace rondel
