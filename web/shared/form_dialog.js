/** A modal dialog with a form, which stays open and says why if what it asks for can't be done. */

import { showDialog } from "./dialog.js";
import { element } from "./dom.js";
import { t } from "./text.js";

/**
 * Show a form until it is sent or closed.
 *
 * @param {{title: string, text?: string, content: (Node | string | false)[], yes?: string, no?: string, isDanger?: boolean}} form
 *   without `yes`, it has only a button that closes it
 * @param {() => unknown} send called when the form is sent; its error's message is shown, and after false
 *   the form stays
 * @returns {Promise<boolean>} true if it was sent
 */
export async function showForm({ title, text = "", content, yes = "", no = t("Cancel"), isDanger = false }, send = async () => {}) {
  const heading = element("h2", { textContent: title });
  const problem = element("p", { className: "ai4u-problem", role: "alert" });
  const accept = yes ? element("button", { className: "ai4u-button", textContent: yes }) : null;
  if (accept && isDanger) accept.dataset.kind = "danger";
  const cancel = element("button", { type: "button", className: "ai4u-plain", textContent: no });
  const form = element(
    "form",
    { method: "dialog" },
    heading,
    text && element("p", { textContent: text }),
    ...content,
    problem,
    element("div", { className: "ai4u-answers" }, cancel, accept),
  );
  const dialog = element("dialog", { className: "ai4u-question ai4u-form" }, form);
  cancel.addEventListener("click", () => dialog.close());
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    if (accept === null) return;
    accept.disabled = true;
    problem.textContent = "";
    try {
      if ((await send()) !== false) dialog.close("sent");
    } catch (error) {
      problem.textContent = error.message;
    }
    accept.disabled = false;
  });
  const closed = showDialog(dialog, heading);
  dialog.scrollTop = 0;
  return (await closed) === "sent";
}

/**
 * Close the dialog that an element is in.
 * @param {Element} target
 */
export function closeDialogOf(target) {
  target.closest("dialog")?.close();
}

/**
 * Return a control with its label above it.
 * @param {string} label
 * @param {HTMLElement} control
 */
export function field(label, control, hint = "") {
  const words = element("span", { className: "ai4u-label", textContent: label });
  return element("label", { className: "ai4u-field" }, words, control, hint && element("small", { textContent: hint }));
}

/**
 * Return a checkbox or radio button with its label beside it.
 * @param {string} label
 * @param {HTMLInputElement} input
 * @param {(Node | string | false)[]} rest more children
 */
export function choice(label, input, ...rest) {
  return element("label", { className: "ai4u-choice" }, input, element("span", { textContent: label }), ...rest);
}

/**
 * Return a group of radio buttons.
 * @param {string} legend
 * @param {string} name
 * @param {Record<string, string>} options labels by value
 * @param {string} chosen its value
 */
export function choices(legend, name, options, chosen) {
  const inputs = Object.entries(options).map(([value, label]) =>
    choice(label, element("input", { type: "radio", name, value, checked: value === chosen })),
  );
  return element("fieldset", {}, element("legend", { textContent: legend }), ...inputs);
}

/**
 * Return a list to choose from.
 * @param {string[][]} options pairs of value and label
 * @param {string} [chosen] its value
 */
export function select(options, chosen) {
  const items = options.map(([value, label]) => element("option", { value, textContent: label, selected: value === chosen }));
  return element("select", {}, ...items);
}

/**
 * Return the value of the chosen radio button in a group.
 * @param {Element} group
 */
export function chosenIn(group) {
  return /** @type {HTMLInputElement | null} */ (group.querySelector("input:checked"))?.value ?? "";
}
