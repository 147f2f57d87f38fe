/** The tab "Past": finished episodes, and the player of the chosen one. */

/**
 * @import { KeptEpisode, PastPart } from "../../generated/messages.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, fileButton, keyed, unlessPressed } from "../../shared/dom.js";
import { sizeProblem } from "../../shared/numbers.js";
import { t } from "../../shared/text.js";
import { Comparison } from "./compare.js";
import { EpisodeCard } from "./episode_card.js";
import { PaidTerms } from "./paid.js";
import { section } from "../widgets/parts.js";
import { Player } from "./player.js";

/** Number that stands for the episode that is still running. */
const RUNNING_EPISODE = 0;

export class PastTab {
  #root;
  #panel;
  #player;
  #comparison;
  #paid;
  /**
   * Cards by the number of their episode.
   * @type {Map<number, EpisodeCard>}
   */
  #cards = new Map();
  #groups;
  /** True until the running episode's frames are there, which are shown then. */
  #wantsRunning = false;
  #none = element("p", { className: "ai4u-hint-text", textContent: t("Finished episodes appear here.") });

  /**
   * @param {HTMLElement} root
   * @param {Panel} panel
   */
  constructor(root, panel) {
    this.#root = root;
    this.#panel = panel;
    this.#player = new Player(panel);
    this.#comparison = new Comparison(panel);
    this.#paid = new PaidTerms(panel);
    const current = button(t("Current episode"), () => this.#showRunning(), { icon: "clock" });
    const open = fileButton(t("Open a recording"), ".episode", (file) => this.#open(file));
    this.#groups = [
      group("past-pinned", t("Pinned"), (episode) => episode.is_pinned),
      group("past-person", t("Your drives"), (episode) => isRecordedHere(episode) && episode.is_person),
      group("past-program", t("Networks and programs"), (episode) => isRecordedHere(episode) && !episode.is_person),
      group("past-files", t("Opened recordings"), (episode) => !episode.is_pinned && Boolean(episode.source)),
      group("past-others", t("In other scenes"), isOfOtherScene, { isOpen: false }),
    ];
    const tools = element("div", { className: "ai4u-tools" }, current, open);
    root.append(this.#player.element, this.#paid.element, this.#comparison.element, tools, this.#none, ...this.#groups.map(({ element: details }) => details));
  }

  /** @param {PastPart} part */
  update(part) {
    this.#player.update(part);
    this.#paid.update(part.playing?.number ?? null);
    this.#comparison.update(part.playing?.is_here ? part.playing.number : null);
    if (this.#wantsRunning && part.playing?.number === RUNNING_EPISODE) {
      this.#wantsRunning = false;
      this.#panel.send("step", { step: part.playing.step }, { quiet: true });
    }
    unlessPressed(this.#root, () => this.#updateCards(part));
  }

  /** @param {PastPart} part */
  #updateCards(part) {
    const episodes = [...(part.episodes ?? [])].sort((a, b) => b.number - a.number);
    const numbers = new Set(episodes.map(({ number }) => number));
    for (const number of [...this.#cards.keys()]) if (!numbers.has(number)) this.#cards.delete(number);
    this.#none.hidden = episodes.length > 0;
    for (const { element: details, list, isIn } of this.#groups) {
      const inside = episodes.filter(isIn);
      details.hidden = inside.length === 0;
      keyed(
        list,
        inside,
        ({ number }) => number,
        ({ number }) => this.#card(number).element,
        (_, episode) => this.#update(episode, part),
      );
    }
  }

  /** @param {number} number of the episode */
  #card(number) {
    if (!this.#cards.has(number)) this.#cards.set(number, new EpisodeCard(this.#panel));
    return this.#cards.get(number);
  }

  /**
   * @param {KeptEpisode} episode
   * @param {PastPart} part
   */
  #update(episode, part) {
    const chosen = this.#panel.shown.episode ?? part.playing?.number ?? null;
    this.#card(episode.number).update(episode, chosen === episode.number, part.downloads);
  }

  #showRunning() {
    this.#panel.show({ episode: null });
    this.#wantsRunning = true;
    this.#panel.send("episode", { number: RUNNING_EPISODE }, { quiet: true });
  }

  /** @param {File} file */
  async #open(file) {
    const problem = sizeProblem(file, t("a recording (.episode)"), this.#panel.part("past").max_recording_bytes);
    if (problem) {
      this.#panel.notice(problem, "error");
      return;
    }
    const answer = await this.#panel.sendFile("open_recording", file);
    if (answer.ok && answer.number) this.#panel.show({ episode: answer.number });
  }
}

/**
 * @param {string} key under which it is remembered whether it is open
 * @param {string} title
 * @param {(episode: KeptEpisode) => boolean} isIn
 * @param {{isOpen?: boolean}} options
 */
function group(key, title, isIn, options = {}) {
  const list = element("div", { className: "ai4u-card-list" });
  return { element: section(key, title, options, list), list, isIn };
}

/** @param {KeptEpisode} episode */
function isRecordedHere({ is_pinned: isPinned, is_here: isHere, source }) {
  return !isPinned && isHere && !source;
}

/** @param {KeptEpisode} episode */
function isOfOtherScene({ is_pinned: isPinned, is_here: isHere, source }) {
  return !isPinned && !isHere && !source;
}
