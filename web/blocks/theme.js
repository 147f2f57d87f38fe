/** Colors of the blocks: dark enough for white letters, and told apart by the words on them, too. */

const COLORS = {
  events: "#7d5500",
  actions: "#0069a6",
  senses: "#00694e",
  control: "#8a3a7e",
  numbers: "#4a55a8",
  memory: "#a33500",
};

/** Return the theme in the form of Blockly; the surfaces are the panel's own colors, so they follow the page's scheme. */
export function blocksTheme() {
  /** @type {Record<string, {colourPrimary: string, hat: string}>} */
  const blockStyles = {};
  /** @type {Record<string, {colour: string}>} */
  const categoryStyles = {};
  for (const [name, color] of Object.entries(COLORS)) {
    blockStyles[name] = { colourPrimary: color, hat: name === "events" ? "cap" : "" };
    categoryStyles[name] = { colour: color };
  }
  return {
    name: "ai4u",
    blockStyles,
    categoryStyles,
    componentStyles: {
      workspaceBackgroundColour: "var(--surface)",
      toolboxBackgroundColour: "var(--raised)",
      toolboxForegroundColour: "var(--ink)",
      flyoutBackgroundColour: "var(--well)",
      flyoutForegroundColour: "var(--ink)",
      flyoutOpacity: 1,
      scrollbarColour: "var(--edge)",
      scrollbarOpacity: 0.4,
      insertionMarkerColour: "var(--ink)",
      insertionMarkerOpacity: 0.3,
    },
    fontStyle: { family: "'Atkinson Hyperlegible Next', system-ui, sans-serif", size: 11 },
  };
}
