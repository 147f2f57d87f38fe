/** The page's own part: what is held, who drives, and what has happened. viser draws the rest. */

import { Banners } from "./banners.js";
import { element } from "./dom.js";
import { Gamepads } from "./gamepad.js";
import { Help } from "./help.js";
import { KeyMap } from "./keymap.js";
import { HeldKeys } from "./keys.js";
import { Keycaps } from "./keycaps.js";
import { label, learnLayout } from "./labels.js";
import { Pill } from "./pill.js";
import { cross } from "./places.js";
import { followScene } from "./scene.js";
import { foldSheet } from "./sheet.js";
import { InputSocket } from "./socket.js";

const query = new URLSearchParams(location.search);
const agent = query.get("agent");

let hello = { you: 0, agent, keys: {}, captions: {}, brain: "", name: "", stick: false, others: "", instead: "" };
let seat = { driver: null, pages: 1 };
let state = null;
let connected = false;
let hasActed = false;

// viser leaves the query out of the address that it connects to, and comes back when it has the focus
const tellAgent = () => (document.cookie = `ai4u_edu_agent=${encodeURIComponent(agent ?? "")}; SameSite=Strict`);
tellAgent();
addEventListener("focus", tellAgent);

const socket = new InputSocket("ws/input" + (agent === null ? "" : `?agent=${encodeURIComponent(agent)}`));
const keymap = new KeyMap();
const keys = new HeldKeys(() => {
  socket.send({ type: "keys", held: keys.held, stick: keys.stick });
  draw();
});
const row = element("div", { className: "ai4u-row" });
const dock = element("section", { className: "ai4u-dock", ariaLabel: "Drive" });
document.body.append(dock);
const caps = new Keycaps(dock, keys, keymap);
dock.append(row);
const pill = new Pill(
  row,
  () => socket.send({ type: "take" }),
  () => {
    keys.releaseAll();
    socket.send({ type: "let_go" });
  },
);
const gamepads = new Gamepads(keys);
const help = new Help(row, keys, keymap, arrange);
const banners = new Banners((name) => socket.send({ type: "command", name }));

keys.onpress = (code) => {
  hasActed = true;
  // no decision is taken while the world stands, and whoever else drives hears no key
  if ((state?.error || hello.others) && hello.keys.restart?.includes(code)) {
    socket.send({ type: "command", name: "reset" });
  }
};

socket.onopen = () => {
  connected = true;
  draw();
};
socket.onclose = (reason) => {
  connected = false;
  state = null;
  keys.releaseAll();
  banners.fatal(reason);
  draw();
};
socket.onanother = () => {
  hasActed = false;
  socket.path = `ws/input?after_another&agent=${encodeURIComponent(hello.agent ?? "")}`;
};
socket.onmessage = (message) => {
  switch (message.type) {
    case "hello":
      hello = message;
      arrange();
      break;
    case "seat":
      if (seat.driver === hello.you && message.driver !== hello.you) keys.releaseAll();
      seat = message;
      break;
    case "state":
      if (message.paused && !state?.paused) keys.releaseAll();
      state = message;
      break;
    case "error":
      banners.complain(message.text);
      break;
  }
  draw();
};

/** Who is told which key, cap or button means what. */
function arrange() {
  keymap.arrange(hello.keys, hello.captions);
  keys.bind(keymap.means);
  caps.arrange(hello.keys, hello.stick);
  gamepads.bind(hello.keys, hello.stick);
  help.refresh();
  draw();
}

function draw() {
  const mine = seat.driver === hello.you;
  const { held } = keys;
  caps.draw(mine || held.length ? held : (state?.held ?? []));
  pill.draw({ connected, hello, seat, way: way() });
  help.tell(state?.goal || "This scene has none: look around.");
  const isDriven = Object.keys(hello.keys).length > 0 && !hello.others;
  banners.draw(connected ? state : null, {
    restart: label(keymap.keys.restart?.[0] ?? ""),
    name: isDriven ? "" : hello.name,
    isNew: !hasActed,
  });
}

/** How one begins to drive, in words. */
function way() {
  if (dock.hasAttribute("data-touch")) return hello.stick ? "push the stick" : "tap a key";
  if (!hello.others) return "press a key";
  const first = [...cross(hello.keys).values(), ...Object.keys(hello.keys)][0];
  return `press ${label(keymap.keys[first]?.[0] ?? "")}`;
}

// a notebook shows the frame that it made for us as soon as we are there
if (window.parent !== window) window.parent.postMessage("ai4u-edu", "*");

draw();
learnLayout().then(arrange);
socket.open();
followScene();
foldSheet();
