/** The end of a class: export first, then forget everything. */

/** @import { ClassState } from "../../types/class.js" */

import { command } from "./command.js";
import { element } from "../../shared/dom.js";
import { choice, field, showForm } from "../../shared/form_dialog.js";
import { t } from "../../shared/text.js";

/**
 * @param {ClassState} state
 * @param {() => void} onForgotten called when everything was deleted
 */
export async function showEnd(state, onForgotten) {
  const download = element("a", { href: "./teacher/export", className: "ai4u-plain", textContent: t("Export everything"), download: "" });
  const without = element("input", { type: "checkbox" });
  const code = element("input", { autocomplete: "off", spellcheck: false, maxLength: 12, className: "ai4u-code-input" });
  download.addEventListener("click", () => (without.checked = true));
  const content = [
    element("h3", { textContent: t("1. Keep what you need") }),
    element("p", { textContent: t("One file with all scenes, recorded drives, networks, tournaments and the table of progress. Students can take their own work home from their pages.") }),
    element("p", {}, download),
    choice(t("I have the file, or need none"), without),
    element("h3", { textContent: t("2. Forget everything") }),
    element("p", {
      textContent:
        t("Deletes all seats, scenes, networks, drives and results from this computer, and the real names from this browser. All rooms end. This can’t be undone."),
    }),
    field(t("Type the code {code} to confirm", { code: state.code }), code),
  ];
  const form = { title: t("End class"), content, yes: t("Forget everything"), isDanger: true };
  const isForgotten = await showForm(form, async () => {
    if (!without.checked) throw new Error(t("Export first, or tick that you need no file."));
    if (code.value.replace(/[\s-]/g, "").toUpperCase() !== state.code) throw new Error(t("To confirm, type the code of this class: {code}.", { code: state.code }));
    await command({ do: "forget" });
  });
  if (isForgotten) onForgotten();
}
