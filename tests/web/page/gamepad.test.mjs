import assert from "node:assert/strict";
import { mock, test } from "node:test";

import { openWindow, send } from "../browser.mjs";

mock.timers.enable({ apis: ["setInterval"] });
const { document } = openWindow();
const pad = { index: 0, connected: true, axes: [0, 0], buttons: [] };
Object.defineProperty(globalThis, "navigator", { value: { getGamepads: () => [null, pad] }, configurable: true });
const { Gamepads } = await import("../../../web/page/gamepad.js");

const did = [];
const keys = {
  press: (source, code) => did.push(["press", source, code]),
  release: (source) => did.push(["release", source]),
  setStick: (source, { forward, turn }) => did.push(["stick", forward !== 0, turn !== 0]),
};
const pads = new Gamepads(keys);
const BINDINGS = { forward: ["KeyW"], turn_left: ["KeyA"], jump: ["Space"], wave: ["KeyV"], restart: ["KeyR"] };

function poll({ axes = [0, 0], buttons = [] } = {}) {
  Object.assign(pad, { axes, buttons: Array.from({ length: 16 }, (_, index) => ({ pressed: buttons.includes(index) })) });
  did.length = 0;
  mock.timers.tick(20);
  return did;
}

test("buttons press and release the agent's keys, each once", () => {
  pads.bind(BINDINGS, false);
  assert.deepEqual(poll({ buttons: [0, 12] }), [["press", "gamepad 0 button 12", "KeyW"], ["press", "gamepad 0 button 0", "Space"]]);
  assert.deepEqual(poll({ buttons: [0, 12] }), []);
  assert.deepEqual(poll({ buttons: [12] }), [["release", "gamepad 0 button 0"]]);
  poll();
});

test("an action without a usual button gets a spare one, and Start restarts", () => {
  assert.deepEqual(poll({ buttons: [2, 9] }).map(([, , code]) => code), ["KeyV", "KeyR"]);
  poll();
});

test("each direction of the cross is its own button", () => {
  pads.bind({ forward: ["KeyW"], turn_left: ["KeyA"], backward: ["KeyS"], turn_right: ["KeyD"] }, false);
  for (const [button, code] of [[12, "KeyW"], [13, "KeyS"], [14, "KeyA"], [15, "KeyD"]]) {
    assert.deepEqual(poll({ buttons: [button] }).at(0), ["press", `gamepad 0 button ${button}`, code]);
    poll();
  }
  for (const [axes, code] of [[[0, 1], "KeyS"], [[1, 0.5], "KeyD"], [[-1, 0], "KeyA"]]) {
    assert.deepEqual(poll({ axes }), [["press", "gamepad 0 stick", code]]);
    poll();
  }
  const others = Object.fromEntries(["a", "b", "c", "d", "e", "f", "g"].map((name) => [name, [`Key${name}`]]));
  pads.bind(others, false);
  assert.deepEqual(poll({ buttons: [2, 3, 4, 5, 6, 7] }).map(([, , code]) => code), ["Keya", "Keyb", "Keyc", "Keyd", "Keye", "Keyf"]);
  poll();
  pads.bind(BINDINGS, false);
});

test("the stick is a key where an agent takes no axes, from half its way on", () => {
  assert.deepEqual(poll({ axes: [0, -1] }), [["press", "gamepad 0 stick", "KeyW"]]);
  assert.deepEqual(poll({ axes: [-1, 0] }), [["press", "gamepad 0 stick", "KeyA"]]);
  assert.deepEqual(poll({ axes: [0, -0.3] }), [["release", "gamepad 0 stick"]]);
});

test("the stick gives axes where an agent takes them", () => {
  pads.bind(BINDINGS, true);
  assert.deepEqual(poll({ axes: [0, -1] }), [["stick", true, false]]);
  assert.deepEqual(poll({ axes: [0, -1] }), []);
  assert.deepEqual(poll({}), [["stick", false, false]]);
});

test("nothing is pressed while another page has the focus", () => {
  mock.method(document, "hasFocus", () => false);
  assert.deepEqual(poll({ axes: [0, -1], buttons: [0] }), [["stick", false, false]]);
  mock.restoreAll();
});

test("a gamepad that is gone is not asked any more", () => {
  pad.connected = false;
  send("gamepaddisconnected");
  pad.connected = true;
  assert.deepEqual(poll({ buttons: [0] }), []);
});
