/**
 * The picture's resolution. viser's adapts itself to three quarters at least, which is too slow without a
 * graphics chip, and too late. So the page measures how often it draws while somebody drives, and page_id.js
 * begins the next page with the resolution that suits this browser.
 */
import { forget, recall, remember } from "../shared/storage.js";

/** Its key in the storage, which page_id.js reads, too. */
const KEY = "resolution";
/** Pictures a second below which the next page has fewer pixels. */
const SLOW = 25;
/** Pictures a second that it should have then. */
const GOAL = 30;
/** Pictures a second above which the next page has more pixels. */
const FAST = 45;
/** Least resolution, as a share of the screen's: at a lower one, lines of the grid vanish without smooth edges. */
const MIN_SHARE = 0.65;
/** Factor by which it grows. */
const STEP_UP = 1.15;
/** Time of driving (ms) that is measured. */
const MEASURED_MS = 4000;
/** Longest time (ms) between two pictures that counts: after a longer one the page was hidden. */
const MAX_GAP_MS = 1000;

/**
 * Return the resolution for the next page, in pixels of the picture for each of the page's; null for viser's own.
 * @param {number} rate pictures a second that were drawn
 * @param {number} used resolution with which they were drawn
 * @param {number} screen the screen's resolution
 */
export function nextResolution(rate, used, screen) {
  let next = used;
  if (rate < SLOW) next = used * Math.sqrt(rate / GOAL); // time goes with the number of pixels
  else if (rate > FAST) next = used * STEP_UP;
  next = Math.round(20 * Math.max(next, MIN_SHARE * screen)) / 20;
  return next >= screen ? null : next;
}

/** Measures how often the page draws while somebody drives. */
export class PictureRate {
  #drawn = 0;
  #time = 0;
  #last = 0;
  #isDriving = false;
  #isRunning = false;

  /**
   * Note whether somebody drives in this page.
   * @param {boolean} isDriving
   */
  follow(isDriving) {
    this.#isDriving = isDriving;
    if (!isDriving || this.#isRunning) return;
    this.#isRunning = true;
    this.#last = 0;
    requestAnimationFrame(this.#draw);
  }

  #draw = (/** @type {number} */ now) => {
    this.#isRunning = this.#isDriving;
    const gap = this.#last && now - this.#last;
    this.#last = now;
    if (gap > 0 && gap < MAX_GAP_MS) {
      this.#drawn += 1;
      this.#time += gap;
    }
    if (this.#time >= MEASURED_MS) this.#keep();
    if (this.#isRunning) requestAnimationFrame(this.#draw);
  };

  #keep() {
    const canvas = document.querySelector("canvas[data-engine]") ?? document.querySelector("canvas");
    const rate = (1000 * this.#drawn) / this.#time;
    this.#drawn = this.#time = 0;
    if (!(canvas instanceof HTMLCanvasElement) || !canvas.clientWidth) return;
    const next = nextResolution(rate, canvas.width / canvas.clientWidth, devicePixelRatio);
    if (next === null) forget(KEY);
    else if (next !== recall(KEY, null)) remember(KEY, next);
  }
}
