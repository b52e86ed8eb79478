// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A client of rondel::geo: applies weights, makes a mesh and a page, and catches the errors of each.

#include <rondel/globe.h>
#include <rondel/mesh.h>
#include <rondel/rondel.h>
#include <rondel/weights.h>

#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace {

// Returns whether a call throws InvalidInput.
template <typename Call>
bool is_refused(Call call) {
  try {
    call();
  } catch (const rondel::InvalidInput&) {
    return true;
  }
  return false;
}

void print(bool is_right, const char* what, bool is_refused) {
  std::printf("%s%s, %s\n", is_right ? "" : "no ", what, is_refused ? "an error" : "no error");
}

}  // namespace

int main() {
  rondel::Weights weights;
  weights.offsets = {0, 2};
  weights.columns = {0, 1};
  weights.values = {0.5, 0.5};
  weights.num_columns = 2;
  const std::vector<double> in = {1, 3};
  std::vector<double> out(1);
  rondel::apply(weights, in, out);
  print(out[0] == 2, "mean", is_refused([&] { rondel::apply(weights, in, {}); }));

  rondel::SiteTable table;
  table.sites = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const rondel::Triangulation triangulation = rondel::delaunay(table.sites);
  const auto three = std::span<const rondel::Point>(table.sites).first(3);
  print(rondel::mesh::make_mesh(triangulation).num_cells() == 6, "mesh",
        is_refused([&] { rondel::mesh::make_mesh(rondel::delaunay(rondel::Sites(three))); }));

  const rondel::Diagram diagram = rondel::diagram(triangulation);
  rondel::GlobeOptions options;
  options.title = "Octahedron";
  const std::string page = rondel::globe_page(table, triangulation, diagram, options);
  options.up_deg = std::numeric_limits<double>::infinity();
  print(page.find("<title>Octahedron</title>") != std::string::npos, "page",
        is_refused([&] { rondel::globe_page(table, triangulation, diagram, options); }));
}
