/** Blockly's own words in the page's language. */

import { pageCatalogue, t } from "../shared/text.js";

/**
 * Blockly's own catalogues, by the page's language.
 * @type {Record<string, () => Promise<{default: Record<string, string>}>>}
 */
const CATALOGUES = { pt_BR: () => import("../vendor/blockly.pt_BR.js?v=a87d0860") };

/** Words by Blockly's keys, for screen readers but for two, that its catalogues have in English, or not as we need them. */
const WORDS = {
  CLEAN_UP: t("Clean up Blocks"),
  RENAME_VARIABLE: t("Rename the '%1' variable"),

  ARIA_LABEL_BUTTON: t("button"),
  ARIA_TYPE_FIELD_DROPDOWN: t("dropdown"),
  ARIA_TYPE_FIELD_INPUT: t("input"),
  ARIA_TYPE_FIELD_NUMBER: t("number"),
  ARIA_TYPE_FIELD_TEXT_INPUT: t("text"),
  FIELD_LABEL_EDIT_PREFIX: t("Edit %1"),
  FIELD_LABEL_EMPTY: t("empty"),
  FIELD_LABEL_VARIABLE: t("Variable '%1'"),

  BLOCK_LABEL_BEGIN_PREFIX: t("Begin %1"),
  BLOCK_LABEL_BEGIN_STACK: t("Begin stack"),
  BLOCK_LABEL_CONTAINER: t("container"),
  BLOCK_LABEL_DISABLED: t("disabled"),
  BLOCK_LABEL_HAS_BRANCHES: t("has %1 branches"),
  BLOCK_LABEL_HAS_INPUT: t("has input"),
  BLOCK_LABEL_HAS_INPUTS: t("has inputs"),
  BLOCK_LABEL_REPLACEABLE: t("replaceable"),
  BLOCK_LABEL_STACK_BLOCKS: t("%1 stack blocks"),
  BLOCK_LABEL_STATEMENT: t("statement"),
  BLOCK_LABEL_TOOLBOX_CATEGORY: t("%1 category"),
  BLOCK_LABEL_VALUE: t("value"),
  INPUT_LABEL_EMPTY: t("Empty"),
  INPUT_LABEL_END_STATEMENT: t("End %1"),
  INPUT_LABEL_INDEX: t("input %1"),
  INPUT_LABEL_STATEMENT: t("statement position"),
  INPUT_LABEL_VALUE: t("value position"),

  ANNOUNCE_CANT_SCROLL_FURTHER: t("Can't scroll further."),
  ANNOUNCE_MOVE_AFTER: t("Moving %1 after %2."),
  ANNOUNCE_MOVE_AROUND: t("Moving %1 around %2."),
  ANNOUNCE_MOVE_BEFORE: t("Moving %1 before %2."),
  ANNOUNCE_MOVE_CANCELED: t("Canceled movement."),
  ANNOUNCE_MOVE_INSIDE: t("Moving %1 inside %2."),
  ANNOUNCE_MOVE_OF: t("%1 of %2"),
  ANNOUNCE_MOVE_TO: t("Moving %1 to %2."),
  ANNOUNCE_MOVE_WORKSPACE: t("Moving %1 on workspace."),
  ANNOUNCE_SCROLLED_DOWN: t("Scrolled down."),
  ANNOUNCE_SCROLLED_LEFT: t("Scrolled left."),
  ANNOUNCE_SCROLLED_RIGHT: t("Scrolled right."),
  ANNOUNCE_SCROLLED_UP: t("Scrolled up."),
  CURRENT_BLOCK_ANNOUNCEMENT: t("Current block: %1"),
  NO_PARENT_ANNOUNCEMENT: t("Current block has no parent"),
  PARENT_BLOCKS_ANNOUNCEMENT: t("Parent blocks: %1"),

  KEYBOARD_NAV_BLOCK_NAVIGATION_HINT: t("Use %1 to navigate inside of blocks."),
  KEYBOARD_NAV_WORKSPACE_NAVIGATION_HINT: t("Use the arrow keys to navigate."),
  SCREENREADER_HINT: t("Use the arrow keys to navigate. Press %1 to toggle screenreader accessibility mode."),
  SCREENREADER_MODE_DISABLED: t("Screenreader mode is off, press %1 to turn it on"),
  SCREENREADER_MODE_ENABLED: t("Screenreader mode is on, press %1 to turn it off"),

  WORKSPACE_CONTENTS_BLOCKS_MANY: t("%1 stacks of blocks%2 in workspace."),
  WORKSPACE_CONTENTS_BLOCKS_ONE: t("One stack of blocks%2 in workspace."),
  WORKSPACE_CONTENTS_BLOCKS_ZERO: t("No blocks%2 in workspace."),
  WORKSPACE_LABEL_1_STACK: t("1 stack of blocks"),
  WORKSPACE_LABEL_FLYOUT_WORKSPACE: t("%1 blocks"),
  WORKSPACE_LABEL_MANY_STACKS: t("%1 stacks of blocks"),
  WORKSPACE_LABEL_PLAIN: t("Blocks workspace."),
  WORKSPACE_ROLEDESCRIPTION: t("workspace"),
};

/** Load Blockly's words in the page's language. */
export async function blocklyWords() {
  const catalogue = await CATALOGUES[pageCatalogue().language]?.();
  return { ...catalogue?.default, ...WORDS };
}
