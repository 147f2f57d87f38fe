/** The drives that an agent can learn from, each with a box to choose it. */

/**
 * @import { TaughtDrive, TeachPart } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { button, element, keyed, setText } from "../shared/dom.js";
import { percent, seconds } from "../shared/numbers.js";
import { t } from "../shared/text.js";

export class Drives {
  #panel;
  #onChoice;
  /** Choices of the person that differ from ours, by the drive's number. */
  #choices = /** @type {Map<number, boolean>} */ (new Map());
  /** @type {TaughtDrive[]} */
  #drives = [];
  element = element("div", { className: "ai4u-teach-drives", role: "group", ariaLabel: t("Drives to learn from") });

  /**
   * @param {Panel} panel
   * @param {() => void} onChoice called when the person has chosen others
   */
  constructor(panel, onChoice) {
    this.#panel = panel;
    this.#onChoice = onChoice;
  }

  /** Numbers of the drives that are chosen. */
  get chosen() {
    return this.#drives.filter((drive) => this.#isChosen(drive)).map(({ number }) => number);
  }

  /** @param {TeachPart} part */
  update({ drives }) {
    this.#drives = drives;
    keyed(
      this.element,
      drives,
      ({ number }) => number,
      (drive) => this.#row(drive),
      (row, drive) => this.#draw(row, drive),
    );
  }

  /** @param {TaughtDrive} drive */
  #row({ number }) {
    const box = element("input", { type: "checkbox" });
    box.addEventListener("change", () => {
      this.#choices.set(number, box.checked);
      this.#onChoice();
    });
    const remove = button("", () => this.#panel.send("teach_forget_drive", { drive: number }), {
      icon: "trash",
      label: t("Delete drive {number}", { number }),
      kind: "quiet",
    });
    const words = element("span", {}, element("strong"), " ", element("span"));
    return element("div", { className: "ai4u-teach-drive" }, element("label", {}, box, words), remove);
  }

  /**
   * @param {HTMLElement} row
   * @param {TaughtDrive} drive
   */
  #draw(row, drive) {
    const box = row.querySelector("input");
    const [title, about] = row.querySelectorAll("label strong, label strong + span");
    box.disabled = Boolean(drive.reason);
    if (box.checked !== this.#isChosen(drive)) box.checked = this.#isChosen(drive);
    row.toggleAttribute("data-off", Boolean(drive.reason));
    setText(title, t("Drive {number}", { number: drive.number }));
    const facts = [outcome(drive), seconds(drive.seconds), drive.share < 1 && t("you drove {share}", { share: percent(drive.share) })];
    setText(about, drive.reason || facts.filter(Boolean).join(", "));
  }

  /** Good drives are chosen, until the person says otherwise. @param {TaughtDrive} drive */
  #isChosen({ number, result, reason }) {
    if (reason) return false;
    return this.#choices.get(number) ?? (result ?? true);
  }
}

/** @param {TaughtDrive} drive */
function outcome({ result }) {
  return result === null ? "" : result ? t("goal reached") : t("not there yet");
}
