/** The gallery of blocks that can be added, grouped by the question that each answers. */

/**
 * @import { ListBlocks } from "../../generated/messages.js"
 * @import { GalleryBlock } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 */
import { element } from "../../shared/dom.js";
import { t } from "../../shared/text.js";
import { tile, tiles } from "../widgets/parts.js";
import { picture } from "./pictures.js";

/**
 * Open the gallery.
 * @param {Panel} panel
 * @param {object} options
 * @param {string} options.title of the dialog, such as "Add a sensor"
 * @param {ListBlocks["kind"]} options.kind
 * @param {(string | number)[]} [options.parent] path of the list that gets the block; default: the agent's own
 */
export async function openGallery(panel, { title, kind, parent = [kind] }) {
  const content = element("div", { className: "ai4u-gallery" }, element("p", { textContent: t("Loading …") }));
  const dialog = panel.dialog(title, content);
  const answer = await panel.send("gallery", { kind }, { quiet: true });
  if (!answer.ok) {
    content.replaceChildren(element("p", { className: "ai4u-problem", role: "alert", textContent: answer.text }));
    return;
  }
  const add = async (/** @type {string} */ type) => {
    dialog.close();
    const added = await panel.send("add_block", { class: type, parent });
    if (added.ok && added.path) panel.show({ block: added.path });
  };
  content.replaceChildren(...groups(answer.items, add));
  content.querySelector("button")?.focus();
}

/**
 * @param {GalleryBlock[]} items
 * @param {(type: string) => void} add
 */
function groups(items, add) {
  const left = items.filter(({ reason }) => reason);
  const fitting = byQuestion(items.filter(({ reason }) => !reason), add);
  if (!left.length) return fitting;
  const summary = element("summary", { textContent: t("Not for this robot ({n})", { n: left.length }) });
  return [...fitting, element("details", { open: !fitting.length }, summary, ...byQuestion(left, add))];
}

/**
 * @param {GalleryBlock[]} items
 * @param {(type: string) => void} add
 */
function byQuestion(items, add) {
  /** @type {Map<string, GalleryBlock[]>} */
  const groups = new Map();
  for (const item of items) groups.set(item.question, [...(groups.get(item.question) ?? []), item]);
  return [...groups].flatMap(([question, group]) => [
    element("h3", { textContent: question }),
    tiles(...group.map((item) => blockTile(item, () => add(item.class)))),
  ]);
}

/**
 * @param {GalleryBlock} item
 * @param {() => void} onClick
 */
function blockTile(item, onClick) {
  const made = tile({ title: item.title, text: item.summary, reason: item.reason }, onClick);
  made.prepend(picture(item.picture));
  made.append(element("code", { className: "ai4u-details-only", textContent: item.class }));
  return made;
}
