// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "plot_page.h"

#include <filesystem>

namespace rondel::cli {

std::string title_of(const std::string& input) {
  return input == "-" ? "Sites" : std::filesystem::path(input).stem().string();
}

}  // namespace rondel::cli
