// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Libraries that are loaded while a program runs.
#pragma once

#include <string>

namespace rondel::system {

// A library that the system finds by its name or path; nullptr if there is none, or where programs cannot load
// libraries. It stays loaded, and its symbols are not visible to other libraries.
void* open_library(const std::string& name) noexcept;

// The address of a symbol of the library; nullptr if it has none of this name.
void* symbol_of(void* library, const char* name) noexcept;

}  // namespace rondel::system
