// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Mouse, pen, fingers, wheel and keys. One pointer turns the globe, or moves what the globe says that it holds; two
// zoom and turn it; what is grabbed stays under the finger. A globe let go turns on and slows down, unless motion is
// to be reduced.

const clickDistance = 5;  // pixels that a click may move
const doubleTime = 400;  // milliseconds between two clicks that are one double click
const doubleDistance = { mouse: 8, other: 30 };
const slowing = 0.0045;  // of the speed, each millisecond
const keyStep = 60;  // pixels

export class Pointers {
  // `globe` has: camera, redraw(), click(x, y), doubleClick(x, y, isBack), point(at), grab(at, kind), drag(at), drop(),
  // home(), northUp(), help(), and may have `actions`, functions by key that go before those here.
  constructor(element, globe) {
    this.element = element;
    this.globe = globe;
    this.held = new Map();
    this.isReduced = matchMedia("(prefers-reduced-motion: reduce)");
    this.speed = null;
    const listen = (name, handler) => element.addEventListener(name, handler.bind(this), { passive: false });
    listen("pointerdown", this.down);
    listen("pointermove", this.move);
    listen("pointerup", this.up);
    listen("pointercancel", this.up);
    listen("pointerleave", () => globe.point(null));
    listen("wheel", this.wheel);
    listen("keydown", this.key);
  }

  position(event) {
    const box = this.element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  down(event) {
    this.speed = null;
    this.globe.stop();
    this.element.focus({ preventScroll: true });
    const at = this.position(event);
    if (this.held.size < 2) {
      try {
        this.element.setPointerCapture(event.pointerId);
      } catch {
        // A pointer that is already gone is let go soon.
      }
      this.held.set(event.pointerId, { ...at, startX: at.x, startY: at.y, time: event.timeStamp });
    }
    this.isClick = this.held.size === 1;
    if (this.isMoving) this.letGo();
    if (this.isClick) this.isMoving = this.globe.grab(at, event.pointerType);
    this.grab();
  }

  // Where the pointers are now is what they hold.
  grab() {
    const fingers = [...this.held.values()];
    const { camera } = this.globe;
    if (fingers.length === 1) this.grabbed = camera.placeAt(fingers[0].x, fingers[0].y, true);
    if (fingers.length === 2) {
      const { x, y, distance } = between(fingers);
      this.grabbed = camera.placeAt(x, y, true);
      this.pinch = { distance, zoom: camera.zoom };
    }
  }

  move(event) {
    const finger = this.held.get(event.pointerId);
    const at = this.position(event);
    if (finger === undefined) {
      if (this.held.size === 0 && event.pointerType !== "touch") this.globe.point(at);
      return;
    }
    if (Math.hypot(at.x - finger.startX, at.y - finger.startY) > clickDistance) this.isClick = false;
    const elapsed = Math.max(1, event.timeStamp - finger.time);
    const velocity = { x: (at.x - finger.x) / elapsed, y: (at.y - finger.y) / elapsed, time: event.timeStamp };
    Object.assign(finger, at, { time: event.timeStamp });
    if (this.isClick) return;
    const { camera } = this.globe;
    const fingers = [...this.held.values()];
    if (this.isMoving) {
      this.globe.drag(at);
    } else if (fingers.length === 1) {
      camera.drag(this.grabbed, at.x, at.y);
      this.speed = velocity;
    } else {
      const { x, y, distance } = between(fingers);
      camera.setZoom((this.pinch.zoom * distance) / Math.max(1, this.pinch.distance));
      camera.drag(this.grabbed, x, y);
    }
    this.globe.redraw();
  }

  up(event) {
    if (!this.held.delete(event.pointerId)) return;
    const at = this.position(event);
    if (this.isMoving) this.letGo();
    if (this.held.size > 0) {
      this.speed = null;
      this.grab();
    } else if (this.isClick && event.type === "pointerup") {
      this.click(at, event);
    } else if (this.speed !== null && event.timeStamp - this.speed.time < 60 && !this.isReduced.matches) {
      this.globe.glide(this.speed);
    }
  }

  letGo() {
    this.isMoving = false;
    this.globe.drop();
  }

  click(at, event) {
    const last = this.lastClick;
    const distance = doubleDistance[event.pointerType] ?? doubleDistance.other;
    const isDouble = last && event.timeStamp - last.time < doubleTime && Math.hypot(at.x - last.x, at.y - last.y) < distance;
    this.lastClick = isDouble ? null : { ...at, time: event.timeStamp };
    if (isDouble) this.globe.doubleClick(at.x, at.y, event.shiftKey);
    else this.globe.click(at.x, at.y);
  }

  wheel(event) {
    event.preventDefault();
    this.globe.stop();
    const lines = event.deltaMode === 1 ? 20 : 1;
    const factor = Math.exp(-Math.max(-200, Math.min(200, event.deltaY * lines)) * (event.ctrlKey ? 0.01 : 0.0022));
    const { x, y } = this.position(event);
    this.globe.camera.zoomAt(factor, x, y);
    this.globe.redraw();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { globe } = this;
    const { camera } = globe;
    const step = event.shiftKey ? keyStep / 6 : keyStep;
    const actions = {
      ArrowLeft: () => camera.pan(step, 0),
      ArrowRight: () => camera.pan(-step, 0),
      ArrowUp: () => camera.pan(0, step),
      ArrowDown: () => camera.pan(0, -step),
      "+": () => camera.setZoom(camera.zoom * 1.4),
      "=": () => camera.setZoom(camera.zoom * 1.4),
      "-": () => camera.setZoom(camera.zoom / 1.4),
      Home: () => globe.home(),
      n: () => globe.northUp(),
      Enter: () => globe.click(camera.width / 2, camera.height / 2),
      " ": () => globe.click(camera.width / 2, camera.height / 2),
      Escape: () => globe.choose(null),
      "?": () => globe.help(),
    };
    const action = globe.actions?.[event.key] ?? actions[event.key];
    if (action === undefined) return;
    event.preventDefault();
    globe.stop();
    action();
    globe.redraw();
  }
}

function between([a, b]) {
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, distance: Math.hypot(a.x - b.x, a.y - b.y) };
}

// The speed, in pixels a millisecond, after `elapsed` more milliseconds; null once it is too slow to see.
export function slowed(speed, elapsed) {
  const factor = Math.exp(-slowing * elapsed);
  const next = { x: speed.x * factor, y: speed.y * factor };
  return Math.hypot(next.x, next.y) < 0.01 ? null : next;
}
