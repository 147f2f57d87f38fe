/** Entry point of our part of the page: keys, driver status and banners. viser draws the rest. */

/**
 * @import { Commands, ErrorEvent, HelloEvent, SeatEvent, StateEvent } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 * @import { ClassEvent } from "../types/class.js"
 */
import "../panel/shortcuts.js"; // the first one: its listener comes before the one that drives
import { roomOfPage } from "../shared/room.js";
import { Banners } from "./banners.js";
import { ClassBar } from "../classroom/student/bar.js";
import { noteRole } from "../classroom/student/hand_in_dialog.js";
import { noteHandout } from "../classroom/student/handout.js";
import { showLeft } from "../classroom/student/overlay.js";
import { element, setAttributes } from "../shared/dom.js";
import { noteAssigned } from "../missions/progress.js";
import { dpadActions } from "./dpad.js";
import { DriverStatus } from "./driver_status.js";
import { Effects, flyStars } from "./effects.js";
import { keysReachPage, watchFocus } from "./focus.js";
import { Gamepads } from "./gamepad.js";
import { Help } from "./help.js";
import { KeyMap, RESERVED_CODE } from "./keymap.js";
import { HeldKeys } from "./keys.js";
import { Keycaps } from "./keycaps.js";
import { label, loadLayout } from "./labels.js";
import { trackCanvasEdges } from "./canvas_edges.js";
import { watchSharedScene } from "../scenes/share.js";
import { stars } from "../scenes/stars.js";
import { PictureRate } from "./resolution.js";
import { KEYS, NETWORK, PROGRAM, Results } from "./results.js";
import { JsonSocket } from "../shared/socket.js";
import { t } from "../shared/text.js";
import { translateNotices } from "./viser_words.js";

/** Code of the key for a new start, unless the agent or the person uses it for something else. */
const NEW_START_CODE = "KeyN";
/** Time without a connection (ms) after which the page says so; another world takes less. */
const LOST_MS = 3000;
/** Value of `waiting` while a teacher holds the world. */
const HELD = "teacher";

const HAS_PANEL = "ai4uPanel" in document.documentElement.dataset;

const query = new URLSearchParams(location.search);
const agent = query.get("agent");

/** @type {Omit<HelloEvent, "type">} */
let hello = { you: 0, agent, keys: {}, captions: {}, brain: "", name: "", stick: false, others: "", instead: "", is_network: false };
/** @type {Omit<SeatEvent, "type">} */
let control = { driver: null, pages: 1 };
/** @type {StateEvent | null} */
let state = null;
let connected = false;
/** True once the connection has been gone for {@link LOST_MS}. */
let isLost = false;
let lostTimer = 0;
let hasActed = false;

// A cookie, because viser's WebSocket address lacks the query. Set again on focus, when viser reconnects:
// another page may have changed it.
const setAgentCookie = () => (document.cookie = `ai4u_edu_agent=${encodeURIComponent(agent ?? "")}; SameSite=Strict`);
setAgentCookie();
addEventListener("focus", setAgentCookie);

const socket = new JsonSocket("ws/input" + (agent === null ? "" : `?agent=${encodeURIComponent(agent)}`));
const keymap = new KeyMap();
const pictureRate = new PictureRate();
const keys = new HeldKeys(() => {
  pictureRate.follow(keys.held.length > 0);
  if (!isHeld()) socket.send({ type: "keys", held: keys.held, stick: keys.stick });
  followMotor();
  draw();
});
const row = element("div", { className: "ai4u-row" });
const dock = element("section", { className: "ai4u-dock", ariaLabel: t("Drive") });
document.body.append(dock);
const keycaps = new Keycaps(dock, keys, keymap);
dock.append(row);
const take = () => socket.send({ type: "take" });
const letGo = () => {
  keys.releaseAll();
  socket.send({ type: "let_go" });
};
const driverStatus = new DriverStatus(row, take, letGo);
/**
 * The bar of a class; null where there is none.
 * @type {ClassBar | null}
 */
let classBar = null;
/**
 * The panel; null where the server has none.
 * @type {Panel | null}
 */
let panel = null;
const gamepads = new Gamepads(keys);
const help = new Help(row, keys, keymap, arrange);
const effects = new Effects(row);
const results = new Results();
/** @param {keyof Commands} command one that needs no arguments */
const send = (command) => socket.send({ type: "do", id: 0, command });
const banners = new Banners(send, {
  beat: () => void panel?.watch.beat(),
  stop_watching: () => void panel?.watch.stop(),
});
/** The episode in which something else than a person has driven: its time is nobody's best. */
let helpedEpisode = "";

keys.onpress = () => (hasActed = true);
keys.onotherpress = ({ code, key }) => {
  const isForHelp = key === "?" || key === "Shift";
  if (!canDrive() || RESERVED_CODE.test(code) || isForHelp) return false;
  if (code === NEW_START_CODE) send("new_start");
  else if (state?.waiting && !hello.others) socket.send({ type: "start" });
  else return false;
  hasActed = true;
  return true;
};
watchFocus(draw);

socket.onopen = () => {
  connected = true;
  clearTimeout(lostTimer);
  lostTimer = 0;
  isLost = false;
  draw();
};
socket.onclose = (reason) => {
  connected = false;
  state = null;
  keys.releaseAll();
  lostTimer ||= setTimeout(() => {
    isLost = true;
    draw();
  }, LOST_MS);
  if (reason && roomOfPage()) showLeft(reason);
  else banners.setConnectionError(reason);
  draw();
};
socket.onworldreplaced = () => {
  if (panel) panel.program = null;
  hasActed = false;
  socket.path = `ws/input?after_another&agent=${encodeURIComponent(hello.agent ?? "")}`;
};
socket.onmessage = (/** @type {HelloEvent | SeatEvent | StateEvent | ClassEvent | ErrorEvent} */ message) => {
  switch (message.type) {
    case "hello":
      hello = message;
      arrange();
      break;
    case "seat":
      if (control.driver === hello.you && message.driver !== hello.you) keys.releaseAll();
      control = message;
      break;
    case "state":
      if ((message.paused && !state?.paused) || (message.waiting === HELD && !isHeld())) keys.releaseAll();
      effects.follow(state, message, isMyDrive());
      state = message;
      followMotor();
      break;
    case "class":
      classBar ??= new ClassBar(draw);
      classBar.show(message);
      effects.allowSound(message.switches.sound);
      noteHandout(message.program);
      noteRole(message.role);
      if (message.role === "student") noteAssigned(message.mission);
      break;
    case "error":
      banners.showRequestError(message.text);
      break;
  }
  draw();
  if (message.type === "state" && message.outcome) panel?.dispatchEvent(new Event("win"));
};

/** Apply the agent's key bindings to the keyboard, the screen's keys, gamepads and the help. */
function arrange() {
  keymap.arrange(hello.keys, hello.captions);
  keys.bind(keymap.sentCodes);
  keycaps.arrange(hello.keys, hello.stick);
  gamepads.bind(hello.keys, hello.stick);
  help.refresh();
  draw();
}

function draw() {
  const isMine = control.driver === hello.you;
  const { held } = keys;
  keycaps.draw(!isHeld() && (isMine || held.length) ? held : (state?.held ?? []));
  const isWaiting = state?.waiting === "key";
  const isReached = dock.hasAttribute("data-touch") || keysReachPage();
  const named = { ...control, name: classBar?.nameOf(control.seat) };
  const status = { connected, hello: panel?.named(hello) ?? hello, control: named, howToDrive: howToDrive(), isPaused: Boolean(state?.paused), isWaiting, isHeld: isHeld(), isReached };
  driverStatus.draw(status);
  panel?.drawDriver(status);
  help.setGoal(state?.goal || t("This scene has none: look around."));
  const isDriven = Object.keys(hello.keys).length > 0 && !hello.others;
  if (hello.others && state && !state.waiting && !state.outcome) helpedEpisode = episodeName();
  const isWatching = Boolean(panel?.watch.isOn && hello.others);
  const race = panel?.watch.race ?? null;
  const scene = panel?.part("scene");
  const task = HAS_PANEL && !scene ? "" : scene?.key || state?.title;
  const result = results.of(connected ? state : null, task, task ? driverOfEpisode(isDriven) : "");
  const driver = panel?.hasProgram ? PROGRAM : isDriven ? KEYS : otherDriver();
  panel?.drawBest(driver ? results.best(task, driver) : null, driver);
  banners.draw(connected ? state : null, {
    restart: dock.hasAttribute("data-touch") ? "" : label(keymap.keys.restart?.[0] ?? ""),
    name: isDriven ? "" : isWatching ? t("The network") : hello.name,
    isWatching,
    thought: isWatching ? panel.watch.thought : "",
    race: race && (race.ghost === "network") === !isWatching ? race : null,
    isNew: !hasActed,
    isLost,
    result,
    howToStart: canDrive() ? howToDrive() : "",
    held: isHeld() ? (classBar?.heldText ?? t("Your teacher has stopped this world")) : "",
  });
}

/**
 * Return what drives the present episode, for its time; empty for scripts elsewhere and tests.
 * @param {boolean} isDriven true if a person may drive by this page's keys
 */
function driverOfEpisode(isDriven) {
  const program = panel?.program;
  const isPrograms = program?.agent === hello.agent && program?.episode === state?.agent_episode;
  if (isPrograms) return program.isTest ? "" : PROGRAM;
  if (isDriven) return isMyDrive() && helpedEpisode !== episodeName() ? KEYS : ""; // another page may drive it
  return otherDriver();
}

function episodeName() {
  return `${state?.title} ${state?.episode} ${state?.agent_episode}`;
}

/** Return true if this page, or its program, drives the agent: others' robots make no sound. */
function isMyDrive() {
  if (panel?.hasProgram) return true;
  if (hello.others) return false;
  return control.driver === hello.you || (control.driver === null && hasActed);
}

/** Let the motor hum while this page's keys move the robot. */
function followMotor() {
  const isMoving = keys.held.length > 0 || keys.stick.forward !== 0 || keys.stick.turn !== 0;
  const isStill = !state || state.paused || state.outcome || state.past || state.waiting;
  effects.motor(isMoving && !isStill && control.driver === hello.you);
}

/** Return NETWORK if a network drives the agent, else an empty text. */
function otherDriver() {
  return hello.is_network ? NETWORK : "";
}

/** Return true while a teacher holds the world, or a race counts down. */
function isHeld() {
  return state?.waiting === HELD;
}

/** Return true if this page's keys drive its agent, or would if pressed. */
function canDrive() {
  return !isHeld() && Object.keys(hello.keys).length > 0 && (control.driver === null || control.driver === hello.you);
}

/** Return what a person does to start driving, in words. */
function howToDrive() {
  if (dock.hasAttribute("data-touch")) return hello.stick ? t("move the stick") : t("tap a key");
  if (!hello.others) return t("press a key");
  const first = [...dpadActions(hello.keys).values(), ...Object.keys(hello.keys)][0];
  return t("press {key}", { key: label(keymap.keys[first]?.[0] ?? "") });
}

// a notebook keeps its frame hidden until this message
if (window.parent !== window) window.parent.postMessage("ai4u-edu", "*");

stars.addEventListener("change", (event) => event instanceof CustomEvent && flyStars(event.detail));
draw();
loadLayout().then(arrange);
socket.open();
setAttributes(document.getElementById("root"), { role: "main", "aria-label": t("World") });
trackCanvasEdges();
translateNotices();
watchSharedScene();
if (HAS_PANEL) {
  const { startPanel } = await import("../panel/panel.js");
  panel = startPanel({ agent, take, letGo }, dock);
  for (const type of ["part:scene", "part:watch", "thought"]) panel.addEventListener(type, draw);
  panel.addEventListener("celebrate", (event) => {
    banners.showNews(/** @type {CustomEvent<string>} */ (event).detail);
    effects.celebrate();
  });
  draw();
}
