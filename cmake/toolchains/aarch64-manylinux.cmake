# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
set(RONDEL_MACHINE aarch64)
include(${CMAKE_CURRENT_LIST_DIR}/manylinux.cmake)
