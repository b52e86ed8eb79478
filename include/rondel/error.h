// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The exceptions that Rondel throws. Degenerate input is never an error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <system_error>

#include "rondel/export.h"

namespace rondel {

/// An argument breaks its contract: a coordinate that is not finite, a site at
/// the center of the sphere, an array of the wrong length, too many sites.
class RONDEL_API InvalidInput : public std::invalid_argument {
 public:
  /// The index of an error that is not about an array.
  static constexpr std::size_t no_index = SIZE_MAX;

  explicit InvalidInput(const std::string& message, std::size_t index = no_index);
  InvalidInput(const InvalidInput&) = default;
  InvalidInput& operator=(const InvalidInput&) = default;
  ~InvalidInput() override;

  /// Returns the first offending position of the array that the message names, or no_index if the
  /// error is not about an array.
  [[nodiscard]] std::size_t index() const noexcept { return index_; }

 private:
  std::size_t index_;
};

/// A file cannot be read, understood or written. what() is one line that
/// starts with the file's name and, where there is one, the line's number:
/// "stations.csv:17: latitude 95.2 is outside [-90, 90]". Where the system refused, code() is its
/// error and what() is the file's name and the text of that error.
class RONDEL_API FileError : public std::runtime_error {
 public:
  explicit FileError(const std::string& message);
  /// An error that the system reported for a file: errno in the generic category.
  FileError(const std::string& file, const std::error_code& code);
  FileError(const FileError&) = default;
  FileError& operator=(const FileError&) = default;
  ~FileError() override;

  /// Returns the error of the operating system, or no error (false as a condition) if it did not
  /// report one.
  [[nodiscard]] const std::error_code& code() const noexcept { return code_; }

 private:
  std::error_code code_;
};

/// The flag of an Execution was set before the work was done.
class RONDEL_API Interrupted : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override;
};

}  // namespace rondel
