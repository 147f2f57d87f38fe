"""A Python and a world for the tab "Code" that answer at once, in the page itself."""

import re

from playwright.sync_api import Page, Route

FAKE = """
const fake = (window.fake ??= {
  calls: [], percepts: [], closed: 0, waits: 0, load: { ok: true }, connectError: null, warm: null,
  connecting: null, refuses: false,
  decide: (percept, number, stops) => ({
    ok: true, values: { move: [1, 0] }, printed: `decision ${number}\\n`, lines: [2, 3],
    variables: { near: "0.94" },
  }),
  give(percept) { (this.taker ?? ((each) => this.percepts.push(each)))(percept); },
});
"""
ENGINE = (
    FAKE
    + """
export class CodeEngine {
  async warm() { await fake.warm; }
  async load(source, facts) { fake.calls.push(["load", source, facts]); return fake.load; }
  async begin() { fake.calls.push(["begin"]); return { ok: true }; }
  async decide(percept, number, stops) {
    fake.calls.push(["decide", percept, number]);
    return fake.decide(percept, number, stops);
  }
  finish() { fake.finished = (fake.finished ?? 0) + 1; }
  end() {}
}
"""
)
CLIENT = (
    FAKE
    + """
export class RemoteClient {
  static async connect(options) {
    fake.calls.push(["connect", options]);
    await fake.connecting;
    if (fake.connectError) throw new Error(fake.connectError);
    const isRefused = fake.refuses && options.mode === "lockstep";
    if (isRefused) throw Object.assign(new Error("refused"), { code: "lockstep_refused" });
    return new RemoteClient();
  }
  welcome = {
    success: "touch", ticksPerSecond: 60, maxSteps: 100,
    readings: [{ key: "box", dtype: "<f4" }, { key: "rays", dtype: "<f4" }],
    outputs: [{ name: "move", low: [-1, -1], high: [1, 1] }],
  };
  sense() {
    if (fake.percepts.length) return Promise.resolve(fake.percepts.shift());
    return new Promise((taker) => (fake.taker = taker)).finally(() => (fake.taker = null));
  }
  async act(values) { fake.calls.push(["act", values]); }
  async reset(...seed) { fake.calls.push(["reset", ...seed]); }
  async wait() { fake.waits += 1; }
  close() { fake.closed += 1; }
}
"""
)


MODULES = {"code/engine.js": ENGINE, "remote/client.js": CLIENT}
"""Texts in place of the modules that run Python and connect to the world."""


def serve_fakes(page: Page) -> None:
    """Replace these modules in a page of a room."""
    for name, text in MODULES.items():
        _replace(page, name, text)


def _replace(page: Page, name: str, text: str) -> None:
    def answer(route: Route) -> None:
        route.fulfill(body=text, content_type="text/javascript")

    page.route(re.compile(rf"/web-\w+/{re.escape(name)}"), answer)
