// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// One line on a terminal that says how far the work is; nothing anywhere else.
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

  /// Empty where nothing is shown, so that the library does not even call it.
  [[nodiscard]] const Progress& callback() const noexcept { return callback_; }
  /// Leaves the terminal's line blank.
  void clear() noexcept;

 private:
  struct Screen;
  std::shared_ptr<Screen> screen_;
  Progress callback_;
};

}  // namespace rondel::cli
