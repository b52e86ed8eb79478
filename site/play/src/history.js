// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What was done, to be undone and done again. A deed is {undo, redo}, two functions.

const mostDeeds = 500;

export class History {
  constructor() {
    this.past = [];
    this.future = [];
  }

  add(deed) {
    this.past.push(deed);
    if (this.past.length > mostDeeds) this.past.shift();
    this.future = [];
  }

  // Whether there was something to undo.
  back() {
    const deed = this.past.pop();
    if (deed === undefined) return false;
    this.future.push(deed);
    deed.undo();
    return true;
  }

  forth() {
    const deed = this.future.pop();
    if (deed === undefined) return false;
    this.past.push(deed);
    deed.redo();
    return true;
  }
}
