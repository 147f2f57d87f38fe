/** Results and errors at the lower edge of the panel: a fixed place, so that they move no button. */

import { button, element } from "../shared/dom.js";
import { t } from "../shared/text.js";

/** Time that a result is shown (ms); an error stays until somebody closes it or the next one comes. */
const INFO_MS = 6000;
/** The same for a result with a button (ms). */
const ACTION_MS = 20_000;

/** @typedef {{text: string, icon: string, run: () => void}} NoticeAction what a button beside a result does */

export class Notices {
  // both exist from the start: screen readers announce what is put into a region that they know
  #info = element("div", { className: "ai4u-notice", role: "status" });
  #error = element("div", { className: "ai4u-notice", role: "alert" });
  #timer = 0;
  element = element("div", { className: "ai4u-notices" }, this.#error, this.#info);

  /**
   * @param {string} text
   * @param {string} level "info" or "error"
   * @param {NoticeAction | null} action
   */
  show(text, level = "info", action = null) {
    const isError = level === "error";
    clearTimeout(this.#timer);
    this.#info.replaceChildren();
    if (isError || text) this.#error.replaceChildren();
    if (!text) return;
    const region = isError ? this.#error : this.#info;
    const close = button("", () => region.replaceChildren(), { icon: "remove", label: t("Close"), kind: "quiet" });
    const act = action && button(action.text, action.run, { icon: action.icon });
    region.replaceChildren(element("p", { textContent: text }), ...(act ? [act] : []), close);
    if (!isError) this.#timer = setTimeout(() => region.replaceChildren(), action ? ACTION_MS : INFO_MS);
  }
}
