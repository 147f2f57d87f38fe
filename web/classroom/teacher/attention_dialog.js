/** The dialog with which a teacher gets everybody's attention. */

/** @import { Attention } from "../../types/class.js" */

import { command } from "./command.js";
import { element } from "../../shared/dom.js";
import { choices, chosenIn, field, select, showForm } from "../../shared/form_dialog.js";

/** Longest message; as MAX_MESSAGE_CHARS of the class link. */
const MAX_MESSAGE_CHARS = 200;
const KINDS = {
  pause: "Pause all: worlds stand still",
  blank: "Blank all: screens show only your message",
  message: "Message only: worlds go on",
};
const TIMES = [
  ["0", "until I end it"],
  ["30", "for 30 seconds"],
  ["60", "for 1 minute"],
  ["120", "for 2 minutes"],
  ["300", "for 5 minutes"],
  ["600", "for 10 minutes"],
];

/** Words for what holds now, by its kind. */
export const HELD = { pause: "All worlds are paused", blank: "All screens are blank", "": "All see your message" };
/** The command that ends it. */
export const END_ATTENTION = { do: "attention", kind: "", message: "", seconds: 0 };

/**
 * Return true while worlds are paused, screens are blank, or a message is shown.
 * @param {Attention} attention
 */
export function isHeld({ kind, message }) {
  return Boolean(kind || message);
}

export function showAttention() {
  const kind = choices("What happens", "kind", KINDS, "pause");
  const message = element("input", { maxLength: MAX_MESSAGE_CHARS, autocomplete: "off", value: "Please look at the board." });
  const time = select(TIMES, "0");
  const content = [kind, field("Message", message), field("How long", time)];
  const text = "It holds for everybody, including anyone who reloads the page or joins later. Your own page stays as it is.";
  return showForm({ title: "Attention", text, content, yes: "Begin" }, () => {
    const chosen = chosenIn(kind) === "message" ? "" : chosenIn(kind);
    const words = message.value.trim();
    if (!chosen && !words) throw new Error("Write a message first.");
    return command({ do: "attention", kind: chosen, message: words, seconds: Number(time.value) });
  });
}
