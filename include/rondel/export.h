// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What a shared library shows of itself: the names of these headers, and no others.
#pragma once

// A module of WebAssembly says itself what it shows; it is smaller without these attributes.
#if defined(__GNUC__) && !defined(__wasm__)
#define RONDEL_API __attribute__((visibility("default")))
#else
#define RONDEL_API
#endif
