// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// delaunay_file: what it writes is what delaunay() finds, whatever the sites, the size of the buckets, of
// what is read at a time, and the moment at which a first run ends.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "distributed/out_of_core.h"
#include "fuzz/block_sites.h"
#include "fuzz/scratch_folder.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/io.h"

namespace rondel::fuzz {
namespace {

std::string bytes_behind_header(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return bytes.substr(bytes.find('\n') + 1);
}

template <class Row>
void require_rows(const std::string& path, std::span<const Row> rows, const char* what) {
  const std::string bytes = bytes_behind_header(path);
  require(bytes.size() == rows.size_bytes() &&
              (rows.empty() || std::memcmp(bytes.data(), rows.data(), bytes.size()) == 0),
          what);
}

// Ends when the progress was told so often.
struct Ended {};

OutOfCoreReport run(const std::string& sites, const OutOfCoreFiles& files,
                    const OutOfCoreOptions& out_of_core, const distributed::RunLimits& limits,
                    const Options& options, unsigned max_calls) {
  const io::NpyRows rows(sites, false);
  system::Job job{options, {.threads = 1}};
  unsigned num_calls = 0;
  job.progress = [&](std::string_view, double) {
    if (++num_calls > max_calls) throw Ended();
  };
  return distributed::run(rows, files, out_of_core, limits, job);
}

void test_run(const SiteSet& set, const Options& options, const distributed::RunLimits& limits,
              unsigned max_calls) {
  const ScratchFolder folder;
  const std::string sites = folder.file("sites.npy");
  const OutOfCoreFiles files = {folder.file("faces.npy"), folder.file("neighbors.npy"),
                                folder.file("areas.npy"), folder.file("duplicates.npy"),
                                folder.file("ghost_faces.npy")};
  OutOfCoreOptions out_of_core;
  out_of_core.scratch = folder.file("scratch");
  write_sites(sites, set.sites);
  OutOfCoreReport report;
  try {
    report = run(sites, files, out_of_core, limits, options, max_calls);
  } catch (const Ended&) {
    require(!std::filesystem::exists(files.faces), "a run that ends early writes nothing");
    out_of_core.resume = true;
    report = run(sites, files, out_of_core, limits, options, std::numeric_limits<unsigned>::max());
  }
  const Triangulation expected = delaunay(set.sites, options);
  require(report.dimension == expected.dimension(), "the dimension");
  require(report.num_vertices == expected.num_vertices(), "the vertices");
  require(report.num_hidden == expected.hidden().size(), "the hidden sites");
  require(report.num_ghost_faces == expected.num_ghost_faces(), "the ghost faces");
  require_rows(files.faces, expected.faces(), "the faces");
  require_rows(files.neighbors, expected.neighbors(), "the neighbors");
  const std::vector<double> expected_areas = areas(expected);
  require_rows(files.areas, std::span<const double>(expected_areas), "the areas");
  require_rows(files.duplicates, expected.duplicates(), "the duplicates");
  require_rows(files.ghost_faces, expected.ghost_faces(), "the ghost faces, by number");
  delaunay_file(sites, {files.faces}, out_of_core, options, {.threads = 1});
  require_rows(files.faces, expected.faces(), "the faces, with the usual limits");
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  const std::uint8_t mode = source.byte();
  constexpr std::uint64_t no_limit = std::uint64_t{1} << 40U;
  distributed::RunLimits limits;
  limits.max_bucket_sites = 5 + source.below(200);
  limits.max_num_sites = limits.max_open_sites = no_limit;
  limits.piece_sites = 10 + source.below(150);
  const unsigned max_calls = source.byte();
  const Model model = mode % 2 == 0 ? Model::weighted : Model::projected;
  const test::SiteSet set = fuzz::block_sites(source, model);
  fuzz::test_run(set, {.model = model, .sphere = set.sphere}, limits, max_calls);
  return 0;
}
