import assert from "node:assert/strict";
import { test } from "node:test";

const navigator = { keyboard: { getLayoutMap: async () => new Map([["KeyY", "z"], ["Space", " "]]) } };
Object.defineProperty(globalThis, "navigator", { value: navigator, configurable: true, writable: true });
const { caption, label, loadLayout } = await import("../../../web/page/labels.js");

test("keys are named as on an English keyboard, until the layout is known", async () => {
  assert.deepEqual(["KeyY", "Digit4", "ArrowUp", "ShiftLeft", "Space"].map(label), ["Y", "4", "↑", "Shift", "Space"]);
  await loadLayout();
  assert.deepEqual(["KeyY", "KeyW", "Space"].map(label), ["Z", "W", "Space"]);
});

test("a keyboard that can't be asked changes nothing", async () => {
  navigator.keyboard.getLayoutMap = () => Promise.reject(new Error("not in this frame"));
  await loadLayout();
  assert.equal(label("KeyY"), "Z");
});

test("an action's name is the scene's, else a short word, else its own", () => {
  assert.equal(caption("jump", { jump: "hop" }), "hop");
  assert.equal(caption("turn_left"), "left");
  assert.equal(caption("put_down_box"), "put down box");
});
