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

// The copies of the callback share this; the library may call them from several threads.
struct ProgressLine::Screen {
  using Clock = std::chrono::steady_clock;

  std::mutex mutex;
  Clock::time_point next = Clock::now() + std::chrono::milliseconds(300);
  bool is_dirty = false;

  // Overwrites the line. The first one comes after 0.3 seconds, so that short runs show nothing.
  void show(std::string_view stage, double fraction) {
    const std::lock_guard lock(mutex);
    const Clock::time_point now = Clock::now();
    if (now < next) return;
    next = now + std::chrono::milliseconds(100);
    is_dirty = true;
    const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
    const std::string name(stage);
    std::fprintf(stderr, "\r\x1b[Krondel: %s %d %%", name.c_str(), percent);
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
