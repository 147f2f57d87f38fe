/** Windows of the panel: galleries, the scene picker, questions. */

import { showDialog } from "../shared/dialog.js";
import { button, element } from "../shared/dom.js";
import { t } from "../shared/text.js";

/**
 * Open a modal window. Closing it gives the focus back to where it was.
 * @param {string} title
 * @param {HTMLElement[]} children
 * @returns {{dialog: HTMLDialogElement, body: HTMLElement, close: () => void}}
 */
export function openDialog(title, ...children) {
  const heading = element("h2", { textContent: title });
  const body = element("div", { className: "ai4u-dialog-body" }, ...children);
  const dialog = element("dialog", { className: "ai4u-dialog" });
  const close = () => dialog.close();
  const cross = button("", close, { icon: "remove", label: t("Close"), kind: "quiet" });
  dialog.append(element("header", {}, heading, cross), body);
  showDialog(dialog, heading, { closesOutside: true });
  return { dialog, body, close };
}
