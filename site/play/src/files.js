// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where sites come from and go to: presets, tables that are opened or dropped on the page, tables that are saved.

import { presets, presetTable } from "./presets.js";
import { readTable, writeTable } from "./table.js";

export class Files {
  // `play` has: points, begin(table), start(table), warn(message).
  constructor(page, play) {
    this.page = page;
    this.play = play;
    this.seed = 1;
    this.bindPresets();
    const byId = (id) => page.getElementById(id);
    byId("open").addEventListener("click", () => byId("file").click());
    byId("file").addEventListener("change", () => {
      this.open(byId("file").files[0]);
      byId("file").value = "";
    });
    byId("save-table").addEventListener("click", () => this.save());
    this.bindDrop();
  }

  bindPresets() {
    const [preset, number] = ["preset", "number"].map((id) => this.page.getElementById(id));
    for (const [key, { name }] of Object.entries(presets)) preset.add(new Option(name, key));
    const start = () => {
      number.disabled = !presets[preset.value].count;
      this.play.start(presetTable(preset.value, Number(number.value), this.seed));
    };
    this.readAddress(preset, number);
    this.first = () => {
      number.disabled = !presets[preset.value].count;
      this.play.begin(presetTable(preset.value, Number(number.value), this.seed));
    };
    preset.addEventListener("change", start);
    number.addEventListener("change", start);
    this.page.getElementById("again").addEventListener("click", () => {
      ++this.seed;
      start();
    });
  }

  // An address that ends in #preset=metre or #preset=random&number=2000 says what to begin with.
  readAddress(preset, number) {
    const wanted = new URLSearchParams(this.page.location.hash.slice(1));
    const has = (select, value) => [...select.options].some((option) => option.value === value);
    for (const select of [preset, number]) {
      if (has(select, wanted.get(select.id))) select.value = wanted.get(select.id);
    }
  }

  bindDrop() {
    const { page } = this;
    const show = (isOver) => { page.body.dataset.dropping = String(isOver); };
    page.addEventListener("dragover", (event) => {
      event.preventDefault();
      show(true);
    });
    page.addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) show(false);
    });
    page.addEventListener("drop", (event) => {
      event.preventDefault();
      show(false);
      if (event.dataTransfer.files.length > 0) this.open(event.dataTransfer.files[0]);
    });
  }

  async open(file) {
    if (!file) return;
    try {
      this.play.start(readTable(await file.text()));
    } catch (error) {
      this.play.warn(`${file.name}: ${error.message}`);
    }
  }

  save() {
    const link = this.page.createElement("a");
    link.href = URL.createObjectURL(new Blob([writeTable(this.play.points)], { type: "text/csv" }));
    link.download = "sites.csv";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }
}
