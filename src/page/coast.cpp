// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Decodes data/coast.txt. Each line of it is a polyline: a first position and then steps from
// position to position, longitude before latitude, in hundredths of degrees.
#include <charconv>
#include <cstdint>
#include <string_view>

#include "page/page_text.h"
#include "rondel/globe.h"

namespace rondel {

CompressedRows<LonLat> coast_lines() {
  const std::string_view text = page::coast_text();
  CompressedRows<LonLat> coast;
  std::int32_t sums[2] = {0, 0}, step = 0;  // hundredths of degrees
  std::size_t count = 0;                    // how many numbers of the current line were read
  for (const char* at = text.data(); at != text.data() + text.size(); ++at) {
    at = std::from_chars(at, text.data() + text.size(), step).ptr;
    sums[count % 2] += step;
    if (++count % 2 == 0) coast.values.push_back({sums[0] / 100.0, sums[1] / 100.0});
    if (*at != '\n') continue;
    coast.end_row();
    sums[0] = sums[1] = 0;
    count = 0;
  }
  return coast;
}

}  // namespace rondel
