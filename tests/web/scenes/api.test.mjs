import assert from "node:assert/strict";
import { test } from "node:test";

import { request, unsavedSentence } from "../../../web/scenes/api.js";
import { answerWith } from "../browser.mjs";

test("a request with a body is a post of JSON, one without is a get", async () => {
  const asked = answerWith({ body: { ok: 1 } });
  assert.deepEqual(await request("api/scene", { name: "sumo" }), { ok: 1 });
  await request("api/scene");
  assert.equal(asked[0].method, "POST");
  assert.equal(asked[0].body, '{"name":"sumo"}');
  assert.equal(asked[1].method, undefined);
});

test("each failure has a sentence", async () => {
  answerWith(new TypeError("offline"));
  await assert.rejects(request("api/scene"), /can't be reached/);
  answerWith({ status: 404, body: "Not Found" });
  await assert.rejects(request("api/scene"), /can't be changed/);
  answerWith({ status: 400, body: " The scene has no floor.\n" });
  await assert.rejects(request("api/scene"), { message: "The scene has no floor." });
});

test("the sentence about changes says where they are", async () => {
  const sentence = (is_changed, is_autosaved) => {
    answerWith({ body: { is_changed, is_autosaved } });
    return unsavedSentence();
  };
  assert.equal(await sentence(false, true), "");
  assert.match(await sentence(true, true), /under Unsaved/);
  assert.match(await sentence(true, false), /Undo/);
});
