// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

import { delaunay, voronoi } from "rondel";

export const flat = delaunay([0, 0, 1], { model: "flat" });
export const text = voronoi("0, 0, 1");
export const cells = delaunay([0, 0, 1]).cells;
export const misspelt = delaunay([0, 0, 1], { centre: [0, 0, 0] });
export const nearest: number = voronoi([0, 0, 1]).nearest([0, 0, 1]);
