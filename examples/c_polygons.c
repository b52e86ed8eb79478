/* SPDX-FileCopyrightText: The Rondel authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Polygons from C: Fiji across the antimeridian, what is near to it, and how both lie to each other. */

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
  /* A box and a bow tie: each has one polygon of one ring, whose last position is the first one. */
  const double positions[][2] = {{177, -19}, {181, -19}, {181, -16}, {177, -16}, {177, -19},
                                 {170, -20}, {178, -10}, {178, -20}, {170, -10}, {170, -20}};
  const uint64_t feature_polygons[] = {0, 1, 2};
  const uint64_t polygon_rings[] = {0, 1, 2};
  const uint64_t ring_positions[] = {0, 5, 10};
  rondel_features* features;
  require(rondel_features_create(feature_polygons, 2, polygon_rings, ring_positions, positions[0],
                                 &features));

  rondel_texts* faults;
  require(rondel_feature_faults(features, NULL, NULL, &faults));
  for (size_t i = 0; i < rondel_num_texts(faults); ++i) {
    const char* fault = rondel_text(faults, i);
    printf("feature %zu: %s\n", i, fault[0] == '\0' ? "valid" : fault);
  }

  rondel_reading reading;
  rondel_reading_init(&reading);
  reading.invalid = RONDEL_REPAIR;
  rondel_polygons* polygons;
  require(rondel_polygons_of_features(features, &reading, NULL, &polygons));
  double areas[2];
  require(rondel_polygon_areas(polygons, areas));
  printf("%.6f and %.6f steradians\n", areas[0], areas[1]);

  const double kilometers = 1 / 6371.0088; /* in radians */
  rondel_polygons* near;
  rondel_polygons* both;
  require(rondel_buffer(polygons, 100 * kilometers, 1 * kilometers, NULL, &near));
  require(rondel_combine(polygons, near, RONDEL_INTERSECTION, NULL, &both));
  double area;
  require(rondel_polygon_areas(both, &area));
  printf("%zu polygon of %.6f steradians\n", rondel_num_polygons(both), area);

  char relations[2][RONDEL_RELATION_SIZE];
  require(rondel_relate(polygons, near, NULL, relations[0]));
  printf("within what is near: %s and %s\n", relations[0], relations[1]);
  rondel_lists* related;
  require(rondel_related(near, near, "T*T***T**", NULL, &related)); /* overlaps */
  printf("%d overlaps\n", (int)rondel_list_offsets(related)[rondel_num_lists(related)]);

  /* For GDAL, Arrow, DuckDB, R ...: multipolygons of GeoArrow, cut at the antimeridian. */
  rondel_features* drawn;
  require(rondel_features_of_polygons(both, 0.01, NULL, &drawn));
  struct ArrowSchema schema;
  struct ArrowArray array;
  require(rondel_features_export_arrow(drawn, RONDEL_LONLAT, &schema, &array));
  printf("%d feature in the format %s\n", (int)array.length, schema.format);
  array.release(&array);
  schema.release(&schema);

  rondel_features_free(drawn);
  rondel_lists_free(related);
  rondel_polygons_free(both);
  rondel_polygons_free(near);
  rondel_polygons_free(polygons);
  rondel_texts_free(faults);
  rondel_features_free(features);
  return 0;
}
