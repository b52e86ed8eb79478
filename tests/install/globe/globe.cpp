// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A client of rondel::globe: a page of the octahedron, and an exception that crosses the library's border.

#include <rondel/globe.h>
#include <rondel/rondel.h>

#include <cstdio>
#include <limits>
#include <string>

int main() {
  rondel::SiteTable table;
  table.sites = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const rondel::Triangulation triangulation = rondel::delaunay(table.sites);
  const rondel::Diagram diagram = rondel::diagram(triangulation);
  rondel::GlobeOptions options;
  options.title = "Octahedron";
  const std::string page = rondel::globe_page(table, triangulation, diagram, options);
  const bool has_title = page.find("<title>Octahedron</title>") != std::string::npos;
  bool has_thrown = false;
  options.up_deg = std::numeric_limits<double>::infinity();
  try {
    rondel::globe_page(table, triangulation, diagram, options);
  } catch (const rondel::InvalidInput&) {
    has_thrown = true;
  }
  std::printf("%s, %s\n", has_title ? "a page" : "no page", has_thrown ? "an error" : "no error");
}
