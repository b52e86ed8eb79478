// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites as CSV: columns lon, lat in degrees, with `radius` circles; or x, y, z. The names are those that the tool
// `rondel` takes.

const lonNames = ["lon", "lng", "long", "longitude"];
const latNames = ["lat", "latitude"];

// The fields of a line (RFC 4180); a quoted field of several lines is none that holds sites.
function fieldsOf(line, delimiter) {
  const pattern = /"((?:[^"]|"")*)"|[^"]*?(?=D|$)/y;
  const parts = new RegExp(pattern.source.replace("D", delimiter === "\t" ? "\\t" : delimiter), "y");
  const fields = [];
  for (let at = 0; at <= line.length;) {
    parts.lastIndex = at;
    const [text, quoted] = parts.exec(line) ?? [line.slice(at)];
    fields.push((quoted?.replaceAll('""', '"') ?? text).trim());
    at += text.length + 1;
  }
  return fields;
}

function numberAt(fields, column, line) {
  const text = fields[column] ?? "";
  const value = Number(text);
  if (text === "" || !Number.isFinite(value)) throw new Error(`line ${line}: "${text}" is no number`);
  return value;
}

// {xyz} or {lonLat} or {lonLat, radii}, flat; throws an error that names the line.
export function readTable(text) {
  const lines = text.replace(/^\ufeff/, "").split(/\r?\n/);
  const header = lines[0];
  const delimiter = ["\t", ";", ","].find((character) => header.includes(character)) ?? ",";
  const names = fieldsOf(header.toLowerCase(), delimiter);
  const column = (wanted) => names.findIndex((name) => wanted.includes(name));
  const places = [column(lonNames), column(latNames)];
  const axes = ["x", "y", "z"].map((axis) => column([axis]));
  const columns = [places, axes].find((found) => found.every((at) => at >= 0));
  if (columns === undefined) throw new Error("line 1: columns lon and lat, or x, y and z are wanted");
  const radius = columns === places ? column(["radius"]) : -1;
  const values = [];
  const radii = [];
  lines.forEach((line, i) => {
    if (i === 0 || line.trim() === "") return;
    const fields = fieldsOf(line, delimiter);
    for (const at of columns) values.push(numberAt(fields, at, i + 1));
    if (radius >= 0) radii.push(numberAt(fields, radius, i + 1));
  });
  if (columns === axes) return { xyz: values };
  return radius >= 0 ? { lonLat: values, radii } : { lonLat: values };
}

// All digits, so that the file has the sites to the last bit. `points`: [x, y, z], or null where there is no site.
export function writeTable(points) {
  return ["x,y,z", ...points.filter((point) => point !== null).map((point) => point.join(","))].join("\n") + "\n";
}
