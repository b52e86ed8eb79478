// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites by their number or by a property.

const mostFound = 30;

// Sites whose number is `text` or one of whose cells holds it, in any case: {site, what}. The text of a column is
// searched as a whole, as cells may be many.
export function findSites(text, numSites, columns) {
  const wanted = text.trim().toLowerCase();
  const found = new Map();
  if (wanted === "") return [];
  const number = /^#?\d+$/.test(wanted) ? Number(wanted.replace("#", "")) : -1;
  if (number >= 0 && number < numSites) found.set(number, `site ${number}`);
  for (const column of columns) {
    column.lower ??= lowerText(column);
    for (let at = column.lower.indexOf(wanted); at >= 0 && found.size < mostFound;) {
      const site = cellAt(column.lowerEnds, at);
      if (at + wanted.length <= column.lowerEnds[site] && !found.has(site)) {
        found.set(site, `${column.name}: ${column.cell(site)}`);
      }
      at = column.lower.indexOf(wanted, at + wanted.length <= column.lowerEnds[site] ? column.lowerEnds[site] : at + 1);
    }
  }
  return [...found].map(([site, what]) => ({ site, what }));
}

// The whole column in lower case; positions are those of characters, which are fewer than bytes.
function lowerText(column) {
  const parts = Array.from(column.ends, (_, i) => column.cell(i).toLowerCase());
  column.lowerEnds = new Float64Array(parts.length);
  let end = 0;
  for (let i = 0; i < parts.length; ++i) column.lowerEnds[i] = end += parts[i].length;
  return parts.join("");
}

// The cell that has the character at a position: the first that ends after it.
function cellAt(ends, at) {
  let low = 0;
  let high = ends.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (ends[middle] > at) high = middle;
    else low = middle + 1;
  }
  return low;
}

// The combination of a text field and the list of what was found (ARIA's combobox pattern).
export class Search {
  constructor(field, list, { numSites, columns, choose }) {
    Object.assign(this, { field, list, numSites, columns, choose, active: -1 });
    field.addEventListener("input", () => this.update());
    field.addEventListener("keydown", (event) => this.key(event));
    field.addEventListener("blur", () => setTimeout(() => this.close(), 150));
  }

  update() {
    const found = findSites(this.field.value, this.numSites, this.columns);
    this.active = -1;
    this.list.replaceChildren(...found.map(({ site, what }, i) => {
      const item = document.createElement("li");
      item.id = `found-${i}`;
      item.setAttribute("role", "option");
      item.setAttribute("aria-selected", "false");
      item.textContent = what;
      item.dataset.site = site;
      item.addEventListener("pointerdown", (event) => {
        event.preventDefault();
        this.take(site);
      });
      return item;
    }));
    const isEmpty = found.length === 0 && this.field.value.trim() !== "";
    this.field.setAttribute("aria-invalid", String(isEmpty));
    this.list.hidden = found.length === 0;
    this.field.setAttribute("aria-expanded", String(found.length > 0));
    this.field.removeAttribute("aria-activedescendant");
  }

  key(event) {
    const items = [...this.list.children];
    if (event.key === "Escape") this.close();
    if (event.key === "Enter" && items.length > 0) this.take(Number(items[Math.max(0, this.active)].dataset.site));
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step === undefined || items.length === 0) return;
    event.preventDefault();
    this.active = (this.active + step + items.length) % items.length;
    items.forEach((item, i) => item.setAttribute("aria-selected", String(i === this.active)));
    items[this.active].scrollIntoView({ block: "nearest" });
    this.field.setAttribute("aria-activedescendant", items[this.active].id);
  }

  take(site) {
    this.close();
    this.choose(site);
  }

  close() {
    this.list.hidden = true;
    this.field.setAttribute("aria-expanded", "false");
    this.field.removeAttribute("aria-activedescendant");
  }
}
