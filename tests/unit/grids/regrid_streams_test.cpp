// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regridding of files in little memory, runs that are resumed, and files that change.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/named_grids.h"
#include "rondel/names.h"
#include "rondel/regrid_files.h"
#include "support/temporary_files.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

std::string bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::string& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

// Writes four times of "warm", which has gaps, and "kind" with flags, on a named grid. The gap
// moves with time.
void write_fields_on(const std::string& path, const std::string& grid) {
  const NamedGrid named(grid);
  FieldSet fields;
  fields.num_points = named.num_cells();
  FieldArray warm{"warm", {"time"}, {4}, {}, {{"units", "K"}}, {}};
  FieldArray kind{"kind", {}, {}, {}, {{"flag_meanings", "a b c"}}, {{"flag_values", {1, 2, 3}}}};
  const std::vector<LonLat> places = named.centers();
  for (std::size_t t = 0; t < 4; ++t) {
    for (const LonLat& place : places) {
      const bool is_gap = place.lon_deg > 100 + 10 * static_cast<double>(t) && place.lat_deg < -30;
      warm.values.push_back(is_gap ? std::numeric_limits<double>::quiet_NaN()
                                   : static_cast<double>(t) + std::sin(place.lat_deg / 20) +
                                         std::cos(place.lon_deg / 30));
    }
  }
  for (const LonLat& place : places) {
    kind.values.push_back(1 + std::fmod(std::floor(std::abs(place.lat_deg) / 25), 3));
  }
  fields.arrays = {warm, kind};
  WeightSide side;
  if (named.axes() != nullptr) {
    side.axes = *named.axes();
  } else {
    side.points = places;
    fields.attributes.emplace_back(grid_attribute, grid);
  }
  side.shape = named.shape();
  write_fields({path, {}}, fields, side);
}

RegridFileReport run(const std::string& in, const std::string& target, const std::string& out,
                     const RegridFileOptions& options = {}, const Execution& execution = {}) {
  return regrid_file({in, {}}, {target, {}}, {out, {}}, options, execution);
}

std::string why_not(const std::string& in, const std::string& target, const std::string& out,
                    const RegridFileOptions& options = {}) {
  return thrown_message<std::exception>([&] { return run(in, target, out, options); });
}

// Returns the number of bytes that a refusal says are enough: it has "... small: 12M are enough".
std::uint64_t enough_of(const std::string& refusal) {
  const std::size_t at = refusal.find("small: ");
  EXPECT_NE(at, std::string::npos) << refusal;
  return at == std::string::npos ? 0 : std::stoull(refusal.substr(at + 7)) << 20U;
}

// Ends a run when it has announced so many steps.
struct EndedRun : std::runtime_error {
  EndedRun() : std::runtime_error("ended") {}
};
Execution ending_after(std::size_t steps) {
  return {.threads = 1, .progress = [left = steps](std::string_view stage, double) mutable {
            if (stage == "regrid" && left-- == 0) throw EndedRun();
          }};
}

// Runs until so many steps are done; returns false if the run came to its end before.
bool end_early(const std::string& in, const std::string& target, const std::string& out,
               const RegridFileOptions& options, std::size_t steps) {
  try {
    run(in, target, out, options, ending_after(steps));
  } catch (const EndedRun&) {
    return true;
  }
  return false;
}

TEST(regrid_streams, methods_between_places_have_the_same_bytes_in_tiles) {
  const std::string in = temporary_path("streams.nc");
  const std::string out = temporary_path("whole.nc");
  const std::string other = temporary_path("tiles.nc");
  write_fields_on(in, "grid:12");
  for (const FieldMethod method :
       {FieldMethod::nearest, FieldMethod::linear, FieldMethod::laplace, FieldMethod::sibson,
        FieldMethod::hermite, FieldMethod::cubic, FieldMethod::bilinear}) {
    for (const char* const target : {"healpix:3", "F10", "C8"}) {
      EXPECT_EQ(run(in, target, out, {.method = method}).tiles, 0U);
      const std::string whole = bytes_of_file(out);
      for (const std::size_t tile : {7U, 100U, 5000U}) {
        for (const unsigned threads : {1U, 2U}) {
          const RegridFileReport report = run(
              in, target, other, {.method = method, .cells_per_tile = tile}, {.threads = threads});
          EXPECT_EQ(report.tiles, (report.targets + tile - 1) / tile);
          EXPECT_TRUE(bytes_of_file(other) == whole) << name_of(method) << ' ' << target << tile;
        }
      }
    }
  }
}

TEST(regrid_streams, little_memory_gives_the_same_bytes_or_a_number_that_does) {
  const std::string in = temporary_path("streams.nc");
  const std::string out = temporary_path("whole.nc");
  const std::string other = temporary_path("tiles.nc");
  write_fields_on(in, "grid:1");
  std::filesystem::remove(other);
  std::size_t num_tiled = 0;
  for (const FieldMethod method :
       {FieldMethod::conservative, FieldMethod::largest_share, FieldMethod::nearest,
        FieldMethod::bilinear, FieldMethod::linear}) {
    for (const char* const target : {"grid:0.75", "healpix:5"}) {
      EXPECT_EQ(run(in, target, out, {.method = method}).tiles, 0U);
      const std::string refusal = why_not(in, target, other, {.method = method, .memory = 1000});
      const std::uint64_t enough = enough_of(refusal);
      EXPECT_LT(enough, std::uint64_t{40} << 20U) << refusal;
      EXPECT_FALSE(std::filesystem::exists(other));
      for (const unsigned threads : {1U, 3U}) {
        const auto report =
            run(in, target, other, {.method = method, .memory = enough}, {.threads = threads});
        num_tiled += report.tiles > 1 ? 1 : 0;
        EXPECT_TRUE(bytes_of_file(other) == bytes_of_file(out)) << name_of(method) << target;
        std::filesystem::remove(other);
      }
      const std::uint64_t less = enough - (std::uint64_t{1} << 20U);
      EXPECT_EQ(enough_of(why_not(in, target, other, {.method = method, .memory = less})), enough);
    }
  }
  EXPECT_GE(num_tiled, 10U);  // a method between places has one tile of few targets
}

// Fields with gaps that move, vectors and masks: gradients of order 2 in tiles.
TEST(regrid_streams, weights_of_order_2_are_the_same_in_tiles) {
  const std::string in = temporary_path("streams.nc");
  const std::string whole = temporary_path("whole2.nc");
  const std::string tiles = temporary_path("tiles2.nc");
  for (const char* const source : {"grid:5", "O12", "tripolar:10"}) {
    write_fields_on(in, source);
    for (const char* const target : {"healpix:3", "grid:9", "F10"}) {
      for (const RemapNorm norm : {RemapNorm::fracarea, RemapNorm::destarea}) {
        RegridFileOptions options{.method = FieldMethod::conservative_2nd, .norm = norm};
        EXPECT_EQ(run(in, target, whole, options).tiles, 0U);
        for (const std::size_t cells : {60U, 700U}) {
          options.cells_per_tile = cells;
          EXPECT_GT(run(in, target, tiles, options).tiles, 1U) << source << ' ' << target;
          EXPECT_EQ(bytes_of_file(tiles), bytes_of_file(whole))
              << source << ' ' << target << ' ' << cells;
        }
      }
    }
  }
}

TEST(regrid_streams, weights_without_tiles_need_their_memory) {
  const std::string in = temporary_path("streams.nc");
  const std::string out = temporary_path("second.nc");
  write_fields_on(in, "grid:4");
  const RegridFileOptions second{.method = FieldMethod::conservative_2nd,
                                 .limiter = RemapLimiter::bounds,
                                 .memory = 1U << 20U};
  const std::string refusal = why_not(in, "healpix:4", out, second);
  EXPECT_EQ(refusal,
            "memory of 1048576 bytes is too small: " + std::to_string(enough_of(refusal) >> 20U) +
                "M are enough for 4050 sources and 3072 targets, whose weights have no tiles");
  EXPECT_FALSE(std::filesystem::exists(out));
  const auto report = run(in, "healpix:4", out,
                          {.method = FieldMethod::conservative_2nd,
                           .limiter = RemapLimiter::bounds,
                           .memory = enough_of(refusal),
                           .cells_per_tile = 100});
  EXPECT_EQ(report.tiles, 0U);
  ASSERT_EQ(report.remarks.size(), 1U);
  EXPECT_EQ(report.remarks[0],
            in + ": the number of cells of a tile has no effect: the limiter needs the values of "
                 "all targets");
}

TEST(regrid_streams, a_resumed_run_has_the_bytes_of_one_that_was_not_cut) {
  const std::string in = temporary_path("streams.nc");
  write_fields_on(in, "grid:5");
  for (const char* const ending : {"nc", "nc4", "csv"}) {
    for (const FieldMethod method : {FieldMethod::conservative, FieldMethod::sibson}) {
      const std::string out = temporary_path(std::string("resumed.") + ending);
      std::filesystem::remove(out);
      for (const std::size_t tile : {std::size_t{0}, std::size_t{400}}) {
        RegridFileOptions options{.method = method, .cells_per_tile = tile};
        run(in, "grid:6", out, options);
        const std::string wanted = bytes_of_file(out);
        std::filesystem::remove(out);
        options.resume = true;
        std::uint64_t most = 0;
        for (std::size_t steps = 0; end_early(in, "grid:6", out, options, steps); ++steps) {
          EXPECT_FALSE(std::filesystem::exists(out));
          EXPECT_TRUE(std::filesystem::exists(out + ".partial"));
          const auto report = run(in, "grid:6", out, options);
          most = std::max(most, report.resumed);
          EXPECT_TRUE(bytes_of_file(out) == wanted) << ending << name_of(method) << steps;
          EXPECT_FALSE(std::filesystem::exists(out + ".partial"));
          std::filesystem::remove(out);
        }
        EXPECT_GT(most, 1800U);  // a field
        EXPECT_FALSE(std::filesystem::exists(out + ".partial"));
      }
    }
  }
}

// One run is cut short again and again, with other numbers of threads, tiles and bytes.
TEST(regrid_streams, runs_that_go_on_may_divide_their_work_in_other_ways) {
  const std::string in = temporary_path("streams.nc");
  const std::string out = temporary_path("resumed.nc");
  write_fields_on(in, "grid:1");
  run(in, "grid:0.5", out);
  const std::string wanted = bytes_of_file(out);
  std::filesystem::remove(out);
  std::uint64_t before = 0;
  for (const std::size_t tile : {20000U, 3000U, 50000U, 7777U}) {
    // The memory is too small for a field at the targets, so tiles are written one by one.
    RegridFileOptions options{.memory = std::uint64_t{24} << 20U, .cells_per_tile = tile};
    if (tile == 3000) options.memory = std::uint64_t{3} << 20U;
    options.resume = true;
    EXPECT_TRUE(end_early(in, "grid:0.5", out, options, tile == 3000 ? 130 : 5));
    const std::uint64_t size = std::filesystem::file_size(out + ".partial");
    EXPECT_GE(size, before);
    before = size;
  }
  EXPECT_GT(before, std::uint64_t{2} << 20U);
  const auto report = run(in, "grid:0.5", out, {.resume = true});
  EXPECT_GE(report.resumed, std::uint64_t{259'200});
  EXPECT_TRUE(bytes_of_file(out) == wanted);
}

TEST(regrid_streams, a_damaged_end_is_computed_again) {
  const std::string in = temporary_path("streams.nc");
  const std::string out = temporary_path("damaged.nc");
  write_fields_on(in, "grid:5");
  const RegridFileOptions options{.cells_per_tile = 400, .resume = true};
  run(in, "grid:6", out, options);
  const std::string wanted = bytes_of_file(out);
  std::filesystem::remove(out);
  ASSERT_TRUE(end_early(in, "grid:6", out,
                        {.memory = 1U << 21U, .cells_per_tile = 400, .resume = true}, 15));
  const std::string kept = bytes_of_file(out + ".partial");
  ASSERT_GT(kept.size(), 3000U);
  for (std::size_t size = 0; size <= kept.size(); size += size < 1000 ? 41 : 997) {
    write_bytes(out + ".partial", kept.substr(0, size));
    run(in, "grid:6", out, options);
    EXPECT_TRUE(bytes_of_file(out) == wanted) << size;
    std::filesystem::remove(out);
  }
  const std::size_t head = kept.find("values\n") + 7;
  for (std::size_t at = head; at < kept.size(); at += 1009) {
    std::string changed = kept;
    changed[at] = static_cast<char>(changed[at] ^ 16);
    write_bytes(out + ".partial", changed);
    run(in, "grid:6", out, options);
    EXPECT_TRUE(bytes_of_file(out) == wanted) << at;
    std::filesystem::remove(out);
  }
}

TEST(regrid_streams, what_another_run_has_left_is_refused) {
  const std::string in = temporary_path("streams.nc");
  const std::string out = temporary_path("other.nc");
  const std::string partial = out + ".partial";
  write_fields_on(in, "grid:5");
  RegridFileOptions options{.method = FieldMethod::linear, .cells_per_tile = 400};
  options.resume = true;
  ASSERT_TRUE(end_early(in, "grid:6", out, options, 8));
  RegridFileOptions other = options;
  other.method = FieldMethod::nearest;
  EXPECT_EQ(why_not(in, "grid:6", out, other),
            partial +
                ": of a run with 'method: linear', not 'method: nearest'; remove it to begin "
                "anew");
  other = options;
  other.max_missing = 0.25;
  EXPECT_EQ(why_not(in, "grid:6", out, other),
            partial +
                ": of a run with 'max_missing: 0.5', not 'max_missing: 0.25'; remove it to "
                "begin anew");
  other = options;
  other.names = {"kind"};
  EXPECT_NE(why_not(in, "grid:6", out, other).find("'variables: warm kind ', not"),
            std::string::npos);
  EXPECT_NE(why_not(in, "grid:7.5", out, options).find("'target: grid:6', not 'target: grid:7.5'"),
            std::string::npos);
  // A run that keeps nothing leaves it alone.
  run(in, "grid:6", out, {.method = FieldMethod::nearest});
  EXPECT_TRUE(std::filesystem::exists(partial));
  write_fields_on(in, "grid:10");
  EXPECT_EQ(why_not(in, "grid:6", out, options).find(partial + ": of a run with 'input: " + in),
            0U);
  write_bytes(partial, "something else");
  EXPECT_EQ(why_not(in, "grid:6", out, options),
            partial + ": it is not what a run of regrid has left; the name is taken");
  EXPECT_EQ(bytes_of_file(partial), "something else");
  std::filesystem::remove(partial);
  std::string text;
  EXPECT_EQ(thrown_message<FileError>([&] {
              FileName memory("text.csv", {});
              memory.bytes = &text;
              return regrid_file({in, {}}, {"grid:6", {}}, memory, options);
            }),
            "text.csv: a run can be resumed if its output is a file");
}

TEST(regrid_streams, files_that_are_read_are_neither_written_nor_changed) {
  const std::string in = temporary_path("streams.nc");
  const std::string out = temporary_path("changed.nc");
  write_fields_on(in, "grid:10");
  const std::string before = bytes_of_file(in);
  EXPECT_EQ(why_not(in, "grid:6", in), in + ": it is the file of the input, too");
  EXPECT_EQ(why_not(in + ":kind", "grid:6", in), in + ": it is the file of the input, too");
  const std::string link = temporary_path("link.nc");
  std::filesystem::remove(link);
  std::filesystem::create_symlink(in, link);
  EXPECT_EQ(why_not(in, "grid:6", link), link + ": it is the file of the input, too");
  const std::string mesh = temporary_path("mesh.nc");
  write_fields_on(mesh, "grid:15");
  EXPECT_EQ(why_not(in, mesh, mesh), mesh + ": it is the file of the target, too");
  EXPECT_EQ(bytes_of_file(in), before);
  const auto changing = [&](const std::string& path, std::string_view bytes) {
    return thrown_message<FileError>([&] {
      return run(in, "grid:6", out, {},
                 {.progress = [&](std::string_view, double) { write_bytes(path, bytes); }});
    });
  };
  EXPECT_EQ(changing(in, before + "more"), in + ": changed while it was read");
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace rondel::test
