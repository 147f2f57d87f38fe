/** The dialog with which a teacher gets everybody's attention. */

/** @import { Attention } from "../../types/class.js" */

import { command } from "./command.js";
import { element } from "../../shared/dom.js";
import { choices, chosenIn, field, select, showForm } from "../../shared/form_dialog.js";
import { t } from "../../shared/text.js";

/** Longest message; as MAX_MESSAGE_CHARS of the class link. */
const MAX_MESSAGE_CHARS = 200;
const KINDS = {
  pause: t("Pause all: worlds stand still"),
  blank: t("Blank all: screens show only your message"),
  message: t("Message only: worlds go on"),
};
const TIMES = [
  ["0", t("until I end it")],
  ["30", t("for 30 seconds")],
  ["60", t("for 1 minute")],
  ["120", t("for 2 minutes")],
  ["300", t("for 5 minutes")],
  ["600", t("for 10 minutes")],
];

/** Sentences on what holds now, by its kind. */
export const HELD = { pause: t("All worlds are paused."), blank: t("All screens are blank."), "": t("All see your message.") };
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
  const kind = choices(t("What happens"), "kind", KINDS, "pause");
  const message = element("input", { maxLength: MAX_MESSAGE_CHARS, autocomplete: "off", value: t("Please look at the board.") });
  const time = select(TIMES, "0");
  const content = [kind, field(t("Message"), message), field(t("How long"), time)];
  const text = t("It holds for everybody, including anyone who reloads the page or joins later. Your own page stays as it is.");
  return showForm({ title: t("Attention"), text, content, yes: t("Begin") }, () => {
    const chosen = chosenIn(kind) === "message" ? "" : chosenIn(kind);
    const words = message.value.trim();
    if (!chosen && !words) throw new Error(t("Write a message first."));
    return command({ do: "attention", kind: chosen, message: words, seconds: Number(time.value) });
  });
}
