// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interrupt.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include "rondel/error.h"

namespace rondel::python {
namespace {

namespace nb = nanobind;
using namespace std::chrono_literals;

constexpr std::size_t many_items = std::size_t{1} << 16;  // some hundredths of a second
constexpr auto nap = 50ms;

// What the thread that works and the one that watches share.
class Work {
 public:
  Work(unsigned threads, const std::function<void(const Execution&)>& work)
      : thread_([this, threads, &work] { run(threads, work); }) {}

  // Whether the work ended within a nap.
  bool wait() {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, nap, [this] { return has_ended_; });
  }
  void stop() { stop_ = true; }
  void tell(const nb::object& listener) {
    std::string stage;
    double fraction = 0;
    {
      const std::lock_guard lock(mutex_);
      stage = stage_;
      fraction = fraction_;
    }
    if (!stage.empty()) listener(stage.c_str(), fraction);
  }
  // After the end, and without the lock of the interpreter.
  std::exception_ptr join() {
    thread_.join();
    return error_;
  }

 private:
  void run(unsigned threads, const std::function<void(const Execution&)>& work) {
    std::exception_ptr error;
    const auto progress = [this](std::string_view stage, double fraction) {
      report(stage, fraction);
    };
    try {
      work({.threads = threads, .progress = progress, .stop = &stop_});
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    error_ = error;
    has_ended_ = true;
    ended_.notify_one();
  }
  void report(std::string_view stage, double fraction) {
    if (stop_) throw Interrupted();
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    fraction_ = fraction;
  }

  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::atomic<bool> stop_ = false;
  std::string stage_;
  double fraction_ = 0;
  std::exception_ptr error_;
  std::thread thread_;  // last: it uses the others
};

// Handlers of signals, then the listener; what one of them raises.
std::exception_ptr watch(Work& work, const nb::object& listener) {
  try {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (!listener.is_none()) work.tell(listener);
  } catch (const nb::python_error&) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace

void run_watched(std::size_t size, unsigned threads, const nb::object& listener,
                 const std::function<void(const Execution&)>& work) {
  if (size < many_items && listener.is_none()) {
    const nb::gil_scoped_release released;
    work({.threads = threads});
    return;
  }
  std::exception_ptr raised;
  std::exception_ptr error;
  {
    const nb::gil_scoped_release released;
    Work running(threads, work);
    while (!running.wait()) {
      if (raised) continue;
      const nb::gil_scoped_acquire acquired;
      raised = watch(running, listener);
      if (raised) running.stop();
    }
    error = running.join();
    if (!raised && !error) {
      const nb::gil_scoped_acquire acquired;
      raised = watch(running, listener);
    }
  }
  if (raised) std::rethrow_exception(raised);
  if (error) std::rethrow_exception(error);
}

}  // namespace rondel::python
