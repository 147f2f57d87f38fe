/** Buttons to save, download and open a scene, and the offer of an unsaved one. */

/**
 * @import { WorldPart } from "../../generated/messages.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, fileButton, setText } from "../../shared/dom.js";
import { sizeProblem } from "../../shared/numbers.js";
import { freeId } from "../../shared/ids.js";
import { t } from "../../shared/text.js";
import { section } from "../widgets/parts.js";
import { copyLink, isThisComputer } from "../../scenes/share.js";

export class SceneFiles {
  #panel;
  #when = element("p");
  #save = button(t("Save"), () => this.#openSaving(), { icon: "save" });
  #unsaved;
  #kept = element("p");
  element = element("div");
  /** Sentences on what is kept after a restart. */
  kept = section("world-kept", t("What is kept after a restart?"), { isOpen: false }, this.#kept);

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#unsaved = element(
      "div",
      { className: "ai4u-offer", role: "status", hidden: true },
      this.#when,
      button(t("Restore"), () => panel.send("restore"), { kind: "main" }),
      button(t("Discard"), () => panel.send("discard"), {}),
    );
    const tools = element(
      "div",
      { className: "ai4u-tools" },
      this.#save,
      button(t("Download"), () => this.#download(), { icon: "download" }),
      button(t("Copy link"), () => this.#copyLink(), {
        icon: "copy",
        title: t("Copy a link that holds this scene"),
      }),
      fileButton(t("Open a file"), ".yaml,.yml,text/yaml", (file) => this.#load(file)),
    );
    this.element.append(this.#unsaved, tools);
  }

  /** @param {WorldPart} part */
  update({ unsaved, can_save: canSave = true, is_autosaved: isAutosaved = false }) {
    setText(this.#kept, keptWords(canSave, isAutosaved));
    this.#save.hidden = !canSave;
    this.#unsaved.hidden = !unsaved;
    if (unsaved) setText(this.#when, t("You have an unsaved scene from {when}.", { when: unsaved.when }));
  }

  #openSaving() {
    const input = element("input", { type: "text", id: freeId(), autocomplete: "off", required: true });
    input.value = this.#panel.part("scene")?.title ?? "";
    const problem = element("p", { className: "ai4u-problem", role: "alert" });
    const save = button(t("Save"), () => {}, { kind: "main", type: "submit" });
    const label = element("label", { htmlFor: input.id, textContent: t("Name") });
    const field = element("div", { className: "ai4u-field" }, label, input);
    const form = element("form", { className: "ai4u-save", method: "dialog" }, field, problem, save);
    const dialog = this.#panel.dialog(t("Save the scene"), form);
    let replaces = "";
    form.addEventListener("submit", async (event) => {
      event.preventDefault();
      const name = input.value.trim();
      const answer = await this.#panel.send("save_scene", { name, over: replaces === name }, { quiet: true });
      if (answer.ok) {
        dialog.close();
        this.#panel.notice(answer.text);
        return;
      }
      const isTaken = answer.code === "exists";
      replaces = isTaken ? name : "";
      setText(save.querySelector("span"), isTaken ? t("Replace it") : t("Save"));
      setText(problem, answer.text);
    });
    input.select();
    input.focus();
  }

  async #copyLink() {
    const text = await copyLink();
    const offer = { text: t("Download the file"), icon: "download", run: () => this.#download() };
    this.#panel.notice(text, "info", isThisComputer() ? offer : null);
  }

  async #download() {
    const answer = await this.#panel.send("download", {});
    if (answer.ok) saveFile(answer.file, answer.content);
  }

  /** @param {File} file */
  async #load(file) {
    const problem = sizeProblem(file, t("a scene file (YAML)"), this.#panel.part("world").max_scene_bytes);
    if (problem) {
      this.#panel.notice(problem, "error");
      return;
    }
    this.#panel.show({ body: null, block: null });
    await this.#panel.sendFile("load_text", file);
  }
}

/**
 * Return what is left of a scene and of a person's work when the world is started again.
 * @param {boolean} canSave
 * @param {boolean} isAutosaved
 */
function keptWords(canSave, isAutosaved) {
  const scenes = [
    canSave ? t("Scenes that you save are under “Choose a scene”, in My scenes.") : t("Nothing can be saved here: download what you want to keep."),
    isAutosaved ? t("Changes that you did not save are offered to you at the top of this tab.") : t("Changes that you did not save are lost."),
    t("Your programs, stars and best times stay in this browser."),
    t("Episodes in Past and the steps of Undo are gone: download the episodes that you want to keep."),
  ];
  return scenes.join(" ");
}

/**
 * @param {string} name
 * @param {string} text
 */
function saveFile(name, text) {
  const url = URL.createObjectURL(new Blob([text], { type: "application/yaml" }));
  element("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
