/** The dialog for real names, which stay in this browser. */

/** @import { RealNames } from "./real_names.js" */

import { element, setText } from "../../shared/dom.js";
import { field, showForm } from "../../shared/form_dialog.js";
import { t, tn } from "../../shared/text.js";

/** @param {RealNames} realNames */
export function showNames(realNames) {
  const file = element("input", { type: "file", accept: ".csv,.tsv,.txt" });
  const loaded = element("p", { role: "status" });
  const forget = element("button", { type: "button", className: "ai4u-plain", textContent: t("Forget all real names") });
  const update = () => {
    setText(loaded, realNames.count ? tn("{n} real name in this browser.", "{n} real names in this browser.", realNames.count) : t("No real names yet."));
    forget.hidden = realNames.count === 0;
  };
  forget.addEventListener("click", () => {
    realNames.forget();
    update();
  });
  update();
  const hint = t("A line for each student: seat’s name or number, comma, real name. A spreadsheet saves it as CSV.");
  const content = [field(t("Table (CSV)"), file, hint), loaded, forget];
  const text = t("Real names are shown beside the seats on this page only. They stay in this browser and are not sent, neither to students nor to the class’s program.");
  return showForm({ title: t("Real names"), text, content, yes: t("Load"), no: t("Close") }, async () => {
    if (!file.files[0]) throw new Error(t("Choose a file first."));
    realNames.load(await file.files[0].text());
  });
}
