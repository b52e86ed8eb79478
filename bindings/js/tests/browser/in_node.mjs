// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What Node.js computes, as JSON: what browsers are compared with.

import { webcrypto } from "node:crypto";
import "./main.mjs";

globalThis.crypto ??= webcrypto; // Node.js 18 has none
const { geoJson, typedArrays, withoutWorker } = globalThis.rondelTest;
console.log(JSON.stringify({ typedArrays: await typedArrays(), geoJson: geoJson(), worker: await withoutWorker() }));
