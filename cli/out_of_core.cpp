// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel delaunay --scratch triangulates from a file to files.

#include "rondel/out_of_core.h"

#include "report.h"
#include "run.h"

namespace rondel::cli {
ExitStatus run_out_of_core(const DelaunayOptions& options) {
  const CommonOptions& common = options.common;
  CommonOptions input;
  input.output = common.input;
  input.output_format = common.input_format;
  if (common.input == "-" || input.format() != "npy")
    throw UsageError("INPUT: with --scratch '" + common.input + "' must be a .npy file");
  if (common.output == "-" || common.format() != "npy")
    throw UsageError("--output: with --scratch '" + common.output + "' must be a .npy file");
  require_output(common, true, ".npy");
  require_array("--neighbors", options.neighbors);
  require_array("--areas", options.areas);
  require_array("--duplicates", options.duplicates);
  if (!common.read.radius.empty())
    throw UsageError(
        "--radius: .npy files have no names for columns; give weighted sites as x, y, z");
  Job job(common);
  OutOfCoreOptions out_of_core;
  if (options.memory != 0) out_of_core.memory = options.memory;
  out_of_core.scratch = options.scratch;
  out_of_core.resume = options.resume;
  out_of_core.radians = common.read.radians;
  const OutOfCoreReport report = delaunay_file(
      common.input, {common.output, options.neighbors, options.areas, options.duplicates},
      out_of_core, common.build, job.execution());
  job.report(out_of_core_json_report(report, common.build.model, job.seconds()),
             out_of_core_summary(report, common.build.model, job.seconds(), common.output));
  return done;
}

}  // namespace rondel::cli
