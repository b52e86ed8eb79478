// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options of extrapolation, for the commands that carry values between places.
///
/// in    the command line
/// out   a method with its limits, or nothing
#pragma once

#include <optional>

#include "options.h"
#include "rondel/extrapolate.h"

namespace rondel::cli {

/// What --extrapolate and the options beside it say.
struct ExtrapolateOptions {
  std::optional<Extrapolation> method = std::nullopt;
  ExtrapolationOptions limits;  ///< their method is not in use

  /// Returns the whole, or nothing without --extrapolate.
  [[nodiscard]] std::optional<ExtrapolationOptions> wanted() const {
    if (!method) return std::nullopt;
    ExtrapolationOptions whole = limits;
    whole.method = *method;
    return whole;
  }
};

/// Adds --extrapolate, --extrapolate-distance, --extrapolate-sources, --extrapolate-exponent and
/// --extrapolate-levels.
void add_extrapolate_options(CLI::App& parser, CommonOptions& common, ExtrapolateOptions& options);

}  // namespace rondel::cli
