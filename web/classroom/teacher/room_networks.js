/** The networks that learned in a room, which the teacher can hand out. */

/** @import { ClassState, Room, RoomNetwork } from "../../types/class.js" */

import { element } from "../../shared/dom.js";
import { showForm } from "../../shared/form_dialog.js";
import { t } from "../../shared/text.js";
import { roomName } from "../room_words.js";
import { command } from "./command.js";

const UNREACHABLE = t("The class can't be reached. Is its program still running?");

/**
 * @param {Room} room
 * @param {ClassState} state
 */
export function showNetworks(room, state) {
  const list = element("ul", { className: "ai4u-people" });
  const status = element("p", { role: "status" });
  const text = t("All other rooms on this computer get a copy of a network that you hand out. It names neither the student nor the network.");
  const shown = showForm({ title: t("Networks: {room}", { room: roomName(room, state) }), text, content: [status, list], no: t("Close") });
  networksOf(room.id).then(
    (networks) => {
      list.replaceChildren(...networks.map((network) => row(room, state, network, status)));
      if (networks.length === 0) status.textContent = t("No network has learned here yet.");
    },
    (error) => (status.textContent = error.message),
  );
  return shown;
}

/**
 * @param {string} room
 * @returns {Promise<RoomNetwork[]>}
 */
async function networksOf(room) {
  let answer;
  try {
    answer = await fetch(`./teacher/networks?room=${encodeURIComponent(room)}`, { cache: "no-store" });
  } catch {
    throw new Error(UNREACHABLE);
  }
  const { networks, problem } = await answer.json().catch(() => ({}));
  if (!answer.ok) throw new Error(problem ?? t("The class answered with status {status}.", { status: answer.status }));
  return networks;
}

/**
 * @param {Room} room
 * @param {ClassState} state
 * @param {RoomNetwork} network
 * @param {HTMLElement} status
 */
function row(room, { scenes = [] }, { scene, number, title, how }, status) {
  const sceneTitle = scenes.find(({ name }) => name === scene)?.title ?? scene;
  const label = t("Hand out {network} of {scene}", { network: title, scene: sceneTitle });
  const button = element("button", { type: "button", className: "ai4u-plain", textContent: t("Hand out"), ariaLabel: label });
  button.addEventListener("click", async () => {
    button.disabled = true;
    try {
      await command({ do: "hand out", room: room.id, scene, network: number });
      status.textContent = t("The other rooms get a copy of {network}.", { network: title });
    } catch (error) {
      status.textContent = error.message;
      button.disabled = false;
    }
  });
  return element(
    "li",
    {},
    element("span", { className: "ai4u-name", textContent: title }),
    element("span", { className: "ai4u-facts", textContent: [sceneTitle, how].filter(Boolean).join(" · ") }),
    element("span", { className: "ai4u-actions" }, button),
  );
}
