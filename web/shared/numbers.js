/** Numbers as text for people. */

import { t } from "./text.js";

/**
 * Return a number with at most three digits that matter; "–" if there is none.
 * @param {number | string | null | undefined} value
 */
export function number(value) {
  if (value === null || value === undefined) return "–";
  const amount = Number(value);
  if (!Number.isFinite(amount)) return String(value);
  const size = Math.abs(amount);
  const digits = size >= 100 ? 0 : size >= 10 ? 1 : 2;
  const text = size.toFixed(digits);
  return (amount < 0 && Number(text) !== 0 ? "−" : "") + text;
}

/**
 * Return a duration (s) as "12.3 s" or "2:05 min"; "–" if there is none.
 * @param {number | null | undefined} value
 */
export function seconds(value) {
  if (value === null || value === undefined) return "–";
  return value < 60 ? t("{seconds} s", { seconds: value.toFixed(1) }) : t("{minutes} min", { minutes: clock(Math.floor(value)) });
}

/**
 * Return a share as "35%". A half goes to the even number, as in Python's sentences: the page shows both.
 * @param {number} share 0 to 1
 */
export function percent(share) {
  const value = 100 * share;
  const nearest = Math.round(value);
  return `${nearest - value === 0.5 && nearest % 2 ? nearest - 1 : nearest}%`;
}

/**
 * Return the time (s) that is left, or has passed, as a clock shows it: "1:05". It rounds up, and never runs below zero.
 * @param {number} seconds
 */
export function clock(seconds) {
  const whole = Math.max(0, Math.ceil(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

/**
 * Return the sentence about a file that is too large; empty for one that is not.
 * @param {File} file
 * @param {string} what it is expected to be
 * @param {number} maxBytes
 * @param {string} [help] what to do about it
 */
export function sizeProblem(file, what, maxBytes, help = "") {
  if (file.size <= maxBytes) return "";
  const [most, size] = [maxBytes, file.size].map((bytes) => bytes / 2 ** 20);
  return `${file.name}: expected ${what} of at most ${Number(most.toFixed(1))} MB, got ${size.toFixed(1)} MB${help && `; ${help}`}.`;
}
