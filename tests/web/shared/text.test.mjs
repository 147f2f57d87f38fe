import assert from "node:assert/strict";
import { test } from "node:test";

import { setCatalogue, t, tn } from "../../../web/shared/text.js";

const PORTUGUESE = {
  language: "pt_BR",
  messages: {
    "Saved as {name}.": "Salvo como {name}.",
    "{n} drive": { one: "{n} percurso", other: "{n} percursos" },
  },
};

test("a text without a translation is English", () => {
  setCatalogue({ language: "en", messages: {} });
  assert.equal(t("Saved as {name}.", { name: "maze" }), "Saved as maze.");
  assert.equal(tn("{n} drive", "{n} drives", 1), "1 drive");
  assert.equal(tn("{n} drive", "{n} drives", 0), "0 drives");
  assert.equal(tn("{n} drive", "{n} drives", 8192), "8,192 drives");
});

test("texts and plurals are translated", () => {
  setCatalogue(PORTUGUESE);
  assert.equal(t("Saved as {name}.", { name: "labirinto" }), "Salvo como labirinto.");
  assert.deepEqual(
    [0, 1, 2].map((number) => tn("{n} drive", "{n} drives", number)),
    ["0 percurso", "1 percurso", "2 percursos"],
  );
  assert.equal(t("nobody translated this {one}"), "nobody translated this {one}");
});
