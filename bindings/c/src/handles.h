// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The content of the handles of rondel.h, and what its functions share. C++ exceptions become
// statuses here.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondel.h"
#include "rondel/rondel.h"

// NOLINTBEGIN(readability-identifier-naming): C's names
struct rondel_stop {
  std::atomic<bool> is_requested{false};
};

struct rondel_triangulation {
  rondel::Triangulation triangulation;
  std::vector<std::uint32_t> duplicates;  // pairs, as C reads them
  std::vector<std::uint32_t> hidden;

  explicit rondel_triangulation(rondel::Triangulation made);
};

struct rondel_diagram {
  rondel::Diagram diagram;
};

struct rondel_lists {
  rondel::CompressedRows<rondel::Index> rows;
};

struct rondel_dynamic {
  std::shared_ptr<rondel::DynamicTriangulation> dynamic;
};

struct rondel_locator {
  std::shared_ptr<const rondel::DynamicTriangulation>
      dynamic;  // that the locator refers to, or none
  rondel::Locator locator;
};

// NOLINTEND(readability-identifier-naming)

namespace rondel::c {

// Returns the status of the exception that is being handled; keeps its message for this thread.
rondel_status status_of_exception() noexcept;

// Runs `work` and returns its status.
template <class Work>
rondel_status guarded(const Work& work) noexcept {
  try {
    work();
    return RONDEL_OK;
  } catch (...) {
    return status_of_exception();
  }
}

// Sets the text that the next rondel_error_message() of this thread returns.
void set_message(const std::string& message);

// \throws InvalidInput that names the argument if it is NULL
void require(const void* argument, const char* name);

// Returns a copy of n points; `name` is the name of the argument.
std::vector<Point> copied_points(const double* points, std::size_t n, const char* name);

// Returns a view of n indices.
std::span<const Index> indices_at(const std::uint32_t* indices, std::size_t n, const char* name);

// Read options, which may be NULL or a struct of a known size.
Options options_of(const rondel_options* options);
Execution execution_of(const rondel_execution* execution);

// Writes points as 3 doubles each.
void write_points(std::span<const Point> points, double* out);

// Runs `make`, which returns a pointer to a new handle, and stores that at `*handle`; stores NULL
// after a failure.
template <class Handle, class Make>
rondel_status make_handle(Handle** handle, const Make& make) {
  if (handle != nullptr) *handle = nullptr;
  return guarded([&] {
    require(handle, "the place for the handle");
    std::unique_ptr<Handle> made = make();
    *handle = made.release();
  });
}

}  // namespace rondel::c
