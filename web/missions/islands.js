/** The islands of the map of missions. */

import { t } from "../shared/text.js";

/** @type {Record<string, string>} titles by name; a mission's island is one of these names */
const TITLES = {
  Drive: t("Drive"),
  Sense: t("Sense"),
  Think: t("Think"),
  Code: t("Code"),
  Build: t("Build"),
  Teach: t("Teach"),
  Compete: t("Compete"),
  "My class": t("My class"),
};

/**
 * Return an island's title.
 * @param {string} island its name
 */
export function islandTitle(island) {
  return TITLES[island] ?? island;
}
