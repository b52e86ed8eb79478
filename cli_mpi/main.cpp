// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel-mpi triangulates and regrids by the processes that mpirun starts. Only rank 0 prints.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "regrid.h"
#include "rondel/distributed.h"
#include "rondel/mpi.h"
#include "rondel/version.h"

namespace rondel::cli {
namespace {

enum ExitStatus { done = 0, failed = 1, usage = 2 };

struct Arguments {
  std::string sites;
  DistributedFiles files;
  std::string model = "projected";
  unsigned threads = 0;  // 0: this rank's share
  bool is_json = false;
  bool is_quiet = false;
};

// Returns this rank's share of the cores of its machine, which its ranks share.
unsigned share_of_cores() {
  MPI_Comm neighbors = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &neighbors);
  int num_ranks = 1;
  MPI_Comm_size(neighbors, &num_ranks);
  MPI_Comm_free(&neighbors);
  return std::max(std::thread::hardware_concurrency() / static_cast<unsigned>(num_ranks), 1U);
}

void add_delaunay(CLI::App& tool, Arguments& arguments) {
  CLI::App& command = *tool.add_subcommand("delaunay", "Triangulate the sites of a .npy file");
  command.add_option("SITES", arguments.sites, "(n, 3) points or (n, 2) longitudes and latitudes")
      ->required();
  command.add_option("--output,-o", arguments.files.faces, "The triangles, (m, 3)")->required();
  command.add_option("--neighbors", arguments.files.neighbors,
                     "The triangles opposite to each corner, (m, 3)");
  command.add_option("--areas", arguments.files.areas, "The areas of the cells, (n,)");
  command.add_option("--circumcenters", arguments.files.circumcenters,
                     "The circumcenters of the triangles, (m, 3)");
  command.add_option("--duplicates", arguments.files.duplicates,
                     "Sites in one place and the lowest one there, (k, 2)");
  command.add_option("--model", arguments.model, "projected or weighted")
      ->check(CLI::IsMember({"projected", "weighted"}));
  command
      .add_option("--threads", arguments.threads,
                  "Threads of each process; default: its share of the cores")
      ->check(CLI::Range(1U, 1024U));
  command.add_flag("--radians", arguments.files.radians, "Longitudes and latitudes are in radians");
  command.add_flag("--json", arguments.is_json, "Print a JSON object");
  command.add_flag("--quiet", arguments.is_quiet, "Print nothing");
}

void print(const Arguments& arguments, const DistributedTriangulation& t, int num_ranks,
           double seconds) {
  const auto number = [](std::uint64_t value) { return std::to_string(value); };
  if (arguments.is_json) {
    std::printf(
        "{\"sites\": %s, \"vertices\": %s, \"faces\": %s, \"ghost_faces\": %s, \"duplicates\": %s, "
        "\"hidden\": %s, \"open_sites\": %s, \"dimension\": %d, \"ranks\": %d, \"seconds\": "
        "%.3f}\n",
        number(t.num_sites()).c_str(), number(t.num_vertices()).c_str(),
        number(t.num_faces()).c_str(), number(t.num_ghost_faces()).c_str(),
        number(t.num_duplicates()).c_str(), number(t.num_hidden()).c_str(),
        number(t.num_open_sites()).c_str(), t.dimension(), num_ranks, seconds);
  } else if (!arguments.is_quiet) {
    std::printf("%s sites: %s triangles in %s, by %d processes in %.1f s\n",
                number(t.num_sites()).c_str(), number(t.num_faces()).c_str(),
                arguments.files.faces.c_str(), num_ranks, seconds);
  }
}

int fail(bool is_speaker, ExitStatus status, std::string message) {
  std::ranges::replace(message, '\n', ' ');
  if (is_speaker) std::fprintf(stderr, "rondel-mpi: %s\n", message.c_str());
  return status;
}

// Returns the arguments that must be the same on all ranks.
std::string common_part(const Arguments& arguments) {
  const DistributedFiles& files = arguments.files;
  std::string text;
  for (const std::string& part :
       {arguments.sites, files.faces, files.neighbors, files.duplicates, files.areas,
        files.circumcenters, arguments.model, std::string(files.radians ? "radians" : "")}) {
    text += part + '\n';
  }
  return text;
}

// Returns true if all ranks can begin; otherwise one of them reports why.
bool agree(MpiCommunicator& ranks, const std::string& mine, const std::string& problem) {
  const std::string text = (problem.empty() ? '+' : '-') + mine;
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  const auto told = ranks.all_gather({bytes, bytes + text.size()});
  for (std::size_t rank = 0; rank < told.size(); ++rank) {
    const bool is_speaker = static_cast<int>(rank) == ranks.rank();
    if (told[rank].front() == std::byte{'-'}) {
      fail(is_speaker, usage, problem + " (see rondel-mpi --help)");
      return false;
    }
  }
  for (std::size_t rank = 1; rank < told.size(); ++rank) {
    if (told[rank] == told[0]) continue;
    fail(ranks.rank() == 0, usage,
         "rank " + std::to_string(rank) + " has other arguments than rank 0");
    return false;
  }
  return true;
}

int run(int argc, char** argv) {
  MpiCommunicator ranks(MPI_COMM_WORLD);
  CLI::App tool{
      "Exact Delaunay triangulations on the sphere, and regridding, by several processes."};
  tool.name("rondel-mpi");
  tool.set_version_flag("--version", std::string("rondel-mpi ") + version);
  tool.require_subcommand(1);
  Arguments arguments;
  add_delaunay(tool, arguments);
  RegridArguments regridding;
  const CLI::App& regrid_command = add_regrid(tool, regridding);
  std::string problem;
  std::string mine;
  int asked = failed;  // keeps the exit status when a text was asked for
  try {
    tool.parse(argc, argv);
    mine = regrid_command.parsed() ? common_part(regridding) : common_part(arguments);
  } catch (const CLI::Success& text) {
    mine = text.get_name();
    asked = ranks.rank() == 0 ? tool.exit(text) : done;
  } catch (const CLI::ParseError& error) {
    problem = error.what();
  }
  if (!agree(ranks, mine, problem)) return usage;
  if (asked == done) return done;
  try {
    const auto start = std::chrono::steady_clock::now();
    const unsigned share = share_of_cores();
    const unsigned threads = std::max(arguments.threads, regridding.threads);  // of one command
    const Execution execution = {.threads = threads == 0 ? share : threads};
    if (regrid_command.parsed()) {
      regrid(ranks, regridding, execution);
      return done;
    }
    const Model model = arguments.model == "weighted" ? Model::weighted : Model::projected;
    const auto triangulation =
        delaunay_file(ranks, arguments.sites, arguments.files, {}, {.model = model}, execution);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    if (ranks.rank() == 0) print(arguments, triangulation, ranks.size(), time.count());
    return done;
  } catch (const DistributedError& error) {
    return fail(ranks.rank() == 0, failed, error.what());
  }
}

}  // namespace
}  // namespace rondel::cli

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = rondel::cli::failed;
  try {
    status = rondel::cli::run(argc, argv);
  } catch (const std::exception& error) {  // only this rank failed: the others cannot go on
    std::fprintf(stderr, "rondel-mpi: %s\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, status);
  }
  MPI_Finalize();
  return status;
}
