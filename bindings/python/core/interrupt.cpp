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

constexpr std::size_t many_items = std::size_t{1} << 16;  // this takes some hundredths of a second
constexpr auto nap = 50ms;

// The data that the working and the watching thread share.
class Work {
 public:
  enum class State { works, tells, asks, has_ended };

  // With `has_listener` the end of each stage waits until the listener knows of it.
  Work(unsigned threads, bool has_listener, const WatchedWork& work)
      : has_listener_(has_listener), thread_([this, threads, &work] { run(threads, work); }) {}

  // Returns after a short time, or earlier if there is an answer to give or the work has ended.
  State wait() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, nap, [this] { return state_ != State::works; });
    return state_;
  }
  void stop() { stop_ = true; }
  void answer(bool has_raised) {
    const std::lock_guard lock(mutex_);
    has_raised_ = has_raised;
    state_ = State::works;
    changed_.notify_all();
  }
  // Calls the listener; for the last time only if there is something new.
  void tell(const nb::object& listener, bool is_last) {
    std::string stage;
    double fraction = 0;
    {
      const std::lock_guard lock(mutex_);
      if (is_last && is_told_) return;
      stage = stage_;
      fraction = fraction_;
      is_told_ = true;
    }
    if (!stage.empty()) listener(stage.c_str(), fraction);
  }
  // Call this when the work has ended, without the lock of the interpreter.
  std::exception_ptr join() {
    thread_.join();
    return error_;
  }

 private:
  void run(unsigned threads, const WatchedWork& work) {
    std::exception_ptr error;
    const auto progress = [this](std::string_view stage, double fraction) {
      report(stage, fraction);
    };
    try {
      work({.threads = threads, .progress = progress, .stop = &stop_},
           [this] { return ask(State::asks); });
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    error_ = error;
    state_ = State::has_ended;
    changed_.notify_all();
  }
  // Waits until the watching thread has answered whether something was raised.
  bool ask(State question) {
    const std::lock_guard one_by_one(asking_);
    std::unique_lock lock(mutex_);
    state_ = question;
    changed_.notify_all();
    changed_.wait(lock, [this] { return state_ == State::works; });
    return has_raised_;
  }
  void report(std::string_view stage, double fraction) {
    if (stop_) throw Interrupted();
    {
      const std::lock_guard lock(mutex_);
      stage_ = stage;
      fraction_ = fraction;
      is_told_ = false;
    }
    // An exception of the listener at the end of a stage ends the work before a file is complete.
    if (has_listener_ && fraction >= 1 && ask(State::tells)) throw Interrupted();
  }

  const bool has_listener_;
  std::mutex asking_;
  std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::works;
  bool has_raised_ = false;
  std::atomic<bool> stop_ = false;
  std::string stage_;
  double fraction_ = 0;
  bool is_told_ = false;  // whether the listener knows these two
  std::exception_ptr error_;
  std::thread thread_;  // the last member, since it uses the others
};

bool is_silent(const nb::object& progress) {
  return progress.is_none() || progress.ptr() == Py_False;
}

// The function that is told how far the work is: one that was given, or a bar that goes when this does.
class Listener {
 public:
  explicit Listener(const nb::object& progress) {
    if (is_silent(progress)) return;
    is_own_ = progress.ptr() == Py_True;
    function_ = is_own_ ? nb::module_::import_("rondel").attr("ProgressBar")() : progress;
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() {
    if (!is_own_) return;
    try {
      function_.attr("close")();
    } catch (nb::python_error& error) {
      error.discard_as_unraisable("rondel.ProgressBar.close");
    }
  }

  [[nodiscard]] bool is_there() const { return function_.is_valid(); }
  void tell(Work& work, bool is_last) const {
    if (is_there()) work.tell(function_, is_last);
  }

 private:
  nb::object function_;  // or invalid: nobody is told
  bool is_own_ = false;
};

// Runs signal handlers, then the listener; returns what one of them raises.
std::exception_ptr watch(Work& work, const Listener& listener, bool is_last) {
  try {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    listener.tell(work, is_last);
  } catch (const nb::python_error&) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace

void run_watched_until_asked(unsigned threads, const nb::object& progress,
                             const WatchedWork& work) {
  const Listener listener(progress);
  std::exception_ptr raised;
  std::exception_ptr error;
  {
    const nb::gil_scoped_release released;
    Work running(threads, listener.is_there(), work);
    bool is_watched = true;
    for (auto state = running.wait(); state != Work::State::has_ended; state = running.wait()) {
      if (is_watched && !raised) {
        const nb::gil_scoped_acquire acquired;
        raised = watch(running, listener, state == Work::State::asks);
        if (raised) running.stop();
      }
      if (state == Work::State::works) continue;
      if (state == Work::State::asks) is_watched = false;
      running.answer(raised != nullptr);
    }
    error = running.join();
  }
  if (raised) std::rethrow_exception(raised);
  if (error) std::rethrow_exception(error);
}

void run_watched(std::size_t size, unsigned threads, const nb::object& progress,
                 const std::function<void(const Execution&)>& work) {
  if (size < many_items && is_silent(progress)) {
    const nb::gil_scoped_release released;
    work({.threads = threads});
    return;
  }
  run_watched_until_asked(threads, progress,
                          [&](const Execution& execution, const std::function<bool()>& ask) {
                            work(execution);
                            ask();
                          });
}

}  // namespace rondel::python
