// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Libraries that are loaded while a program runs.
#pragma once

#include <string>

namespace rondel::system {

// A library that the system finds by its name or path; nullptr if there is none, or where programs cannot load
// libraries. It stays loaded, and its names are no one else's.
void* open_library(const std::string& name) noexcept;

// What the library calls so; nullptr if it has no such name.
void* symbol_of(void* library, const char* name) noexcept;

}  // namespace rondel::system
