// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files that several ranks regrid: the bytes of one process, and failures that all ranks tell.

#include "rondel/regrid_ranks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "rondel/fields.h"
#include "rondel/named_grids.h"
#include "rondel/names.h"
#include "support/simulated_ranks.h"
#include "support/temporary_files.h"

namespace rondel::test {
namespace {

std::string bytes_in(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Writes five times of a field on a grid between parallels.
void write_times(const std::string& path, const std::string& grid) {
  const NamedGrid named(grid);
  FieldSet fields;
  fields.num_points = named.num_cells();
  FieldArray warm{"warm", {"time"}, {5}, {}, {}, {}};
  for (std::size_t t = 0; t < 5; ++t) {
    for (const LonLat& place : named.centers()) {
      warm.values.push_back(std::sin(place.lat_deg / 20 + static_cast<double>(t)) +
                            std::cos(place.lon_deg / 30));
    }
  }
  fields.arrays = {warm};
  WeightSide side;
  side.axes = *named.axes();
  side.shape = named.shape();
  write_fields({path, {}}, fields, side);
}

// Regrids by so many ranks. Returns what each of them threw, or an empty text.
std::vector<std::string> run_ranks(SimulatedRanks& ranks, const std::string& in,
                                   const std::string& target, const std::string& out,
                                   const RegridFileOptions& options,
                                   std::vector<RegridFileReport>* reports = nullptr) {
  return ranks.run([&](Communicator& of_rank) {
    const RegridFileReport report =
        regrid_file(of_rank, {in, {}}, {target, {}}, {out, {}}, options, {.threads = 1});
    if (reports != nullptr) (*reports)[static_cast<std::size_t>(of_rank.rank())] = report;
  });
}

TEST(regrid_ranks, bytes_are_those_of_one_process) {
  const std::string in = temporary_path("ranks.nc");
  const std::string out = temporary_path("one.nc");
  const std::string other = temporary_path("many.nc");
  write_times(in, "grid:6");
  for (const FieldMethod method :
       {FieldMethod::conservative, FieldMethod::conservative_2nd, FieldMethod::largest_share,
        FieldMethod::sibson, FieldMethod::bilinear}) {
    for (const char* const target : {"healpix:3", "grid:5"}) {
      RegridFileOptions options{.method = method};
      const auto one = regrid_file({in, {}}, {target, {}}, {out, {}}, options);
      for (int size = 1; size <= 7; ++size) {
        for (const std::size_t tile : {0U, 300U}) {
          options.cells_per_tile = tile;
          SimulatedRanks ranks(size);
          std::vector<RegridFileReport> reports(static_cast<std::size_t>(size));
          for (const std::string& error : run_ranks(ranks, in, target, other, options, &reports)) {
            EXPECT_EQ(error, "");
          }
          EXPECT_TRUE(bytes_in(other) == bytes_in(out)) << name_of(method) << target << size;
          EXPECT_EQ(reports[0].missing, one.missing);
          for (const RegridFileReport& report : reports) {
            EXPECT_EQ(report.targets, one.targets);
            EXPECT_EQ(report.fields, 5U);
            EXPECT_EQ(report.tiles, reports[0].tiles);
          }
          std::filesystem::remove(other);
        }
      }
    }
  }
}

TEST(regrid_ranks, points_of_a_table_have_the_bytes_of_one_process) {
  const std::string in = temporary_path("ranks.nc");
  const std::string table = temporary_path("sites.csv");
  const std::string out = temporary_path("one.nc");
  const std::string other = temporary_path("many.nc");
  write_times(in, "grid:6");
  std::string text = "lon,lat,name\n";
  for (int k = 0; k < 500; ++k) {
    text += std::to_string(k * 7 % 361) + ',' + std::to_string(k * 11 % 181 - 90) + ",station " +
            std::to_string(k) + '\n';
  }
  std::ofstream(table) << text;
  RegridFileOptions options{.method = FieldMethod::linear};
  regrid_file({in, {}}, {table, {}}, {out, {}}, options);
  for (const std::size_t tile : {0U, 70U}) {
    options.cells_per_tile = tile;
    SimulatedRanks ranks(3);
    for (const std::string& error : run_ranks(ranks, in, table, other, options)) {
      EXPECT_EQ(error, "");
    }
    EXPECT_TRUE(bytes_in(other) == bytes_in(out)) << tile;
    std::filesystem::remove(other);
  }
}

TEST(regrid_ranks, a_rank_that_fails_anywhere_ends_all_and_another_run_goes_on) {
  const std::string in = temporary_path("ranks.nc");
  const std::string out = temporary_path("one.nc");
  const std::string other = temporary_path("many.nc");
  write_times(in, "grid:10");
  regrid_file({in, {}}, {"healpix:3", {}}, {out, {}});
  const RegridFileOptions options{.cells_per_tile = 200, .resume = true};
  std::uint64_t most = 0;
  for (std::uint64_t last = 0;; ++last) {
    SimulatedRanks failing(3);
    bool has_failed = false;
    failing.on_call = [&](int rank, std::uint64_t call) {
      if (rank != 1 || call != last) return;
      has_failed = true;
      throw std::runtime_error("as it was told");
    };
    const auto errors = run_ranks(failing, in, "healpix:3", other, options);
    if (!has_failed) {
      EXPECT_TRUE(bytes_in(other) == bytes_in(out));
      break;
    }
    for (const std::string& error : errors) EXPECT_NE(error, "") << last;
    SimulatedRanks ranks(2);
    std::vector<RegridFileReport> reports(2);
    for (const auto& error : run_ranks(ranks, in, "healpix:3", other, options, &reports)) {
      EXPECT_EQ(error, "");
    }
    most = std::max(most, reports[0].resumed);
    EXPECT_EQ(reports[0].resumed, reports[1].resumed);
    EXPECT_TRUE(bytes_in(other) == bytes_in(out)) << last;
    EXPECT_FALSE(std::filesystem::exists(other + ".partial"));
    std::filesystem::remove(other);
  }
  EXPECT_GE(most, 768U);
}

TEST(regrid_ranks, what_goes_wrong_is_told_by_all_ranks) {
  const std::string in = temporary_path("ranks.nc");
  const std::string out = temporary_path("wrong.nc");
  write_times(in, "grid:10");
  SimulatedRanks ranks(4);
  for (const std::string& error : run_ranks(ranks, temporary_path("none.nc"), "grid:6", out, {})) {
    EXPECT_EQ(error,
              "rank 0, regrid: " + temporary_path("none.nc") + ": No such file or directory");
  }
  for (const std::string& error : run_ranks(ranks, in, "grid:6", in, {})) {
    EXPECT_EQ(error, "rank 0, regrid: " + in + ": it is the file of the input, too");
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace rondel::test
