import assert from "node:assert/strict";
import { test } from "node:test";

import { openWindow } from "../browser.mjs";

const { kept } = openWindow();
const { KeyMap } = await import("../../../web/page/keymap.js");
const BINDINGS = { forward: ["KeyW", "ArrowUp"], backward: ["KeyS"], jump: ["Space"] };

function keymap(choices = {}) {
  kept.set("ai4u-keys", JSON.stringify(choices));
  const made = new KeyMap();
  made.arrange(BINDINGS, { jump: "hop" });
  return made;
}

test("without choices the keys are the scene's", () => {
  const keys = keymap();
  assert.deepEqual(keys.keys, BINDINGS);
  assert.equal(keys.isChanged, false);
  assert.equal(keys.sentCodes.get("ArrowUp"), "ArrowUp");
});

test("a chosen key is sent as the first of the action's own", () => {
  const keys = keymap();
  assert.equal(keys.change("forward", "KeyI"), "");
  assert.deepEqual(keys.keys.forward, ["KeyI"]);
  assert.equal(keys.sentCodes.get("KeyI"), "KeyW");
  assert.equal(keys.sentCodes.has("KeyW"), false);
});

test("a key of another action changes places with it", () => {
  const keys = keymap();
  assert.equal(keys.change("jump", "KeyS"), "S was “back”, which is Space now.");
  assert.deepEqual(keys.keys, { forward: ["KeyW", "ArrowUp"], backward: ["Space"], jump: ["KeyS"] });
});

test("an action keeps its other keys", () => {
  const keys = keymap();
  assert.equal(keys.change("jump", "ArrowUp"), "↑ was “forward”, which is W now.");
});

test("keys of the browser are refused", () => {
  const keys = keymap();
  for (const code of ["Tab", "F5", "ControlLeft", "Meta", "no key"]) assert.match(keys.change("jump", code), /needed elsewhere/);
  assert.equal(keys.isChanged, false);
});

test("choices are kept by place on the pad, so they hold in every scene, until they are reset", () => {
  keymap().change("forward", "KeyI");
  assert.deepEqual(JSON.parse(kept.get("ai4u-keys")), { "at up": ["KeyI"] });
  const other = new KeyMap();
  other.arrange({ up: ["KeyW"] });
  assert.deepEqual(other.keys, { up: ["KeyI"] });
  other.reset();
  assert.deepEqual(other.keys, { up: ["KeyW"] });
  assert.equal(kept.has("ai4u-keys"), false);
});

test("stored entries that are no codes are ignored", () => {
  assert.equal(keymap({ jump: "KeyX", forward: ["<b>"] }).isChanged, false);
});

test("names are the scene's, else words", () => {
  const keys = keymap();
  assert.deepEqual(["jump", "backward", "pick_up"].map((action) => keys.name(action)), ["hop", "back", "pick up"]);
});
