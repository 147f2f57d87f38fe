/** The scene's title, as a button that opens the scene picker. */

import { button, element, setAttributes, setText } from "./dom.js";
import { tile, tiles } from "./panel_parts.js";
import { ask } from "./question.js";

export class ScenePicker {
  #panel;
  #title = element("span", { textContent: "…" });
  element;

  constructor(panel) {
    this.#panel = panel;
    this.element = button("", () => this.open(), { icon: "scenes" });
    this.element.removeAttribute("data-icon-only");
    this.element.classList.add("ai4u-scene-button");
    this.element.append(this.#title);
    setAttributes(this.element, { "aria-haspopup": "dialog" });
    panel.addEventListener("part:scene", ({ detail }) => {
      setText(this.#title, detail.title || "Untitled");
      this.element.disabled = !detail.can_edit;
      setAttributes(this.element, { title: detail.can_edit ? `${detail.title}: choose another scene` : detail.title });
    });
  }

  /** Show all scenes as cards. */
  async open() {
    const window_ = this.#panel.dialog("Choose a scene", element("p", { textContent: "Loading …" }));
    const answer = await this.#panel.send("scenes", {}, { quiet: true });
    if (!answer.ok) {
      window_.body.replaceChildren(element("p", { role: "alert", textContent: answer.text }));
      return;
    }
    const groups = new Map();
    for (const scene of answer.items) {
      const group = scene.is_saved ? "My scenes" : (scene.level ?? "Scenes");
      groups.set(group, [...(groups.get(group) ?? []), scene]);
    }
    const sections = [...groups].map(([title, scenes]) =>
      element(
        "section",
        { ariaLabel: String(title) },
        element("h3", { textContent: title }),
        tiles(...scenes.map((scene) => this.#tile(scene, window_.close))),
      ),
    );
    window_.body.replaceChildren(...sections);
  }

  #tile(scene, close) {
    const { title, goal, minutes, picture } = scene;
    const note = minutes ? `about ${minutes} min` : "";
    return tile({ picture, title, text: goal, note }, async () => {
      close();
      await this.#load(scene);
    });
  }

  async #load({ name, title, is_saved: isSaved = false }) {
    const unsaved = this.#panel.part("world")?.unsaved;
    const text = "This scene has changes that were not saved. They are kept, and the World tab offers them again.";
    if (unsaved && !(await ask({ title: `Open “${title}”?`, text, yes: "Open" }))) return;
    await this.#panel.send("open_scene", { name, is_saved: isSaved });
  }
}
