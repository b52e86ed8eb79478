// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Builds by processes of MPI: rank 0 puts together what all have, and compares it with the build in
// memory. With --fail, one rank after the other has a site that is not valid.

#include "rondel/mpi.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "inputs/kinds.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/distributed.h"

namespace rondel::test {
namespace {

using Bytes = Communicator::Bytes;

int num_failures = 0;

void expect(bool condition, const std::string& what) {
  if (condition) return;
  ++num_failures;
  std::printf("failed: %s\n", what.c_str());
}

// All values of all ranks, on each rank.
template <class T>
std::vector<T> together(Communicator& ranks, std::span<const T> mine) {
  Bytes bytes(mine.size_bytes());
  if (!mine.empty()) std::memcpy(bytes.data(), mine.data(), bytes.size());
  std::vector<T> all;
  for (const Bytes& part : ranks.all_gather(std::move(bytes))) {
    const std::size_t begin = all.size();
    all.resize(begin + part.size() / sizeof(T));
    if (!part.empty()) std::memcpy(&all[begin], part.data(), part.size());
  }
  return all;
}

std::span<const Point> share(std::span<const Point> sites, const Communicator& ranks) {
  const auto size = static_cast<std::size_t>(ranks.size());
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const std::size_t begin = sites.size() * rank / size;
  return sites.subspan(begin, sites.size() * (rank + 1) / size - begin);
}

std::vector<GlobalTriple> widened(std::span<const Triple> rows) {
  std::vector<GlobalTriple> result;
  for (const Triple& row : rows) result.push_back({row[0], row[1], row[2]});
  return result;
}

void compare(Communicator& ranks, std::span<const Point> sites, const Options& options,
             const std::string& name) {
  const auto part =
      delaunay(ranks, share(sites, ranks),
               {.max_bucket_sites = 1000, .max_scattered_sites = 500, .keep_points = true}, options,
               {.threads = 1});
  std::vector<GlobalTriple> own;
  const auto keep = [&](std::span<const GlobalTriple> rows) {
    own.insert(own.end(), rows.begin(), rows.end());
  };
  part.visit_faces(keep);
  const auto faces = together(ranks, std::span<const GlobalTriple>(own));
  own.clear();
  part.visit_neighbors(keep);
  const auto neighbors = together(ranks, std::span<const GlobalTriple>(own));
  const auto duplicates = together(ranks, part.duplicates());
  const auto hidden = together(ranks, part.hidden());
  const auto own_areas = areas(ranks, part, {.threads = 1});
  const auto all_areas = together(ranks, std::span<const double>(own_areas));
  if (ranks.rank() != 0) return;
  const Triangulation expected = delaunay(Sites::view(sites), options, {.threads = 1});
  expect(part.dimension() == expected.dimension(), name + ": dimension");
  expect(part.num_vertices() == expected.num_vertices(), name + ": vertices");
  expect(faces == widened(expected.faces()), name + ": faces");
  expect(neighbors == widened(expected.neighbors()), name + ": neighbors");
  expect(duplicates.size() == expected.duplicates().size(), name + ": duplicates");
  expect(hidden.size() == expected.hidden().size(), name + ": hidden sites");
  expect(all_areas == areas(expected, {.threads = 1}), name + ": areas");
}

void compare_all(Communicator& ranks) {
  for (const char* name : {"uniform", "cluster", "small-circle", "great-circle", "ball"}) {
    std::vector<Point> sites = inputs::make(*inputs::find_kind(name), {.n = 3000}).sites;
    sites.push_back(sites[17]);
    for (const Model model : {Model::projected, Model::weighted})
      compare(ranks, sites, {.model = model}, name);
  }
  compare(ranks, {}, {}, "none");
}

// Messages of all sizes, which say where they come from.
void exchange_pieces(Communicator& ranks) {
  for (const unsigned length : {0U, 1U, 6U, 7U, 8U, 40U}) {
    std::vector<Bytes> messages;
    const auto mark = [](int from, int to) { return static_cast<std::byte>(16 * from + to); };
    const auto size_of = [&](int from, int to) {
      return length * static_cast<std::size_t>((from + 2 * to) % 3);
    };
    for (int r = 0; r < ranks.size(); ++r)
      messages.emplace_back(size_of(ranks.rank(), r), mark(ranks.rank(), r));
    const auto received = ranks.exchange(std::move(messages));
    for (int r = 0; r < ranks.size(); ++r) {
      expect(received[static_cast<std::size_t>(r)] ==
                 Bytes(size_of(r, ranks.rank()), mark(r, ranks.rank())),
             "a message of an exchange");
    }
    const auto gathered = ranks.all_gather(Bytes(size_of(ranks.rank(), 0), mark(ranks.rank(), 0)));
    for (int r = 0; r < ranks.size(); ++r) {
      expect(gathered[static_cast<std::size_t>(r)] == Bytes(size_of(r, 0), mark(r, 0)),
             "a message of an all-gather");
    }
  }
}

void fail_each(Communicator& ranks) {
  for (int failing = 0; failing < ranks.size(); ++failing) {
    std::vector<Point> sites(10, {1, 2, 3});
    if (ranks.rank() == failing) sites[3].z = std::numeric_limits<double>::infinity();
    const std::string expected = "rank " + std::to_string(failing) + ", count: site " +
                                 std::to_string(10 * failing + 3) + ": (1, 2, inf) is not finite";
    try {
      delaunay(ranks, sites, {}, {}, {.threads = 1});
      expect(false, "an error");
    } catch (const DistributedError& error) {
      expect(error.what() == expected, error.what());
      expect(error.rank() == failing, "the rank that failed");
    }
  }
}

}  // namespace
}  // namespace rondel::test

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  {
    rondel::MpiCommunicator ranks(MPI_COMM_WORLD);
    if (argc > 1 && std::string_view(argv[1]) == "--fail") {
      rondel::test::fail_each(ranks);
    } else {
      rondel::MpiCommunicator in_pieces(MPI_COMM_WORLD, 7);
      rondel::test::exchange_pieces(in_pieces);
      rondel::test::compare_all(ranks);
    }
  }
  MPI_Finalize();
  return rondel::test::num_failures == 0 ? 0 : 1;
}
