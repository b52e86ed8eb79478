// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The names of methods and of their options, in the order of the enumerators.

#include "rondel/interpolate.h"
#include "rondel/regrid.h"
#include "system/message_text.h"

namespace rondel {

std::string_view name_of(Method method) noexcept {
  return system::name_in({"nearest", "linear", "laplace", "sibson", "hermite", "cubic"}, method);
}

std::string_view name_of(RegridMethod method) noexcept {
  return system::name_in({"bilinear", "nearest_d2s", "native"}, method);
}

std::string_view name_of(Outside outside) noexcept {
  return system::name_in({"nan", "nearest", "error"}, outside);
}

std::string_view name_of(SharedPlace shared_place) noexcept {
  return system::name_in({"first", "mean", "error"}, shared_place);
}

std::string_view name_of(Normalization normalization) noexcept {
  return system::name_in({"unity", "homogeneous"}, normalization);
}

std::string_view name_of(Undetermined undetermined) noexcept {
  return system::name_in({"zero", "missing"}, undetermined);
}

}  // namespace rondel
