// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What `rondel plot` needs to make a page.
#pragma once

#include <string>

namespace rondel::cli {

/// "stations" of "data/stations.csv"; "Sites" of standard input.
std::string title_of(const std::string& input);

}  // namespace rondel::cli
