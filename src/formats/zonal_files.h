// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Statistics of the fields of a file in the cells of another one: regrid_file() with statistics.
#pragma once

#include "rondel/regrid_files.h"

namespace rondel::formats {

RegridFileReport write_zonal_statistics(const FileName& in, const FileName& target,
                                        const FileName& out, const RegridFileOptions& options,
                                        const Execution& execution);

}  // namespace rondel::formats
