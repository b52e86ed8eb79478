// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What a shared library shows of itself: the names of these headers, and no others.
#pragma once

#if defined(__GNUC__)
#define RONDEL_API __attribute__((visibility("default")))
#else
#define RONDEL_API
#endif
