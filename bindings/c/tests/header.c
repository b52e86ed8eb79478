/* SPDX-FileCopyrightText: The Rondel authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What only a C compiler can say of the header: that it is C, and that C sees the sizes that C++ sees. */
#include <rondel.h>

size_t c_size_of_options(void);
size_t c_size_of_execution(void);

size_t c_size_of_options(void) { return sizeof(rondel_options); }
size_t c_size_of_execution(void) { return sizeof(rondel_execution); }
