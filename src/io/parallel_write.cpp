// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/parallel_write.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "system/parallel.h"

namespace rondel::io {

// While the texts of one wave are written, those of the next one are made.
void write_in_parallel(AtomicFile& file, unsigned threads, std::size_t count, std::size_t grain,
                       const std::function<void(std::string&, std::size_t, std::size_t)>& append,
                       const std::function<void(std::size_t)>& report) {
  const unsigned limit = system::num_threads(threads);
  const std::size_t pieces_per_wave = limit == 1 ? 1 : 2 * std::size_t{limit};
  const std::size_t wave = pieces_per_wave * grain;
  std::vector<std::string> made(pieces_per_wave);
  std::vector<std::string> written(pieces_per_wave);
  const auto make = [&](std::size_t first) {
    for (std::string& text : made) text.clear();
    const std::size_t size = std::min(wave, count - first);
    system::parallel_for(limit, size, grain, [&](std::size_t begin, std::size_t end) {
      append(made[begin / grain], first + begin, first + end);
    });
  };
  const auto write = [&] {
    for (const std::string& text : written) file.write(text);
  };
  for (std::size_t first = 0; first < count; first += wave) {
    system::parallel_invoke(limit, write, [&] { make(first); });
    std::swap(made, written);
    if (report) report(std::min(count, first + wave));
  }
  write();
}

}  // namespace rondel::io
