/** The page that checks a browser and its network before a class. */

import { element, find } from "../../shared/dom.js";
import { t } from "../../shared/text.js";

const ECHOES = 5;
const ECHO_TIMEOUT_MS = 5000;
/** From this round trip on, driving feels late. */
const MAX_ROUND_TRIP_MS = 150;
const DRIVING_KEYS = ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "KeyW", "KeyA", "KeyS", "KeyD"];
/** @type {Record<string, string>} */
const SIGNS = { yes: "✓", no: "×", open: "…" };
const list = find("#checks");
const result = find("#result");
/** @type {Map<string, HTMLElement>} */
const lines = new Map();

add("browser", t("This browser can read the page"));
add("cookies", t("It keeps your seat (cookies)"));
add("graphics", t("It draws the world (WebGL 2)"));
add("connection", t("The network lets the world through (WebSocket)"));
add("speed", t("The network is fast enough"));
add("keys", t("Keys arrive"));
tell("browser", true);
checkCookies();
checkGraphics();
checkNetwork();
checkKeys();

/**
 * @param {string} name
 * @param {string} text
 */
function add(name, text) {
  const line = element(
    "li",
    { dataset: { answer: "open" } },
    element("span", { className: "ai4u-sign", textContent: SIGNS.open, "aria-hidden": "true" }),
    element("span", {}, element("strong", { textContent: text }), element("span", { className: "ai4u-answer" }), element("small")),
  );
  lines.set(name, line);
  list.append(line);
}

/**
 * Say yes or no, and one sentence.
 * @param {string} name
 * @param {boolean} isFine
 */
function tell(name, isFine, sentence = "") {
  const line = lines.get(name);
  line.dataset.answer = isFine ? "yes" : "no";
  line.querySelector(".ai4u-sign").textContent = SIGNS[line.dataset.answer];
  const word = isFine ? t("yes") : t("no");
  line.querySelector(".ai4u-answer").textContent = ` ${word}`;
  line.querySelector("small").textContent = sentence;
  sum();
}

function sum() {
  const answers = [...lines].map(([name, line]) => [name, line.dataset.answer]);
  const isBad = answers.some(([, answer]) => answer === "no");
  const isOpen = answers.some(([name, answer]) => answer === "open" && name !== "keys");
  const text = isBad ? t("Not everything works yet. Read the lines with a cross.") : isOpen ? t("Checking …") : t("Yes, this device can join.");
  if (result.textContent !== text) result.textContent = text;
  result.dataset.answer = isBad ? "no" : isOpen ? "open" : "yes";
}

function checkCookies() {
  tell("cookies", navigator.cookieEnabled, navigator.cookieEnabled ? "" : t("Allow cookies for this address; the class keeps one, for your seat."));
}

function checkGraphics() {
  const isFine = document.createElement("canvas").getContext("webgl2") !== null;
  const no = t("Turn on hardware acceleration in the browser's settings, update it, or use another browser.");
  tell("graphics", isFine, isFine ? "" : no);
}

async function checkNetwork() {
  try {
    const times = await roundTrips();
    tell("connection", true);
    const middle = times.sort((a, b) => a - b)[Math.floor(times.length / 2)];
    const isFine = middle <= MAX_ROUND_TRIP_MS;
    const measured = t("An answer takes {time} ms.", { time: Math.round(middle) });
    const slow = t("Driving will feel late; go nearer to the access point, or use a cable.");
    tell("speed", isFine, isFine ? measured : `${measured} ${slow}`);
  } catch {
    const no = t("A proxy or firewall between this device and the class stops WebSockets; ask for an exception for this address, or use another network.");
    tell("connection", false, no);
    tell("speed", false, t("It can't be measured without a connection."));
  }
}

/**
 * Resolve to round trip times (ms) of messages that come back.
 * @returns {Promise<number[]>}
 */
function roundTrips() {
  const url = new URL("./check/socket", document.baseURI);
  url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
  return new Promise((resolve, reject) => {
    const socket = new WebSocket(url);
    /** @type {number[]} */
    const times = [];
    let sent = 0;
    const timer = setTimeout(() => socket.close(), ECHO_TIMEOUT_MS);
    const ask = () => {
      sent = performance.now();
      socket.send(`echo ${times.length}`);
    };
    socket.onopen = ask;
    socket.onmessage = ({ data }) => {
      if (data !== `echo ${times.length}`) return;
      times.push(performance.now() - sent);
      if (times.length < ECHOES) ask();
      else socket.close();
    };
    socket.onclose = () => {
      clearTimeout(timer);
      if (times.length > 0) resolve(times);
      else reject(new Error("no answer"));
    };
  });
}

function checkKeys() {
  const hasTouch = matchMedia("(pointer: coarse)").matches;
  const how = hasTouch ? t("A tablet or phone drives with the stick on the screen. With a keyboard, press an arrow key or W.") : t("Press an arrow key or W now.");
  lines.get("keys").querySelector("small").textContent = how;
  addEventListener("keydown", (event) => {
    if (!DRIVING_KEYS.includes(event.code)) return;
    event.preventDefault();
    tell("keys", true);
  });
}
