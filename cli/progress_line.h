// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// A line on a terminal that shows the progress; nothing if there is no terminal.
///
/// in    the stage of the library's work and its share that is done, from 0 to 1
/// out   text on standard error
#pragma once

#include <memory>

#include "rondel/types.h"

namespace rondel::cli {

/// Shows "rondel: triangulate 42 %" on stderr and overwrites it, at most ten times a second.
class ProgressLine {
 public:
  /// Shows nothing if stderr is not a terminal or `is_quiet`.
  explicit ProgressLine(bool is_quiet);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Returns the callback, which is empty if nothing is shown, so that the library does not call
  /// it.
  [[nodiscard]] const Progress& callback() const noexcept { return callback_; }
  /// Clears the terminal's line.
  void clear() noexcept;

 private:
  struct Screen;
  std::shared_ptr<Screen> screen_;
  Progress callback_;
};

}  // namespace rondel::cli
