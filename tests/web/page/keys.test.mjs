import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

import { openWindow, send } from "../browser.mjs";

mock.timers.enable({ apis: ["setTimeout", "setInterval"] });
let [changes, keys] = [0, null];
openWindow();
const { HeldKeys, isTextInput } = await import("../../../web/page/keys.js");

beforeEach(() => {
  openWindow();
  changes = 0;
  keys = new HeldKeys(() => (changes += 1));
  keys.bind(new Map([["KeyI", "KeyW"], ["Space", "Space"]]));
});

function key(type, code, more = {}) {
  const event = { code, target: document.body, isPrevented: false, isStopped: false, ...more };
  event.preventDefault = () => (event.isPrevented = true);
  event.stopPropagation = () => (event.isStopped = true);
  send(type, event);
  return event;
}

test("a held key is sent as the agent's, at once and again and again", () => {
  assert.equal(key("keydown", "KeyI").isPrevented, true);
  assert.deepEqual([keys.held, changes], [["KeyW"], 1]);
  mock.timers.tick(250);
  assert.equal(changes, 3);
  key("keyup", "KeyI");
  assert.deepEqual([keys.held, changes], [[], 4]);
  mock.timers.tick(1000);
  assert.equal(changes, 4);
});

test("a key that moves viser's camera is kept from it, but is not the agent's", () => {
  const event = key("keydown", "ArrowUp");
  assert.deepEqual([event.isStopped, event.isPrevented, keys.held], [true, false, []]);
  assert.equal(key("keydown", "KeyB").isStopped, false);
});

test("the end of a key is kept from others, and presses no button", () => {
  key("keydown", "Space");
  const event = key("keyup", "Space");
  assert.deepEqual([event.isStopped, event.isPrevented], [true, true]);
  assert.equal(key("keyup", "KeyB").isStopped, false);
});

test("keys that compose a letter are the browser's", () => {
  key("keydown", "KeyI", { isComposing: true });
  assert.deepEqual(keys.held, []);
});

test("other keys are offered once, and shortcuts are the browser's", () => {
  const offered = [];
  keys.onotherpress = ({ code }) => offered.push(code) > 0;
  assert.equal(key("keydown", "KeyB").isPrevented, true);
  key("keydown", "KeyB", { repeat: true });
  key("keydown", "KeyB", { ctrlKey: true });
  assert.deepEqual(offered, ["KeyB"]);
});

test("a command key releases what is held", () => {
  key("keydown", "KeyI");
  key("keydown", "Space", { metaKey: true });
  assert.deepEqual(keys.held, []);
});

test("nothing is held while a dialog is open, or after the page was left", () => {
  keys.isSuspended = () => true;
  key("keydown", "KeyI");
  assert.deepEqual(keys.held, []);
  keys.isSuspended = () => false;
  key("keydown", "KeyI");
  send("blur");
  assert.deepEqual(keys.held, []);
});

test("a control that was reached by a key keeps its own keys until a pointer is used", () => {
  const control = new HTMLElement();
  key("keydown", "Tab");
  send("focusin", { target: control });
  key("keydown", "Space", { target: control });
  assert.deepEqual(keys.held, []);
  send("pointerdown");
  key("keydown", "Space", { target: control });
  assert.deepEqual(keys.held, ["Space"]);
});

test("sticks are added, within -1 and 1, and sent seldom", () => {
  mock.method(performance, "now", () => 1000);
  keys.setStick("a", { forward: 0.75, turn: -0.5 });
  keys.setStick("b", { forward: 0.75, turn: 0.25 });
  assert.deepEqual([keys.stick, changes], [{ forward: 1, turn: -0.25 }, 1]);
  keys.setStick("c", { forward: -3, turn: -1 });
  assert.deepEqual(keys.stick, { forward: -1, turn: -1 });
  keys.setStick("c", { forward: 0, turn: 0 });
  assert.equal(changes, 2); // a stick that comes to rest is told at once
  keys.setStick("b", { forward: 0.5, turn: 0.25 });
  mock.timers.tick(25);
  assert.equal(changes, 3);
  keys.setStick("a", { forward: 0, turn: 0 });
  keys.setStick("b", { forward: 0, turn: 0 });
  assert.deepEqual([keys.stick, changes], [{ forward: 0, turn: 0 }, 5]);
  mock.restoreAll();
});

test("at most 16 keys are held", () => {
  for (let count = 0; count < 20; count += 1) keys.press(`pointer ${count}`, `Key${count}`);
  assert.equal(keys.held.length, 16);
});

test("text fields are told from other controls", () => {
  const input = (type) => Object.assign(new HTMLInputElement(), { type });
  assert.deepEqual([input("text"), input("checkbox"), new HTMLElement(), null].map(isTextInput), [true, false, false, false]);
  assert.equal(isTextInput(Object.assign(new HTMLElement(), { closest: () => ({}) })), true);
});
