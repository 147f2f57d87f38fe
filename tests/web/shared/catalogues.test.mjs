import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";

import { setCatalogue, t, tn } from "../../../web/shared/text.js";

const FOLDER = new URL("../../../ai4u_edu/locale/", import.meta.url);
const LANGUAGES = readdirSync(FOLDER, { withFileTypes: true })
  .filter((entry) => entry.isDirectory() && /^[a-z]{2}(_[A-Z]{2})?$/.test(entry.name))
  .map(({ name }) => name);
const VALUE = /\{(\w+)\}/g;

const messagesOf = (language) => JSON.parse(readFileSync(new URL(`${language}/LC_MESSAGES/page.json`, FOLDER), "utf8"));

/** Return a value for each name in braces in a text. */
const valuesFor = (text) => Object.fromEntries([...text.matchAll(VALUE)].map(([, name], index) => [name, `value${index}`]));

/** Fail if a value is missing in a rendered text, or a name is left in it. */
function check(rendered, text, values) {
  assert.doesNotMatch(rendered, VALUE, `of ${JSON.stringify(text)}`);
  for (const value of Object.values(values)) assert.ok(rendered.includes(value), `${JSON.stringify(text)} without ${value}: ${rendered}`);
}

test("there is a language", () => assert.ok(LANGUAGES.includes("pt_BR")));

for (const language of LANGUAGES) {
  const messages = messagesOf(language);
  for (const catalogue of [{ language: "en", messages: {} }, { language, messages }]) {
    test(`every text of ${language} is rendered with its values in ${catalogue.language}`, () => {
      setCatalogue(catalogue);
      for (const [text, translation] of Object.entries(messages)) {
        const { n, ...values } = valuesFor(text);
        if (typeof translation === "string") check(t(text, n ? { n, ...values } : values), text, n ? { n, ...values } : values);
        else for (const number of [0, 1, 2, 7]) check(tn(text, text, number, values), text, values);
      }
      setCatalogue({ language: "en", messages: {} });
    });
  }
}
