// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers as people read them.

import { degree } from "./vectors.js";

export const earthRadius = 6371.0088;  // kilometres, the mean one of IUGG

export function count(n, thing) {
  return `${n.toLocaleString("en")} ${thing}${n === 1 ? "" : "s"}`;
}

export function digits(value, most = 5) {
  if (!Number.isFinite(value)) return "\u2013";
  if (value !== 0 && (Math.abs(value) >= 1e7 || Math.abs(value) < 1e-3)) return value.toExponential(most - 2);
  return value.toLocaleString("en", { maximumSignificantDigits: most });
}

// An angle in radians as a length on the earth.
export function lengthText(radians) {
  const km = radians * earthRadius;
  for (const [unit, size] of [["km", 1], ["m", 1e-3], ["cm", 1e-5], ["mm", 1e-6]]) {
    if (km >= size) return `${digits(km / size, 4)} ${unit}`;
  }
  return `${digits(km * 1e6, 3)} mm`;
}

// The unit on the earth that suits an area, and its size in steradians.
export function areaUnit(steradians) {
  const km2 = 1 / earthRadius ** 2;
  if (steradians >= km2) return { unit: "km\u00b2", size: km2 };
  if (steradians >= km2 * 1e-6) return { unit: "m\u00b2", size: km2 * 1e-6 };
  return { unit: "cm\u00b2", size: km2 * 1e-10 };
}

export function areaText(steradians) {
  const { unit, size } = areaUnit(steradians);
  return `${digits(steradians / size, 5)} ${unit}`;
}

function shortNumber(value, most) {
  if (value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e15)) return value.toExponential(most - 2);
  return value.toLocaleString("en", { notation: "compact", maximumSignificantDigits: most });
}

// Few characters, 1.2M, but so many that numbers that differ have different texts.
export function shortNumbers(values) {
  const several = new Set(values).size;
  for (let most = 4; ; most += 2) {
    const texts = values.map((value) => shortNumber(value, most));
    if (most >= 16 || new Set(texts).size === several) return texts;
  }
}

// So many decimals that a pixel of `zoom` pixels a radian is told.
export function placeText([lon, lat], zoom) {
  const decimals = Math.min(13, Math.max(2, Math.ceil(Math.log10(zoom * degree))));
  const side = (value, positive, negative) =>
    `${Math.abs(value).toFixed(decimals)}\u00b0 ${value < 0 ? negative : positive}`;
  return `${side(lat, "N", "S")}, ${side(lon, "E", "W")}`;
}

// The longest of 1, 2, 5, 10, 20 ... of a unit that is at most `pixels` long: {text, pixels}.
export function scaleBar(zoom, pixels) {
  const km = (pixels / zoom) * earthRadius;
  const power = 10 ** Math.floor(Math.log10(km));
  const length = [5, 2, 1].map((digit) => digit * power).find((candidate) => candidate <= km * (1 + 1e-9)) ?? power;
  return { text: lengthText(length / earthRadius), pixels: (length / earthRadius) * zoom };
}
