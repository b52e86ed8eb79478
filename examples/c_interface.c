/* SPDX-FileCopyrightText: The Rondel authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The library from C: cells of airports, the nearest one, and what an error looks like. */

#include <rondel.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program unless a call succeeded. */
static void require(rondel_status status) {
  if (status == RONDEL_OK) return;
  fprintf(stderr, "%s\n", rondel_error_message());
  exit(1);
}

int main(void) {
  const double airports[][2] = {{-0.46, 51.47},  {2.55, 49.01},   {8.57, 50.03},    {12.25, 41.80},
                                {-3.57, 40.49},  {139.78, 35.55}, {151.18, -33.95}, {-73.78, 40.64},
                                {28.25, -26.13}, {-46.47, -23.43}};
  enum { n = sizeof airports / sizeof airports[0] };
  double points[n][3];
  require(rondel_unit_vectors(airports[0], n, points[0]));

  rondel_triangulation* triangulation;
  require(rondel_delaunay(points[0], n, NULL, NULL, &triangulation));
  const uint32_t* faces = rondel_faces(triangulation);
  printf("%zu faces, the first %u %u %u\n", rondel_num_faces(triangulation), faces[0], faces[1],
         faces[2]);

  rondel_diagram* diagram;
  require(rondel_diagram_create(triangulation, NULL, &diagram));
  const uint64_t* offsets = rondel_cell_offsets(diagram);
  printf("cell of airport 5: %d corners, %.6f steradians\n", (int)(offsets[6] - offsets[5]),
         rondel_cell_areas(diagram)[5]);

  rondel_locator* locator;
  require(rondel_locator_create(triangulation, &locator));
  const double plane_lonlat[2] = {5.0, 47.0};
  double plane[3];
  uint32_t nearest;
  require(rondel_unit_vectors(plane_lonlat, 1, plane));
  require(rondel_nearest(locator, plane, 1, NULL, &nearest));
  printf("a plane is nearest to airport %u\n", nearest);

  points[3][0] = points[3][1] = points[3][2] = 0;
  rondel_triangulation* none;
  if (rondel_delaunay(points[0], n, NULL, NULL, &none) == RONDEL_INVALID_INPUT) {
    printf("%s (index %zu)\n", rondel_error_message(), rondel_error_index());
  }

  rondel_locator_free(locator);
  rondel_diagram_free(diagram);
  rondel_triangulation_free(triangulation);
  return 0;
}
