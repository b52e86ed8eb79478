// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "measure.h"

#include <sys/resource.h>

#include <cstdio>
#include <fstream>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace rondel::bench {
namespace {

// Returns a line of /proc/self/status in bytes; 0 if there is none.
double status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key)) return 1024 * std::stod(line.substr(key.size()));
  }
  return 0;
}

double peak_bytes() {
  if (const double peak = status_bytes("VmHWM:"); peak > 0) return peak;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

MemoryMeter::MemoryMeter() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
  // By proc(5), "5" resets the peak to the present size.
  std::ofstream("/proc/self/clear_refs") << 5;
  before_ = peak_bytes();
}

double MemoryMeter::growth_bytes() const { return peak_bytes() - before_; }

void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

void print_json(std::initializer_list<Field> fields) {
  const char* separator = "{";
  for (const auto& [name, value] : fields) {
    std::printf("%s\"%s\": %.15g", separator, name, value);
    separator = ", ";
  }
  std::puts("}");
}

}  // namespace rondel::bench
