/* SPDX-FileCopyrightText: The Rondel authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Points, lines and polygons from C: a voyage across the antimeridian and its ports, divided by two zones. */

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
  /* A line, and two ports: lines of one position each. */
  const double positions[][2] = {{170, -15}, {179, -18}, {187, -14}, {178.4, -18.1}, {187, -14}};
  const uint64_t voyage_and_ports[] = {0, 1, 3};
  const uint64_t lines[] = {0, 3, 4, 5};
  rondel_lonlat_geometries* ways;
  require(rondel_lonlat_geometries_create(voyage_and_ports, 2, lines, positions[0], NULL, &ways));

  /* Two boxes that have a side in common: features, whose geometries have no lines. */
  const double corners[][2] = {{172, -25}, {180, -25}, {180, -12}, {172, -12}, {172, -25},
                               {180, -25}, {188, -25}, {188, -12}, {180, -12}, {180, -25}};
  const uint64_t each[] = {0, 1, 2};
  const uint64_t rings[] = {0, 5, 10};
  const uint64_t no_lines[] = {0, 0, 0};
  rondel_features* boxes;
  require(rondel_features_create(each, 2, each, rings, corners[0], &boxes));
  rondel_lonlat_geometries* zones;
  require(rondel_lonlat_geometries_create(no_lines, 2, NULL, NULL, boxes, &zones));

  /* Sets that are to be compared become arcs together. */
  const rondel_lonlat_geometries* sets[] = {ways, zones};
  rondel_geometries* made[2];
  require(rondel_geometries_of_lonlat(sets, 2, NULL, NULL, made));

  rondel_pieces* pieces;
  require(rondel_overlay_geometry_pieces(made[0], made[1], RONDEL_IDENTITY, 0, NULL, &pieces));
  const rondel_geometries* parts = rondel_piece_geometries(pieces);
  const size_t n = rondel_num_pieces(pieces);
  double* lengths = malloc(n * sizeof(double));
  require(rondel_line_lengths(parts, lengths));
  const uint64_t* groups = rondel_line_groups(parts);
  for (size_t k = 0; k < n; ++k) {
    const uint32_t way = rondel_piece_owners_in_a(pieces)[k];
    const uint32_t zone = rondel_piece_owners_in_b(pieces)[k];
    printf("%s ", way == 0 ? "voyage" : "ports");
    if (zone == RONDEL_NO_INDEX) {
      printf("in no zone");
    } else {
      printf("in zone %d", (int)zone);
    }
    printf(": %d parts, %.0f km\n", (int)(groups[k + 1] - groups[k]), lengths[k] * 6371.0088);
  }
  free(lengths);

  /* For other programs: an array of GeoArrow for each kind of parts, cut at the antimeridian. */
  rondel_lonlat_geometries* drawn;
  require(rondel_lonlat_of_geometries(parts, 0.01, NULL, &drawn));
  struct ArrowSchema schema;
  struct ArrowArray array;
  require(rondel_lonlat_geometries_export_arrow(drawn, RONDEL_LINE_PARTS, RONDEL_LONLAT, &schema,
                                                &array));
  printf("%d elements with %d lines\n", (int)array.length, (int)array.children[0]->length);
  array.release(&array);
  schema.release(&schema);

  rondel_lonlat_geometries_free(drawn);
  rondel_pieces_free(pieces);
  rondel_geometries_free(made[0]);
  rondel_geometries_free(made[1]);
  rondel_lonlat_geometries_free(zones);
  rondel_lonlat_geometries_free(ways);
  rondel_features_free(boxes);
  return 0;
}
