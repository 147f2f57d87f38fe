/**
 * Color scheme: the person's stored choice from the panel, else the system's preference.
 *
 * A classic script, not a module, because it must run before viser starts. A cookie tells the server which
 * theme to give viser when the page connects. Until then a dark page stays hidden, so it doesn't flash white.
 */
(() => {
  const STORAGE_KEY = "ai4u-dark";
  /** Longest time that the page stays hidden while viser loads (ms). */
  const MAX_HIDDEN_MS = 4000;
  const root = document.documentElement;
  // viser reads this query parameter itself
  const isForced = new URLSearchParams(location.search).has("darkMode");
  let isDark = isForced || (loadChoice() ?? matchMedia("(prefers-color-scheme: dark)").matches);

  // A session cookie, set again on focus: another page may have set it otherwise, and viser reconnects on focus.
  const setCookie = () => (document.cookie = `ai4u_edu_dark=${isDark ? 1 : ""}; SameSite=Strict`);
  const choose = (/** @type {boolean} */ dark) => {
    isDark = dark;
    root.dataset.ai4uScheme = dark ? "dark" : "light";
    setCookie();
    storeChoice(dark);
  };
  root.dataset.ai4uScheme = isDark ? "dark" : "light";
  setCookie();
  addEventListener("focus", setCookie);
  addEventListener("ai4u-dark", ({ detail }) => choose(detail));

  if (!isDark) return;
  root.toggleAttribute("data-ai4u-dark", true);
  const show = () => {
    root.removeAttribute("data-ai4u-dark");
    observer.disconnect();
  };
  const observer = new MutationObserver(() => {
    if (root.dataset.mantineColorScheme === "dark") show();
  });
  observer.observe(root, { attributeFilter: ["data-mantine-color-scheme"] });
  setTimeout(show, MAX_HIDDEN_MS);

  function loadChoice() {
    try {
      return { dark: true, light: false }[localStorage.getItem(STORAGE_KEY)];
    } catch {
      return undefined; // storage is blocked here
    }
  }

  /** @param {boolean} dark */
  function storeChoice(dark) {
    try {
      localStorage.setItem(STORAGE_KEY, dark ? "dark" : "light");
    } catch {
      // storage is blocked here: the choice lasts as long as the page
    }
  }
})();
