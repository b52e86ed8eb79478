// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the page carries: a description as JSON and arrays in base64, each the zlib stream of its bytes.
// Numbers are stored by planes (all first bytes, then all second bytes ...), which deflate packs better.

const kinds = { f64: Float64Array, u32: Uint32Array, u8: Uint8Array };

// A multiple of four characters, so that each slice is base64 by itself.
const sliceLength = 1 << 20;

function compressedBytes(base64) {
  let at = 0;
  return new ReadableStream({
    pull(controller) {
      if (at >= base64.length) {
        controller.close();
        return;
      }
      const text = atob(base64.slice(at, at + sliceLength));
      at += sliceLength;
      const bytes = new Uint8Array(text.length);
      for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
      controller.enqueue(bytes);
    },
  });
}

async function inflate(base64, size) {
  const bytes = new Uint8Array(size);
  const reader = compressedBytes(base64).pipeThrough(new DecompressionStream("deflate")).getReader();
  let at = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    bytes.set(part.value, at);
    at += part.value.length;
  }
  if (at !== size) throw new Error(`an array has ${at} bytes instead of ${size}`);
  return bytes;
}

function withoutPlanes(bytes, width) {
  const count = bytes.length / width;
  const result = new Uint8Array(bytes.length);
  for (let plane = 0; plane < width; ++plane) {
    for (let i = 0; i < count; ++i) result[i * width + plane] = bytes[plane * count + i];
  }
  return result;
}

async function readArray(page, { name, kind, length }) {
  const Kind = kinds[kind];
  const element = page.getElementById(`data-${name}`);
  const base64 = element.textContent.trim();
  element.remove();
  const width = Kind.BYTES_PER_ELEMENT;
  const bytes = await inflate(base64, length * width);
  return width === 1 ? bytes : new Kind(withoutPlanes(bytes, width).buffer);
}

// {about, arrays}: the description, and the arrays by their names.
export async function readPage(page) {
  const about = JSON.parse(page.getElementById("about").textContent);
  const arrays = {};
  for (const entry of about.arrays) arrays[entry.name] = await readArray(page, entry);
  return { about, arrays };
}

// One column of the table: the text of a cell without copies of the others.
export class Column {
  constructor({ name, isNumeric }, bytes, lengths) {
    this.name = name;
    this.isNumeric = isNumeric;
    this.bytes = bytes;
    this.ends = new Float64Array(lengths.length);
    let end = 0;
    for (let i = 0; i < lengths.length; ++i) this.ends[i] = end += lengths[i];
  }

  cell(i) {
    const begin = i === 0 ? 0 : this.ends[i - 1];
    return new TextDecoder().decode(this.bytes.subarray(begin, this.ends[i]));
  }
}
