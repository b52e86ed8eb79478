// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The macro for the names that a shared library exports: those of these headers, and no others.
#pragma once

// WebAssembly modules list their exports elsewhere; they are smaller without these attributes.
#if defined(__GNUC__) && !defined(__wasm__)
#define RONDEL_API __attribute__((visibility("default")))
#else
#define RONDEL_API
#endif
