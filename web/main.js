/** The page's own part: keys that are held, who drives, and what has happened. viser draws the rest. */

import { Banners } from "./banners.js";
import { HeldKeys } from "./keys.js";
import { Keycaps } from "./keycaps.js";
import { label, learnLayout } from "./labels.js";
import { foldSheet } from "./sheet.js";
import { InputSocket } from "./socket.js";

const query = new URLSearchParams(location.search);
const agent = query.get("agent");

let hello = { you: 0, keys: {}, captions: {}, brain: "", name: "" };
let seat = { driver: null, pages: 1 };
let state = null;
let connected = false;
let hasActed = false;

// viser leaves the query out of the address that it connects to, and comes back when it has the focus
const tellAgent = () => (document.cookie = `ai4u_edu_agent=${encodeURIComponent(agent ?? "")}; SameSite=Strict`);
tellAgent();
addEventListener("focus", tellAgent);

const socket = new InputSocket("ws/input" + (agent === null ? "" : `?agent=${encodeURIComponent(agent)}`));
const keys = new HeldKeys((held) => {
  socket.send({ type: "keys", held });
  draw();
});
const caps = new Keycaps(keys, () => socket.send({ type: "take" }));
const banners = new Banners((name) => socket.send({ type: "command", name }));

keys.onpress = (code) => {
  hasActed = true;
  // no decision is taken while the world stands, so nobody would hear the key
  if (state?.error && hello.keys.restart?.includes(code)) {
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
socket.onmessage = (message) => {
  switch (message.type) {
    case "hello":
      hello = message;
      keys.bind(Object.values(hello.keys).flat());
      caps.arrange(hello.keys, hello.captions);
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

function draw() {
  const mine = seat.driver === hello.you;
  caps.draw({ connected, hello, seat, held: mine || keys.held.length ? keys.held : state?.held ?? [] });
  const isDriven = Object.keys(hello.keys).length > 0;
  banners.draw(connected ? state : null, {
    restart: label(hello.keys.restart?.[0] ?? ""),
    name: isDriven ? "" : hello.name,
    isNew: !hasActed,
  });
}

draw();
learnLayout().then(() => {
  caps.arrange(hello.keys, hello.captions);
  draw();
});
socket.open();
foldSheet();
