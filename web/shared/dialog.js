/** Modal dialogs: any, a question, and a problem to read. */

import { element } from "./dom.js";
import { freeId } from "./ids.js";
import { t } from "./text.js";

/**
 * Show a dialog until it is closed. It is named by its heading, and keeps keys from the world behind it.
 * @param {HTMLDialogElement} dialog
 * @param {HTMLElement} heading in the dialog
 * @param {{closesOutside?: boolean}} [options] `closesOutside`: a click beside the dialog closes it
 * @returns {Promise<string>} the dialog's return value
 */
export function showDialog(dialog, heading, { closesOutside = false } = {}) {
  heading.id = freeId();
  dialog.setAttribute("aria-labelledby", heading.id);
  dialog.addEventListener("keydown", (event) => event.stopPropagation()); // else viser moves its camera
  if (closesOutside) dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  document.body.append(dialog);
  dialog.showModal();
  return new Promise((resolve) =>
    dialog.addEventListener("close", () => {
      dialog.remove();
      resolve(dialog.returnValue);
    }),
  );
}

/**
 * Ask a person, and resolve to true for yes; Escape and a click beside the dialog mean no.
 *
 * @param {{title: string, text?: string, yes: string, no?: string, content?: HTMLElement[]}} question
 *   with more elements between text and buttons, if any
 * @returns {Promise<boolean>}
 */
export async function ask({ title, text = "", yes, no = t("Cancel"), content = [] }) {
  const heading = element("h2", { textContent: title });
  const words = element("p", { id: freeId(), textContent: text, hidden: !text });
  const accept = element("button", { type: "button", className: "ai4u-button", textContent: yes });
  const cancel = element("button", { type: "button", className: "ai4u-plain", textContent: no, hidden: !no });
  const buttons = element("div", { className: "ai4u-answers" }, cancel, accept);
  const dialog = element("dialog", { className: "ai4u-question" }, heading, words, ...content, buttons);
  if (text) dialog.setAttribute("aria-describedby", words.id);
  accept.addEventListener("click", () => dialog.close("yes"));
  cancel.addEventListener("click", () => dialog.close());
  const closed = showDialog(dialog, heading, { closesOutside: true });
  accept.focus();
  return (await closed) === "yes";
}

/**
 * Tell a person a problem, which has to be read; resolves when the dialog is closed.
 * @param {string} title
 * @param {string} problem
 */
export async function tell(title, problem) {
  const text = problem.charAt(0).toUpperCase() + problem.slice(1); // the server's sentences begin with any word
  await ask({ title, text, yes: t("Close"), no: "" });
}
