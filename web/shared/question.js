/** A question in a modal dialog, which keeps keys from the world behind it. */

import { element } from "./dom.js";

let count = 0;

/**
 * Ask a person, and resolve to true for yes; Escape and a click beside the dialog mean no.
 *
 * @param {{title: string, text?: string, yes: string, no?: string, content?: HTMLElement[]}} question
 *   with more elements between text and buttons, if any
 * @returns {Promise<boolean>}
 */
export function ask({ title, text = "", yes, no = "Cancel", content = [] }) {
  count += 1;
  const heading = element("h2", { id: `ai4u-question-${count}`, textContent: title });
  const words = element("p", { id: `ai4u-question-text-${count}`, textContent: text, hidden: !text });
  const accept = element("button", { type: "button", className: "ai4u-button", textContent: yes });
  const cancel = element("button", { type: "button", className: "ai4u-plain", textContent: no, hidden: !no });
  const buttons = element("div", { className: "ai4u-answers" }, cancel, accept);
  const dialog = element("dialog", { className: "ai4u-question" }, heading, words, ...content, buttons);
  dialog.setAttribute("aria-labelledby", heading.id);
  if (text) dialog.setAttribute("aria-describedby", words.id);
  accept.addEventListener("click", () => dialog.close("yes"));
  cancel.addEventListener("click", () => dialog.close());
  dialog.addEventListener("keydown", (event) => event.stopPropagation()); // else viser moves its camera
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  document.body.append(dialog);
  dialog.showModal();
  accept.focus();
  return new Promise((resolve) =>
    dialog.addEventListener("close", () => {
      dialog.remove();
      resolve(dialog.returnValue === "yes");
    }),
  );
}

/** Tell a person a problem, which has to be read; resolves when the dialog is closed. */
export async function tell(title, problem) {
  const text = problem.charAt(0).toUpperCase() + problem.slice(1); // the server's sentences begin with any word
  await ask({ title, text, yes: "Close", no: "" });
}
