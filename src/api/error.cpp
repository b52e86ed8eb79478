// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The exceptions have a home, so that there is one type of each in a program of several libraries.

#include "rondel/error.h"

namespace rondel {

InvalidInput::InvalidInput(const std::string& message, std::size_t index)
    : std::invalid_argument(message), index_(index) {}

InvalidInput::~InvalidInput() = default;

FileError::FileError(const std::string& message) : std::runtime_error(message) {}

FileError::FileError(const std::string& file, const std::error_code& code)
    : std::runtime_error(file + ": " + code.message()), code_(code) {}

FileError::~FileError() = default;

const char* Interrupted::what() const noexcept { return "interrupted"; }

}  // namespace rondel
