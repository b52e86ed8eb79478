// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Versions, errors and options.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "handles.h"
#include "rondel.h"
#include "rondel/error.h"
#include "rondel/types.h"
#include "rondel/version.h"

namespace rondel::c {
namespace {

// The record of the last failed call of a thread. Its size is fixed, because there may be no
// memory.
struct Failure {
  static constexpr std::size_t capacity = 1024;
  char message[capacity] = "";
  std::size_t index = 0;
};

thread_local Failure last_failure;

void keep(std::string_view message, std::size_t index) noexcept {
  const std::size_t length = std::min(message.size(), Failure::capacity - 1);
  std::copy_n(message.begin(), length, last_failure.message);
  last_failure.message[length] = '\0';
  last_failure.index = index;
}

rondel_status failed(rondel_status status, std::string_view message,
                     std::size_t index = 0) noexcept {
  keep(message, index);
  return status;
}

}  // namespace

rondel_status status_of_exception() noexcept {
  try {
    throw;
  } catch (const InvalidInput& error) {
    return failed(RONDEL_INVALID_INPUT, error.what(),
                  error.index() == InvalidInput::no_index ? 0 : error.index());
  } catch (const Interrupted& error) {
    return failed(RONDEL_INTERRUPTED, error.what());
  } catch (const std::bad_alloc&) {
    return failed(RONDEL_OUT_OF_MEMORY, "out of memory");
  } catch (const std::length_error&) {
    return failed(RONDEL_OUT_OF_MEMORY, "larger than an array can be");
  } catch (const std::exception& error) {
    return failed(RONDEL_FAILED, error.what());
  } catch (...) {
    return failed(RONDEL_FAILED, "unknown failure");
  }
}

void set_message(const std::string& message) { keep(message, 0); }

void require(const void* argument, const char* name) {
  if (argument == nullptr) throw InvalidInput(std::string(name) + " is NULL");
}

std::vector<Point> copied_points(const double* points, std::size_t n, const char* name) {
  if (n > 0) require(points, name);
  if (n > max_sites) throw InvalidInput(std::string(name) + ": more than can be", max_sites);
  std::vector<Point> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    result[i] = {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
  }
  return result;
}

std::span<const Index> indices_at(const std::uint32_t* indices, std::size_t n, const char* name) {
  if (n > 0) require(indices, name);
  return {indices, n};
}

Options options_of(const rondel_options* options) {
  if (options == nullptr) return {};
  if (options->size != sizeof(rondel_options)) {
    throw InvalidInput("the options were not made by rondel_options_init()");
  }
  if (options->model != RONDEL_PROJECTED && options->model != RONDEL_WEIGHTED) {
    throw InvalidInput("model " + std::to_string(options->model) + " is unknown");
  }
  const double* center = options->center;
  return {options->model == RONDEL_PROJECTED ? Model::projected : Model::weighted,
          {{center[0], center[1], center[2]}, options->squared_radius}};
}

Execution execution_of(const rondel_execution* execution) {
  if (execution == nullptr) return {};
  if (execution->size != sizeof(rondel_execution)) {
    throw InvalidInput("the execution was not made by rondel_execution_init()");
  }
  Execution result;
  result.threads = execution->threads;
  if (execution->stop != nullptr) result.stop = &execution->stop->is_requested;
  if (execution->progress != nullptr) {
    result.progress = [call = execution->progress, context = execution->context](
                          std::string_view stage, double fraction) {
      if (call(context, std::string(stage).c_str(), fraction) != 0) throw Interrupted();
    };
  }
  return result;
}

void write_points(std::span<const Point> points, double* out) {
  for (const Point& p : points) {
    *out++ = p.x;
    *out++ = p.y;
    *out++ = p.z;
  }
}

}  // namespace rondel::c

extern "C" {

const char* rondel_version_string(void) { return rondel::version; }

const char* rondel_error_message(void) { return rondel::c::last_failure.message; }

size_t rondel_error_index(void) { return rondel::c::last_failure.index; }

void rondel_options_init(rondel_options* options) {
  if (options != nullptr) {
    *options = {sizeof(rondel_options), RONDEL_PROJECTED, {0, 0, 0}, 1};
  }
}

void rondel_execution_init(rondel_execution* execution) {
  if (execution != nullptr) *execution = {sizeof(rondel_execution), 0, nullptr, nullptr, nullptr};
}

rondel_status rondel_stop_create(rondel_stop** stop) {
  return rondel::c::make_handle(stop, [] { return std::make_unique<rondel_stop>(); });
}

void rondel_stop_request(rondel_stop* stop) {
  if (stop != nullptr) stop->is_requested = true;
}

void rondel_stop_free(rondel_stop* stop) { delete stop; }

}  // extern "C"
