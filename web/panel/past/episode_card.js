/** A finished episode as a card: a click chooses and shows it. */

/**
 * @import { DownloadLink, KeptEpisode } from "../../generated/messages.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, keyed, setAttributes, setText } from "../../shared/dom.js";
import { t, whole } from "../../shared/text.js";
import { Card } from "../widgets/card.js";
import { scenePicture } from "../../scenes/picture.js";
import { fact } from "../widgets/parts.js";

/** Time that "Copied" stands on a button (ms). */
const COPIED_MS = 1500;

/** Ends of an episode in words, before its time. */
const ENDS = {
  goal: (/** @type {string} */ seconds) => t("won in {seconds} s", { seconds }),
  fell: (/** @type {string} */ seconds) => t("fell after {seconds} s", { seconds }),
  time: (/** @type {string} */ seconds) => t("time was up after {seconds} s", { seconds }),
  over: (/** @type {string} */ seconds) => t("stopped after {seconds} s", { seconds }),
};

export class EpisodeCard {
  #panel;
  /** @type {KeptEpisode} */
  #episode = null;
  #card;
  #facts = { driver: fact(t("Driver")), score: fact(t("Score")), steps: fact(t("Steps")), seed: fact(t("Seed")) };
  #copy = button(t("Copy"), () => this.#copySeed(), { icon: "copy", kind: "quiet", label: t("Copy the seed") });
  #downloads = element("div", { className: "ai4u-tools", role: "group", ariaLabel: t("Download") });

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#card = new Card({ onToggle: (isOpen) => void this.#choose(isOpen) });
    const { driver, score, steps, seed } = this.#facts;
    seed.element.append(this.#copy);
    const list = element("dl", { className: "ai4u-episode-facts" }, driver.element, score.element, steps.element, seed.element);
    this.#card.body.append(list, this.#downloads);
  }

  get element() {
    return this.#card.element;
  }

  /**
   * @param {KeptEpisode} episode
   * @param {boolean} isOpen
   * @param {DownloadLink[]} downloads of the chosen episode
   */
  update(episode, isOpen, downloads = []) {
    if (this.#episode === null) this.#card.element.firstElementChild.prepend(scenePicture(episode.picture, episode.scene));
    this.#episode = episode;
    const { number, scene, reward, decisions, seconds, is_pinned: isPinned, is_best: isBest } = episode;
    this.#card.update({
      icon: episode.is_person ? "person" : "network",
      title: t("Episode {number} · {scene}", { number, scene }),
      reads: ENDS[episode.end](seconds.toFixed(1)),
      isOpen,
      mark: isBest ? t("★ best") : "",
    });
    setAttributes(this.#card.element, { "aria-current": isOpen ? "true" : null });
    const label = isPinned ? t("Unpin episode {number}", { number }) : t("Pin episode {number}", { number });
    this.#card.actions([{ icon: "pin", label, onClick: () => panelPin(this.#panel, number, !isPinned) }]);
    setAttributes(this.#card.element, { "data-pinned": Boolean(isPinned) });
    if (!isOpen) return;
    this.#facts.driver.set(episode.driver);
    this.#facts.score.set(shortNumber(reward));
    this.#facts.steps.set(whole(decisions));
    setText(this.#facts.seed.element.querySelector("dd"), String(episode.seed));
    this.#showDownloads(downloads);
  }

  /** @param {boolean} isOpen */
  async #choose(isOpen) {
    const { number } = this.#episode;
    this.#panel.show({ episode: isOpen ? number : null });
    if (!isOpen) return;
    const answer = await this.#panel.send("episode", { number }, { quiet: true });
    if (answer.ok) this.#panel.send("step", { step: 0 }, { quiet: true });
    else this.#panel.notice(answer.text, "error");
  }

  /** @param {DownloadLink[]} downloads */
  #showDownloads(downloads) {
    keyed(
      this.#downloads,
      downloads,
      ({ url }) => url,
      ({ title, url }) => element("a", { className: "ai4u-link", href: url, download: "", textContent: title }),
    );
    this.#downloads.hidden = downloads.length === 0;
  }

  async #copySeed() {
    try {
      await navigator.clipboard.writeText(String(this.#episode.seed));
      setText(this.#copy.querySelector("span"), t("Copied"));
      setTimeout(() => setText(this.#copy.querySelector("span"), t("Copy")), COPIED_MS);
    } catch {
      // not allowed in this frame: the seed can be selected and copied by hand
      getSelection()?.selectAllChildren(this.#facts.seed.element.querySelector("dd"));
    }
  }
}

/**
 * @param {Panel} panel
 * @param {number} number of the episode
 * @param {boolean} on
 */
function panelPin(panel, number, on) {
  panel.send("pin", { number, on }, { quiet: true });
}

/**
 * Return a number with at most two decimals.
 * @param {number} value
 */
function shortNumber(value) {
  return String(Math.round(Number(value ?? 0) * 100) / 100);
}
