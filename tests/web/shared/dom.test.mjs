import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { openWindow, send } from "../browser.mjs";

openWindow();
const { element, keyed, unlessPressed } = await import("../../../web/shared/dom.js");

test("an element gets properties, attributes where there is no such property, data and handlers", () => {
  let clicks = 0;
  const made = element("p", { hidden: true, tabindex: 0, dataset: { place: 1 }, on: { click: () => (clicks += 1) } });
  made.dispatchEvent(new Event("click"));
  assert.deepEqual([made.hidden, made.tabindex, made.dataset.place, clicks], [true, "0", 1, 1]);
});

test("children that are false or null are left out, empty texts are not", () => {
  assert.deepEqual(element("p", {}, "a", false, null, undefined, "").children, ["a", ""]);
});

/** A list of elements. */
class List {
  children = [];
  moves = 0;
  get firstElementChild() {
    return this.children[0] ?? null;
  }
  insertBefore(child, next) {
    this.moves += 1;
    this.children = this.children.filter((other) => other !== child);
    this.children.splice(next === null ? this.children.length : this.children.indexOf(next), 0, child);
    child.list = this;
  }
}
class Item {
  dataset = {};
  get nextElementSibling() {
    const { children } = this.list;
    return children[children.indexOf(this) + 1] ?? null;
  }
  remove() {
    this.list.children = this.list.children.filter((other) => other !== this);
  }
}

let list;
const show = (keys) => keyed(list, keys, (key) => key, () => new Item(), (item, key) => (item.text = `text ${key}`));
const keys = () => list.children.map(({ dataset }) => dataset.key).join("");

beforeEach(() => {
  list = new List();
  show("abc");
});

test("children match a list and have its texts", () => {
  assert.equal(keys(), "abc");
  assert.deepEqual(list.children.map(({ text }) => text), ["text a", "text b", "text c"]);
});

test("an element stays with its item, and leaves with it", () => {
  const [a, , c] = list.children;
  show("cda");
  assert.equal(keys(), "cda");
  assert.deepEqual([list.children[0] === c, list.children[2] === a], [true, true]);
});

test("an element that stays is brought up to date and not moved: it may have the focus", () => {
  list.children[0].text = "";
  list.moves = 0;
  show("cab");
  assert.equal(keys(), "cab");
  assert.deepEqual([list.moves, list.children[1].text], [1, "text a"]);
});

/** A parent of the children a, b and c. */
const parent = { contains: (child) => "abc".includes(child) };

for (const type of ["click", "pointercancel", "contextmenu", "pointerup"]) {
  test(`a change waits while a child is pressed, until ${type}; only the last is made`, () => {
    const made = [];
    const frames = [];
    globalThis.requestAnimationFrame = (draw) => frames.push(draw);
    send("pointerdown", { target: "b" });
    unlessPressed(parent, () => made.push("first"));
    unlessPressed(parent, () => made.push("last"));
    assert.deepEqual(made, []);
    send(type);
    for (const draw of frames) draw();
    assert.deepEqual(made, ["last"]);
    unlessPressed(parent, () => made.push("next"));
    assert.deepEqual(made, ["last", "next"]);
  });
}

test("a change waits for nothing that is pressed elsewhere", () => {
  let made = 0;
  send("pointerdown", { target: "z" });
  unlessPressed(parent, () => (made += 1));
  send("click");
  assert.equal(made, 1);
});
