// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The exceptions that Rondel throws. Degenerate input is never an error.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace rondel {

/// An argument breaks its contract: a coordinate that is not finite, a site at
/// the center of the sphere, an array of the wrong length, too many sites.
class InvalidInput : public std::invalid_argument {
 public:
  InvalidInput(const std::string& message, std::size_t index)
      : std::invalid_argument(message), index_(index) {}

  /// The first offending position of the array that the message names.
  [[nodiscard]] std::size_t index() const noexcept { return index_; }

 private:
  std::size_t index_;
};

/// A file cannot be read, understood or written. what() is one line that
/// starts with the file's name and, where there is one, the line's number:
/// "stations.csv:17: latitude 95.2 is outside [-90, 90]".
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace rondel
