/** The scene's title, as a button that opens the scene picker. */

/**
 * @import { SceneCard } from "../types/panel.js"
 * @import { Panel } from "./panel.js"
 */
import { syncStars } from "../classroom/student/stars.js";
import { button, element, setAttributes, setText } from "../shared/dom.js";
import { icon } from "../shared/icons.js";
import { freeId } from "../shared/ids.js";
import { tile, tiles } from "./widgets/parts.js";
import { ask } from "../shared/dialog.js";
import { t } from "../shared/text.js";
import { unsavedSentence } from "../scenes/api.js";
import { scenePicture } from "../scenes/picture.js";
import { starRow, starsOf } from "../scenes/stars.js";

/** Headings in their order: the scenes' levels, and those without one. */
const GROUPS = new Map([
  ["mine", t("My scenes")],
  ["easy", t("Easy")],
  ["medium", t("Medium")],
  ["hard", t("Hard")],
  ["others", t("More scenes")],
]);

export class ScenePicker {
  #panel;
  #title = element("span", { textContent: "…" });
  element;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.element = button("", () => this.open(), { kind: "quiet" });
    this.element.classList.add("ai4u-scene-button");
    this.element.append(this.#title, icon("down", 14));
    setAttributes(this.element, { "aria-haspopup": "dialog" });
    panel.addEventListener("part:scene", ({ detail }) => {
      setText(this.#title, detail.title || document.title);
      this.element.disabled = !detail.can_edit;
      setAttributes(this.element, { title: detail.can_edit ? t("{title}: choose another scene", { title: detail.title }) : detail.title });
    });
  }

  /** Show all scenes as cards. */
  async open() {
    const window_ = this.#panel.dialog(t("Choose a scene"), element("p", { textContent: t("Loading …") }));
    const [answer] = await Promise.all([this.#panel.send("scenes", {}, { quiet: true }), syncStars()]);
    if (!answer.ok) {
      window_.body.replaceChildren(element("p", { role: "alert", textContent: answer.text }));
      return;
    }
    const groups = [...GROUPS].map(([group, title]) => ({ title, scenes: answer.items.filter((scene) => groupOf(scene) === group) }));
    const sections = groups.filter(({ scenes }) => scenes.length).map(({ title, scenes }) =>
      element(
        "section",
        { ariaLabel: title },
        element("h3", { textContent: title }),
        tiles(...scenes.map((scene) => this.#tile(scene, window_.close))),
      ),
    );
    window_.body.replaceChildren(...sections);
  }

  /**
   * @param {SceneCard} scene
   * @param {() => void} close closes the window
   */
  #tile(scene, close) {
    const { title, goal, minutes, picture } = scene;
    const note = minutes ? t("about {minutes} min", { minutes }) : "";
    const made = tile({ title, text: goal, note }, async () => {
      close();
      await this.#load(scene);
    });
    if (scene.stars) made.append(starRow(starsOf(scene.name), scene.stars).element);
    for (const child of made.children) child.id = freeId();
    const [name, ...facts] = [...made.children].map(({ id }) => id);
    // so that the name does not begin with the text of the picture
    setAttributes(made, { "aria-labelledby": name, "aria-describedby": facts.join(" ") || null });
    made.prepend(scenePicture(picture, title));
    return made;
  }

  /** @param {SceneCard} scene */
  async #load({ name, title, is_saved: isSaved = false }) {
    const text = await unsavedSentence();
    if (text && !(await ask({ title: t("Open “{title}”?", { title }), text, yes: t("Open") }))) return;
    await this.#panel.send("open_scene", { name, is_saved: isSaved });
  }
}

/** @param {SceneCard} scene */
function groupOf({ level = "", is_saved: isSaved }) {
  const group = level.toLowerCase();
  return isSaved ? "mine" : GROUPS.has(group) ? group : "others";
}
