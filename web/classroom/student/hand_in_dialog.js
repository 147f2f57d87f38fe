/** The dialog with which a student hands in a network for a tournament of the class. */

/** @import { ClassEvent, HandedIn, Network } from "../../types/class.js" */

import { element, keyed, setText } from "../../shared/dom.js";
import { field, select, showForm } from "../../shared/form_dialog.js";
import { tell } from "../../shared/dialog.js";
import { t } from "../../shared/text.js";

const ADDRESS = "../../api/network";
/** Interval at which the class is asked for the verdict on a network (ms). */
const POLL_MS = 2000;
const UNREACHABLE = t("The class can't be reached. Try again in a moment.");
const NO_TOURNAMENT = t("There are no tournaments in this scene. Open one from the list of scenes, and let a robot learn there.");
const ALL_PARTS = t("All of my robots");

let canHandIn = false;

/** Says whether this page's networks can be handed in; tells of a change with the event "change". */
export const handIns = Object.assign(new EventTarget(), { isOpen: () => canHandIn });

/**
 * Note who looks at this page, as an event of the class has it.
 * @param {ClassEvent["role"]} role
 */
export function noteRole(role) {
  // elsewhere than on the page of a class's own machine, there is no such address
  const can = role === "student" && location.pathname.includes("/r/");
  if (canHandIn === can) return;
  canHandIn = can;
  handIns.dispatchEvent(new Event("change"));
}

/**
 * Let a student hand in a file, or a network that learned in this page.
 * @param {{title: string, scene: string, agent: string, file: File} | null} [own] the network, the scene and the agent in which it learned
 */
export async function showHandIn(own = null) {
  /** @type {HandedIn} */
  let facts;
  try {
    facts = await ask();
    if (own && !facts.scenes.some(({ name }) => name === own.scene)) throw new Error(NO_TOURNAMENT);
  } catch (error) {
    await tell(t("Nothing can be handed in"), error.message);
    return;
  }
  const first = own?.scene || facts.scene || facts.scenes.find(({ name }) => name === "sumo")?.name;
  const scene = select(facts.scenes.map(({ name, title }) => [name, title]), first);
  const part = element("select");
  const partField = field(t("It drives"), part, t("The scene’s own player drives robots for which you have no network."));
  const file = element("input", { type: "file", accept: ".onnx" });
  const list = element("ul", { className: "ai4u-handed-in", "aria-label": t("Handed in"), "aria-live": "polite" });
  let timer = 0;

  function showParts() {
    const parts = facts.scenes.find(({ name }) => name === scene.value)?.parts ?? [];
    part.replaceChildren(...["", ...parts].map((value) => element("option", { value, textContent: value || ALL_PARTS })));
    partField.hidden = parts.length === 0;
    part.value = parts.find((name) => own?.agent === name || own?.agent.endsWith(`_${name}`)) ?? "";
  }

  /** @param {HandedIn} answer */
  function show(answer) {
    facts = answer;
    const titles = Object.fromEntries(facts.scenes.map(({ name, title }) => [name, title]));
    keyed(list, facts.networks, ({ key }) => key, makeNetwork, (item, network) => updateNetwork(item, network, titles));
    clearTimeout(timer);
    if (list.isConnected && facts.networks.some(({ verdict }) => verdict === "open")) timer = setTimeout(refresh, POLL_MS);
  }

  async function refresh() {
    if (!list.isConnected) return;
    try {
      show(await ask());
    } catch {
      timer = setTimeout(refresh, POLL_MS); // it may come back
    }
  }

  scene.addEventListener("change", showParts);
  showParts();
  const text = t("For a tournament: your teacher lets the networks of the class play each other. The latest one counts.");
  const size = Math.round(facts.max_bytes / 2 ** 20);
  const sceneField = field(t("Scene"), scene);
  const fileField = field(t("Network (.onnx)"), file, t("At most {size} MB.", { size }));
  sceneField.hidden = fileField.hidden = own !== null;
  const content = [sceneField, partField, fileField, list];
  const title = own ? t("Hand in {title}", { title: own.title }) : t("Hand in a network");
  const shown = showForm({ title, text, content, yes: t("Hand in"), no: t("Close") }, async () => {
    const chosen = own?.file ?? file.files[0];
    if (!chosen) throw new Error(t("Choose the .onnx file of your network first."));
    if (chosen.size > facts.max_bytes) throw new Error(t("This file is too large: a network may have at most {size} MB.", { size }));
    show(await ask({ scene: scene.value, part: part.value, file: chosen.name }, chosen));
    return false; // the dialog stays, and tells the verdict
  });
  show(facts);
  await shown;
  clearTimeout(timer);
}

/**
 * Ask the class what was handed in; with a file, hand it in first. Rejects with a sentence.
 * @param {{scene: string, part: string, file: string} | null} [place]
 * @param {File | null} [body]
 * @returns {Promise<HandedIn>}
 */
async function ask(place = null, body = null) {
  let answer;
  try {
    const options = body && { method: "PUT", headers: { "Content-Type": "application/octet-stream" }, body };
    answer = await fetch(place ? `${ADDRESS}?${new URLSearchParams(place)}` : ADDRESS, { cache: "no-store", ...options });
  } catch {
    throw new Error(UNREACHABLE);
  }
  const found = await answer.json().catch(() => ({}));
  if (!answer.ok) throw new Error(found.problem ?? t("The class answered with status {status}.", { status: answer.status }));
  return found;
}

function makeNetwork() {
  return element("li", {}, element("strong"), " ", element("span"));
}

/**
 * @param {HTMLElement} item
 * @param {Network} network
 * @param {Record<string, string>} titles of scenes
 */
function updateNetwork(item, { scene, part, file, verdict, reason }, titles) {
  const words = {
    open: t("{file} is being checked…", { file }),
    right: t("{file} can play ✓", { file }),
    refused: t("{file} was not taken: {reason}", { file, reason }),
  };
  item.dataset.verdict = verdict;
  setText(item.querySelector("strong"), [titles[scene] ?? scene, part].filter(Boolean).join(", "));
  setText(item.querySelector("span"), words[verdict]);
}
