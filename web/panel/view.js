/** The picture of the world: where its camera is, the trail, and the dark colours. */

/**
 * @import { ViewPart } from "../generated/messages.js"
 * @import { Panel } from "./panel.js"
 */
import { element } from "../shared/dom.js";
import { t } from "../shared/text.js";
import { segments, toggle } from "./widgets/parts.js";

/**
 * Short words, for five in one row; `name` is the whole, for screen readers and missions.
 * @type {{value: ViewPart["camera"], text: string, name?: string, title: string}[]}
 */
const CAMERAS = [
  { value: "arena", text: t("Arena"), title: t("See everything from above") },
  { value: "tilted", text: t("Tilted"), title: t("See everything at an angle, with depth") },
  { value: "follow", text: t("Follow"), title: t("Stay above the robot") },
  { value: "turn", text: t("Turn along"), title: t("Stay above the robot and turn with it") },
  { value: "eyes", text: t("Its eyes"), name: t("Through its eyes"), title: t("See what the robot would see") },
];

/** Longest time (ms) that the page waits for the end of its opening. */
const OPENING_LIMIT_MS = 5000;

const LESS_MOTION = matchMedia("(prefers-reduced-motion: reduce)");

export class ViewControls {
  element;

  /**
   * @param {Panel} panel
   * @param {HTMLElement} history the buttons to undo and redo
   */
  constructor(panel, history) {
    const cameras = segments(t("Camera"), CAMERAS, (mode) => panel.send("camera", { mode }, { quiet: true }));
    cameras.element.classList.add("ai4u-cameras");
    const trail = toggle(t("Trail"), (on) => panel.send("trail", { on }, { quiet: true }), { title: t("Draw the robot's way") });
    trail.element.classList.add("ai4u-details-only");
    panel.addEventListener("part:view", ({ detail }) => {
      cameras.set(detail.camera);
      trail.set(detail.has_trail);
    });
    const root = document.documentElement;
    const dark = toggle(t("Dark"), (on) => {
      dispatchEvent(new CustomEvent("ai4u-dark", { detail: on })); // page/dark.js keeps the choice
      panel.send("dark", { on }, { quiet: true });
    });
    const sendMotion = () => panel.send("reduce_motion", { on: LESS_MOTION.matches }, { quiet: true });
    LESS_MOTION.addEventListener("change", sendMotion);
    panel.addEventListener("connected", () => LESS_MOTION.matches && sendMotion());
    playOpening(panel);
    dark.set(root.dataset.ai4uScheme === "dark");
    const switches = element("div", { className: "ai4u-inline" }, trail.element, dark.element, history);
    this.element = element("section", { className: "ai4u-view", ariaLabel: t("Picture") }, cameras.element, switches);
  }
}

/**
 * Open with a short tilt of the camera, once a page load, which any key or pointer ends; data-ai4u-opening is set meanwhile.
 * @param {Panel} panel
 */
function playOpening(panel) {
  const root = document.documentElement;
  const [listening, untouched] = [new AbortController(), new AbortController()];
  let timer = 0;
  const stop = () => {
    listening.abort();
    untouched.abort();
    clearTimeout(timer);
    root.toggleAttribute("data-ai4u-opening", false);
  };
  const end = () => {
    untouched.abort();
    void panel.send("opening", { on: false }, { quiet: true });
  };
  const begin = () => {
    const options = { signal: listening.signal };
    const first = { signal: untouched.signal, capture: true, passive: true };
    for (const type of ["keydown", "pointerdown", "wheel"]) addEventListener(type, end, first);
    panel.addEventListener("part:view", ({ detail }) => detail.opening === "over" && stop(), options);
    panel.addEventListener("disconnected", stop, options);
    timer = setTimeout(stop, OPENING_LIMIT_MS);
    root.toggleAttribute("data-ai4u-opening", true);
    void panel.send("opening", { on: true }, { quiet: true });
  };
  if (!LESS_MOTION.matches) panel.addEventListener("connected", begin, { once: true });
}
