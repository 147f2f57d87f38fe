/** Windows of the panel: galleries, the scene picker, questions. */

import { button, element, setAttributes } from "../shared/dom.js";
import { freeId } from "./widgets/parts.js";

/**
 * Open a modal window. Closing it gives the focus back to where it was.
 * @returns {{dialog: HTMLDialogElement, body: HTMLElement, close: () => void}}
 */
export function openDialog(title, ...children) {
  const heading = element("h2", { id: freeId(), textContent: title });
  const body = element("div", { className: "ai4u-dialog-body" }, ...children);
  const dialog = element("dialog", { className: "ai4u-dialog" });
  const close = () => dialog.close();
  const cross = button("", close, { icon: "remove", label: "Close", kind: "quiet" });
  setAttributes(dialog, { "aria-labelledby": heading.id });
  dialog.append(element("header", {}, heading, cross), body);
  dialog.addEventListener("click", (event) => event.target === dialog && close());
  // else viser moves its camera
  dialog.addEventListener("keydown", (event) => event.stopPropagation());
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  return { dialog, body, close };
}
