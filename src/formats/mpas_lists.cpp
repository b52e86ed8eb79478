// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Compares the lists of an MPAS file that are not read with those that follow from the others. A
// list may begin anywhere, and none is written as 0 or as one more than there are elements.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "formats/mpas_places.h"
#include "io/netcdf_reader.h"
#include "system/parallel.h"

namespace rondel::formats {
namespace {

using Numbers = std::vector<std::int64_t>;

// A list of a file: for each row the numbers from 1 that it should have, in any order, with 0 for
// none.
struct ListOfFile {
  const char* name;
  const char* row;  // "cell", "vertex"
  std::size_t num_rows;
  std::size_t longest;  // row
  std::size_t end;      // the largest number that stands for an element
  std::function<void(std::size_t, Numbers&)> expected;
};

template <class Row>
void append_numbers(const Row& indices, Numbers& numbers) {
  for (const Index index : indices) {
    numbers.push_back(index == no_index ? 0 : std::int64_t{index} + 1);
  }
}

// Returns the first row that has other numbers than expected; the number of rows if there is none.
std::size_t first_other(const io::NetcdfReader& file, const io::VariableInFile& variable,
                        const ListOfFile& list, unsigned threads) {
  constexpr std::size_t rows_at_once = 4096;
  const std::size_t room = variable.num_values / list.num_rows;
  std::vector<std::size_t> first(system::num_pieces(list.num_rows, rows_at_once), list.num_rows);
  const auto compare = [&](std::size_t begin, std::size_t end) {
    Numbers read((end - begin) * room);
    Numbers wanted;
    file.read_integers(variable, begin * room, read);
    for (std::size_t i = begin; i < end; ++i) {
      wanted.clear();
      list.expected(i, wanted);
      const auto found = std::span(read).subspan((i - begin) * room, wanted.size());
      std::ranges::replace(found, static_cast<std::int64_t>(list.end) + 1, 0);
      std::ranges::sort(found);
      std::ranges::sort(wanted);
      if (std::ranges::equal(found, wanted)) continue;
      first[begin / rows_at_once] = i;
      return;
    }
  };
  system::parallel_for(threads, list.num_rows, rows_at_once, compare);
  return std::ranges::min(first);
}

}  // namespace

std::string remark_on_lists(const io::NetcdfReader& file, const mesh::VoronoiMesh& mesh,
                            unsigned threads) {
  const std::vector<std::uint64_t>& offsets = mesh.edges_on_cell.offsets;
  const auto around_cell = [&](const std::vector<Index>& values) {
    return [&](std::size_t i, Numbers& numbers) {
      append_numbers(std::span(values).subspan(offsets[i], offsets[i + 1] - offsets[i]), numbers);
    };
  };
  const auto around_vertex = [&](std::size_t v, Numbers& numbers) {
    append_numbers(mesh.edges_on_vertex[v], numbers);
  };
  std::size_t most_sides = 0;
  for (std::size_t i = 0; i < mesh.num_cells(); ++i) {
    most_sides = std::max<std::size_t>(most_sides, offsets[i + 1] - offsets[i]);
  }
  const ListOfFile lists[] = {
      {"verticesOnCell", "cell", mesh.num_cells(), most_sides, mesh.num_vertices(),
       around_cell(mesh.vertices_on_cell)},
      {"cellsOnCell", "cell", mesh.num_cells(), most_sides, mesh.num_cells(),
       around_cell(mesh.cells_on_cell)},
      {"edgesOnVertex", "vertex", mesh.num_vertices(), 3, mesh.num_edges(), around_vertex}};
  for (const ListOfFile& list : lists) {
    const io::VariableInFile* const variable = file.find(list.name);
    if (variable == nullptr || list.num_rows == 0 ||
        variable->num_values < list.longest * list.num_rows ||
        variable->num_values % list.num_rows != 0) {
      continue;
    }
    const std::size_t row = first_other(file, *variable, list, threads);
    if (row == list.num_rows) continue;
    return "\"" + std::string(list.name) + "\" of " + list.row + ' ' + std::to_string(row) +
           " does not fit to the cells and vertices of edges, of which it is made again";
  }
  return {};
}

}  // namespace rondel::formats
