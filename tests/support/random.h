// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "inputs/random.h"

namespace rondel::test {

using inputs::Random;

}  // namespace rondel::test
