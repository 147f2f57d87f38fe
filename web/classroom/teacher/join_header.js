/** The head of the teacher's page: how to join, small while a class runs, large while it gathers. */

/** @import { ClassState, Seat } from "../../types/class.js" */
/** @import { RealNames } from "./real_names.js" */

import { commandOrTell } from "./command.js";
import { element, find, keyed, setAttributes, setText } from "../../shared/dom.js";
import { showForget } from "./forget_dialog.js";
import { showMoveCode } from "./move_code_dialog.js";
import { ask } from "../../shared/dialog.js";
import { t } from "../../shared/text.js";

/**
 * Words by a seat's state; "in" needs none.
 * @type {Record<string, string>}
 */
const STATES = { left: t("left"), kicked: t("sent out; may join again"), banned: t("may not come back") };

export class JoinHeader {
  #isOpen = true;
  /**
   * True or false once the teacher has chosen a size; until then it is large while nobody is here.
   * @type {boolean | null}
   */
  #isLarge = null;
  #hasPeople = false;
  #realNames;

  /** @param {RealNames} realNames */
  constructor(realNames) {
    this.#realNames = realNames;
    find("#new-code").addEventListener("click", async () => {
      const text = t("Students who are here stay. Whoever comes later needs the new code.");
      if (await ask({ title: t("A new code?"), text, yes: t("New code") })) await commandOrTell({ do: "new code" });
    });
    find("#open").addEventListener("click", () => commandOrTell({ do: this.#isOpen ? "close" : "open" }));
    find("#large").addEventListener("click", () => {
      this.#isLarge = !this.#isShownLarge;
      this.#resize();
    });
  }

  /** @param {ClassState} state */
  show(state) {
    const here = state.seats.filter((seat) => seat.state === "in");
    this.#isOpen = state.open;
    this.#hasPeople = here.length > 0;
    setText(find("#address"), state.address);
    setText(find("#code"), state.code);
    // at a JupyterHub students sign in, and need no code
    find("#code").parentElement.hidden = find("#new-code").hidden = !state.code;
    setAttributes(find("#qr"), { src: state.qr });
    find("#qr").hidden = false;
    find("#open").setAttribute("aria-pressed", String(!state.open));
    setText(find("#count"), here.length ? `(${here.length})` : "");
    showGone(state.seats.filter((seat) => seat.state !== "in"), Boolean(state.code), this.#realNames);
    this.#resize();
  }

  get #isShownLarge() {
    return this.#isLarge ?? !this.#hasPeople;
  }

  #resize() {
    const header = find("#join-view");
    find("#large").setAttribute("aria-pressed", String(this.#isShownLarge));
    header.toggleAttribute("data-large", this.#isShownLarge);
  }
}

/**
 * Show who was here, with a way back where seats have codes.
 * @param {Seat[]} seats
 * @param {boolean} hasCodes
 * @param {RealNames} realNames
 */
function showGone(seats, hasCodes, realNames) {
  const gone = find("#gone");
  gone.hidden = seats.length === 0;
  setText(gone.querySelector("summary"), t("No longer here ({count})", { count: seats.length }));
  const make = (/** @type {Seat} */ seat) => {
    const code = element("button", { type: "button", className: "ai4u-plain", textContent: t("Code…"), hidden: !hasCodes });
    code.setAttribute("aria-label", t("Code for {name}", { name: seat.name }));
    code.addEventListener("click", () => showMoveCode(seat));
    const forget = element("button", { type: "button", className: "ai4u-plain", textContent: t("Forget…") });
    forget.setAttribute("aria-label", t("Forget {name}", { name: seat.name }));
    forget.addEventListener("click", () => showForget(seat, realNames));
    return element("li", {}, element("span", { className: "ai4u-name" }), " ", element("span", { className: "ai4u-facts" }), " ", code, " ", forget);
  };
  keyed(gone.querySelector("ul"), seats, (seat) => seat.number, make, (item, seat) => {
    setText(item.firstElementChild, seat.name);
    setText(item.querySelector(".ai4u-facts"), STATES[seat.state] ?? seat.state);
  });
}
