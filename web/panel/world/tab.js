/** The tab "World": the things in it, the scene's settings and files. */

/**
 * @import { WorldPart } from "../../generated/messages.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, fileButton, keyed, setText } from "../../shared/dom.js";
import { sizeProblem } from "../../shared/numbers.js";
import { BodyCard } from "./body_card.js";
import { chooseAdded, chooseMore, setMoveMode } from "./selection.js";
import { Form } from "../widgets/form.js";
import { section, toggle } from "../widgets/parts.js";
import { remember } from "../../shared/storage.js";
import { t } from "../../shared/text.js";
import { MOVES_KEY, SNAP_KEY, SNAP_M } from "./palette.js";
import { SceneFiles } from "./scene_files.js";

const HINT_OFF = t("Turn on Move things, then drag anything in the picture.");
const HINT_ON =
  t("Drag things to move them (Esc cancels). Click one to turn it or change its size. Shift and a click, or a frame, take several.");

export class WorldTab {
  #panel;
  /**
   * Cards by the name of their thing.
   * @type {Map<string, BodyCard>}
   */
  #cards = new Map();
  #list = element("div", { className: "ai4u-card-list" });
  #moves;
  #snaps;
  #hint = element("p", { className: "ai4u-hint-text" });
  #settings;
  #field;
  #newField;
  #files;
  #lays = fileButton(t("Lay a picture on the ground"), "image/png,image/jpeg", (file) => this.#lay(file));

  /**
   * @param {HTMLElement} root
   * @param {Panel} panel
   */
  constructor(root, panel) {
    this.#panel = panel;
    this.#files = new SceneFiles(panel);
    this.#moves = toggle(t("Move things"), (isOn) => this.#setMoving(isOn));
    this.#snaps = toggle(t("Snap to grid"), (isOn) => this.#setSnap(isOn ? SNAP_M : 0), {
      title: t("Hold Alt to move freely"),
    });
    this.#settings = new Form({ onChange: (values) => panel.send("change_settings", { values }) });
    this.#field = new Form({ onChange: (values) => panel.send("change_field", { values }) });
    this.#newField = button(t("New field"), () => panel.send("new_start"), {
      title: t("Begin again with another field of this kind"),
    });
    root.append(
      this.#files.element,
      section(
        "world-things",
        t("Things"),
        {},
        element("div", { className: "ai4u-row-of-two" }, this.#moves.element, this.#snaps.element),
        this.#hint, // below the buttons, which its other texts would move
        element("div", { className: "ai4u-tools" }, this.#lays),
        this.#list,
      ),
      section(
        "world-field",
        t("Field by chance"),
        { isOpen: false },
        element("div", { className: "ai4u-tools" }, this.#newField),
        this.#field.element,
      ),
      section("world-settings", t("Scene settings"), { isOpen: false }, this.#settings.element),
      this.#files.kept,
    );
    this.#list.addEventListener("click", (event) => this.#chooseMore(event), { capture: true });
    panel.addEventListener("shown", () => this.#updateShown());
    panel.addEventListener("selected", ({ detail }) => this.#showSelected(detail.body));
  }

  /** @param {WorldPart} part */
  update(part) {
    this.#moves.set(part.is_move_mode);
    this.#snaps.set(part.snap > 0);
    setText(this.#hint, part.is_move_mode ? HINT_ON : HINT_OFF);
    this.#files.update(part);
    const bodies = part.bodies ?? [];
    const names = new Set(bodies.map(({ name }) => name));
    for (const name of [...this.#cards.keys()]) if (!names.has(name)) this.#cards.delete(name);
    keyed(
      this.#list,
      bodies,
      ({ name }) => name,
      ({ name }) => {
        this.#cards.set(name, new BodyCard(this.#panel));
        return this.#cards.get(name).element;
      },
      (_, body) => this.#cards.get(body.name).update(body, part.form),
    );
    this.#settings.update(part.settings ?? []);
    const field = part.field ?? [];
    this.#field.update(field);
    this.#newField.hidden = field.length < 2; // only the kind, which is none
  }

  /**
   * Select a thing besides the others, with Shift.
   * @param {MouseEvent} event
   */
  #chooseMore(event) {
    if (!event.shiftKey || !(event.target instanceof Element)) return;
    const card = event.target.closest(".ai4u-card-head")?.closest(".ai4u-card");
    const name = [...this.#cards].find(([, { element: made }]) => made === card)?.[0];
    if (name === undefined) return;
    event.stopPropagation();
    chooseMore(this.#panel, [name], { isToggle: true });
  }

  /**
   * Send a picture of a mat, and select it.
   * @param {File} file
   */
  async #lay(file) {
    const problem = sizeProblem(file, t("a picture"), this.#panel.part("world").max_picture_bytes, t("save it with fewer pixels, or a photo as JPEG"));
    if (problem) {
      this.#panel.notice(problem, "error");
      return;
    }
    const answer = await this.#panel.sendFile("lay_picture", file);
    if (answer.ok) chooseAdded(this.#panel, answer);
  }

  #updateShown() {
    const part = this.#panel.part("world"); // the form comes later
    if (part) this.update(part);
  }

  /** @param {boolean} on */
  #setMoving(on) {
    remember(MOVES_KEY, on);
    setMoveMode(this.#panel, on);
  }

  /** @param {number} distance (m); 0 for no grid */
  #setSnap(distance) {
    remember(SNAP_KEY, distance);
    this.#panel.send("snap", { distance }, { quiet: true });
  }

  /** @param {string} name */
  #showSelected(name) {
    this.#cards.get(name)?.element.scrollIntoView({ block: "nearest" });
  }
}
