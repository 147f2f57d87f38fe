/** What the page adds to the browser's own types, and what not every browser has. */

interface Window {
  /** The page's random id, where it has a panel; see page/page_id.js. */
  ai4uPageId?: string;
}

interface WindowEventMap {
  /** The person has chosen dark colors (true) or light ones. */
  "ai4u-dark": CustomEvent<boolean>;
}

interface Navigator {
  /** Chromium's alone. */
  readonly keyboard?: { getLayoutMap(): Promise<ReadonlyMap<string, string>> };
}
