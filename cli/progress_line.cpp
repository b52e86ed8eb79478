// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "progress_line.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>

#include "process.h"

namespace rondel::cli {
namespace {

// Returns ", 2 min 05 s left" for a part of the work that has taken `seconds` so far; nothing while
// an estimate would be a guess: in the first second, and before a hundredth is done.
std::string time_left(double seconds, double fraction) {
  if (seconds < 1 || fraction < 0.01 || fraction >= 1) return {};
  const double left = std::min(seconds * (1 - fraction) / fraction, 359'999.0);
  const int whole = static_cast<int>(left) + 1;
  char text[48];
  if (whole < 60) {
    std::snprintf(text, sizeof text, ", %d s left", whole);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, ", %d min %02d s left", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, ", %d h %02d min left", whole / 3600, whole / 60 % 60);
  }
  return text;
}

}  // namespace

// The copies of the callback share this; the library may call them from several threads.
struct ProgressLine::Screen {
  using Clock = std::chrono::steady_clock;

  std::mutex mutex;
  Clock::time_point next = Clock::now() + std::chrono::milliseconds(300);
  bool is_dirty = false;
  std::string stage;  // that of the last call, which began at `start`
  Clock::time_point start;

  // Overwrites the line. The first one comes after 0.3 seconds, so that short runs show nothing.
  void show(std::string_view name, double fraction) {
    const std::lock_guard lock(mutex);
    const Clock::time_point now = Clock::now();
    if (name != stage) {
      stage = name;
      start = now;
    }
    if (now < next) return;
    next = now + std::chrono::milliseconds(100);
    is_dirty = true;
    const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
    const double seconds = std::chrono::duration<double>(now - start).count();
    std::fprintf(stderr, "\r\x1b[Krondel: %s %d %%%s", stage.c_str(), percent,
                 time_left(seconds, fraction).c_str());
    std::fflush(stderr);
  }

  // Clears the line, if there is one, before something else is printed.
  void clear() {
    const std::lock_guard lock(mutex);
    if (!is_dirty) return;
    is_dirty = false;
    std::fputs("\r\x1b[K", stderr);
    std::fflush(stderr);
  }
};

ProgressLine::ProgressLine(bool is_quiet) {
  if (is_quiet || !has_terminal()) return;
  screen_ = std::make_shared<Screen>();
  callback_ = [screen = screen_](std::string_view stage, double fraction) {
    screen->show(stage, fraction);
  };
}

void ProgressLine::clear() noexcept {
  if (screen_) screen_->clear();
}

}  // namespace rondel::cli
