// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Regridding of files by several processes (target rondel::distributed).
///
///     rondel::MpiCommunicator ranks(MPI_COMM_WORLD);
///     rondel::regrid_file(ranks, {"in.nc", {}}, {"healpix:10", {}}, {"out.nc", {}});
#pragma once

#include "rondel/distributed.h"
#include "rondel/export.h"
#include "rondel/regrid_files.h"

namespace rondel {

/// Regrids the fields of a file as regrid_file() of rondel/regrid_files.h does, with the same bytes
/// for any number of ranks. All ranks call it together with the same arguments; each reads the
/// input, from a disk that all of them see, and rank 0 writes the output.
///
/// Tiles of weights are divided among the ranks, or slices of fields if the weights have no tiles;
/// then each rank computes all weights. `options.memory` is that of each rank.
/// \param execution  the threads are those of one rank: ranks on one machine share its cores
/// \return the same report on all ranks, except that only rank 0 counts missing values
/// \throws DistributedError on all ranks: what regrid_file() would throw on one of them
/// \throws Interrupted on all ranks, if the flag of one of them is set
RONDEL_API RegridFileReport regrid_file(Communicator& ranks, const FileName& in,
                                        const FileName& target, const FileName& out,
                                        const RegridFileOptions& options = {},
                                        const Execution& execution = {});

}  // namespace rondel
