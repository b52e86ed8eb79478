// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writers of files without enough memory.
#pragma once

#include <filesystem>
#include <string>

#include "faults/failing_allocation.h"
#include "unit/io/support.h"

namespace rondel::test {

// Each attempt writes the whole file or none.
template <class Write>
void expect_file_or_bad_alloc(const std::string& ending, const Write& write) {
  SCOPED_TRACE(ending);
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory.file("out" + ending);
  write(path.string());
  const std::string expected = read_all(path);
  std::filesystem::remove(path);
  fail_each_allocation([&](std::size_t n, Shortage shortage) {
    bool is_written = false;
    FailingAllocation failing(n, shortage);
    try {
      write(path.string());
      is_written = true;
    } catch (const std::bad_alloc&) {  // as it should be
    }
    const bool has_failed = failing.stop();
    EXPECT_TRUE(has_failed || is_written);
    EXPECT_EQ(is_written ? expected : std::string(), read_all(path));
    EXPECT_EQ(directory.num_files(), is_written ? 1U : 0U);
    std::filesystem::remove(path);
    return has_failed;
  });
}

}  // namespace rondel::test
