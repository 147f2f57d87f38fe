/** Opens the scene that follows in the library. */

import { ask, tell } from "../shared/dialog.js";
import { t } from "../shared/text.js";
import { request, unsavedSentence } from "./api.js";

/** Open the next scene of the library, after a question if the present one has unsaved changes. */
export async function openNextScene() {
  try {
    const [{ name: present }, { scenes }] = await Promise.all([request("api/scene"), request("api/scenes")]);
    const index = scenes.findIndex((/** @type {{name: string}} */ scene) => scene.name === present);
    const { name, title } = scenes[(index + 1) % scenes.length];
    const text = await unsavedSentence();
    if (text && !(await ask({ title: t("Open “{title}”?", { title }), text, yes: t("Open") }))) return;
    await request("api/scene", { name });
  } catch (error) {
    await tell(t("The next scene can't be opened"), error.message);
  }
}
