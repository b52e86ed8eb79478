// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "extrapolate_options.h"

#include <string>

#include "validate.h"

namespace rondel::cli {

void add_extrapolate_options(CLI::App& parser, CommonOptions& common, ExtrapolateOptions& options) {
  parser
      .add_option_function<std::string>(
          "--extrapolate",
          [&options](const std::string& text) { options.method = extrapolation_named(text); },
          "Targets without a value get one, field by field: of the nearest source with a value\n"
          "(nearest), of several by inverse distance (idw), or the mean of their neighbors with\n"
          "values, level by level (creep)")
      ->check(one_of({"nearest", "idw", "creep", "nearest_s2d", "inverse_dist", "creep_fill"}))
      ->type_name("WORD");
  const CLI::Option* const distance =
      parser
          .add_option(
              "--extrapolate-distance", options.limits.max_distance_km,
              "How far from a target sources with values may be, on a sphere with a radius of\n"
              "6371.229 km (default: any)")
          ->check([](const std::string& text) { return range_error(text, 0, 1e9); })
          ->type_name("KM");
  const CLI::Option* const sources =
      parser
          .add_option("--extrapolate-sources", options.limits.neighbors,
                      "idw: the number of sources (default 8)")
          ->check([](const std::string& text) { return whole_error(text, 1, 1000); })
          ->type_name("N");
  const CLI::Option* const exponent =
      parser
          .add_option("--extrapolate-exponent", options.limits.exponent,
                      "idw: the power of the distance (default 2)")
          ->check([](const std::string& text) { return whole_error(text, 1, 100); })
          ->type_name("N");
  const CLI::Option* const levels =
      parser
          .add_option("--extrapolate-levels", options.limits.levels,
                      "creep: how many levels are filled (default: all)")
          ->check([](const std::string& text) { return whole_error(text, 1, 1'000'000); })
          ->type_name("N");
  require_effect(
      common, distance, [&options] { return options.method.has_value(); }, "without --extrapolate");
  for (const CLI::Option* const option : {sources, exponent}) {
    require_effect(
        common, option, [&options] { return options.method == Extrapolation::idw; },
        "without --extrapolate idw");
  }
  require_effect(
      common, levels, [&options] { return options.method == Extrapolation::creep; },
      "without --extrapolate creep");
}

}  // namespace rondel::cli
