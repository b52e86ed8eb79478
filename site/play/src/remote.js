// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The worker, seen from the page. It is asked for one thing at a time; changes that come meanwhile wait, and of a
// site's moves in a row only the last one is done.

export class Remote {
  // `text`: the worker's script. `show(state, method)` is called with each state that was asked for, `fail(error, method)`
  // where an argument was refused, after which all is as it was.
  constructor(text, { show, fail }) {
    const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    this.worker = new Worker(address);
    this.show = show;
    this.fail = fail;
    this.waiting = [];
    this.current = null;
    this.worker.onmessage = ({ data }) => this.receive(data);
    this.worker.onerror = (event) => fail({ message: event.message });
  }

  get isIdle() {
    return this.current === null && this.waiting.length === 0;
  }

  ask(method, argument) {
    this.waiting.push({ method, argument });
    this.next();
  }

  // {what: "insert" | "move", key, point} or {what: "remove", key}
  change(step) {
    const last = this.waiting[this.waiting.length - 1];
    if (last?.method !== "change") {
      this.waiting.push({ method: "change", argument: [step] });
    } else {
      const steps = last.argument;
      const previous = steps[steps.length - 1];
      if (step.what === "move" && previous.what === "move" && previous.key === step.key) steps.pop();
      steps.push(step);
    }
    this.next();
  }

  next() {
    if (this.current !== null || this.waiting.length === 0) return;
    this.current = this.waiting.shift();
    this.worker.postMessage(this.current);
  }

  receive({ state, error }) {
    const { method } = this.current;
    this.current = null;
    if (error) this.fail(error, method);
    else this.show(state, method);
    this.next();
  }
}
