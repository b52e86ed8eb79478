// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Colors of both themes, and the color map of values. Colors are [red, green, blue, alpha] from 0 to 1.

// Premultiplied, from "#rrggbb".
export function color(hex, alpha = 1) {
  const part = (at) => parseInt(hex.slice(at, at + 2), 16) / 255;
  return [part(1) * alpha, part(3) * alpha, part(5) * alpha, alpha];
}

// On colored cells, which are the same in both themes.
const onFill = {
  isoline: color("#0b1526", 0.85),
  border: color("#0f1f38", 0.5), coast: color("#33405a", 0.75), graticule: color("#0f1f38", 0.18),
  site: color("#0b1526"), hidden: color("#0b1526", 0.3), chosen: color("#e8590c"), pointed: color("#e8590c", 0.55),
};

const plainThemes = {
  light: {
    sky: color("#f4f6f9"), glow: color("#9db9dc"), ocean: color("#e3ebf4"), land: color("#f7f5ef"),
    coast: color("#7f8b9a", 0.9), graticule: color("#5a6c84", 0.16), edge: color("#1d4f91", 0.85),
    isoline: color("#0a7d52", 0.95), border: color("#b4402a", 0.85), circle: color("#7a4bb0", 0.8), site: color("#14233a"),
    hidden: color("#14233a", 0.3), chosen: color("#e8590c"), pointed: color("#e8590c", 0.55), blank: color("#c9d0da"),
  },
  dark: {
    sky: color("#0b0f17"), glow: color("#3f6fb5"), ocean: color("#131d2e"), land: color("#222d3d"),
    coast: color("#8494aa", 0.85), graticule: color("#a9bdd8", 0.13), edge: color("#5c9ee8", 0.75),
    isoline: color("#5fd3a4", 0.9), border: color("#ff9a76", 0.85), circle: color("#c5a3ff", 0.8), site: color("#e4ecf8"),
    hidden: color("#f1f5fb", 0.3), chosen: color("#ffb84d"), pointed: color("#ffb84d", 0.55), blank: color("#38445a"),
  },
};

export function themeOf(name, isFilled) {
  return isFilled ? { ...plainThemes[name], ...onFill } : plainThemes[name];
}

// sRGB and Oklab: the transfer function is that of IEC 61966-2-1, the matrices are those that Bjorn Ottosson
// publishes in "A perceptual color space for image processing" (2020).
function toLinear(c) {
  return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
}

function fromLinear(c) {
  const clipped = Math.min(1, Math.max(0, c));
  return clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * clipped ** (1 / 2.4) - 0.055;
}

function toOklab(rgb) {
  const [r, g, b] = rgb.map(toLinear);
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

function fromOklab([lightness, a, b]) {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ].map(fromLinear);
}

// From dark blue over teal to sand: lightness grows evenly, so that equal steps of the value look equal.
const stops = [[0.09, 0.18, 0.38], [0.155, 0.455, 0.56], [0.56, 0.77, 0.68], [0.985, 0.96, 0.86]].map(toOklab);
const darkest = stops[0][0];
const lightest = stops[stops.length - 1][0];

// The color of t from 0 to 1.
export function colorAt(t) {
  const lightness = darkest + (lightest - darkest) * Math.min(1, Math.max(0, t));
  let i = 0;
  while (i < stops.length - 2 && lightness > stops[i + 1][0]) ++i;
  const part = (lightness - stops[i][0]) / (stops[i + 1][0] - stops[i][0]);
  return fromOklab(stops[i].map((from, k) => from + part * (stops[i + 1][k] - from)));
}

// 256 colors as bytes, four a color.
export function colorMap() {
  const bytes = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const rgb = colorAt(i / 255);
    for (let k = 0; k < 3; ++k) bytes[4 * i + k] = Math.round(255 * rgb[k]);
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}
