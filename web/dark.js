/**
 * Light or dark: what the person chose in the panel, remembered, or else what the system wishes.
 *
 * Not a module: it has to be done before viser begins. The server hears by a cookie what to tell viser
 * as soon as the page connects; until then a page that is to be dark is not shown, so it doesn't flash.
 */
(() => {
  const STORE = "ai4u-dark";
  /** What the choice is called in the panel. */
  const NAME = "Dark";
  /** How long the page may stay hidden, whatever happens (ms). */
  const PATIENCE = 4000;
  const root = document.documentElement;
  // viser itself sees to an address that asks for it
  const isAsked = new URLSearchParams(location.search).has("darkMode");
  let isDark = isAsked || (remembered() ?? matchMedia("(prefers-color-scheme: dark)").matches);

  // as long as the window: another page may be shown otherwise, and viser comes back with the focus
  const tell = () => (document.cookie = `ai4u_edu_dark=${isDark ? 1 : ""}; SameSite=Strict`);
  tell();
  addEventListener("focus", tell);
  addEventListener("change", ({ target }) => {
    const isOurs = target instanceof HTMLInputElement && target.type === "checkbox";
    if (!isOurs || target.labels?.[0]?.textContent.trim() !== NAME) return;
    isDark = target.checked;
    tell();
    remember(isDark);
  });

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
  setTimeout(show, PATIENCE);

  function remembered() {
    try {
      return { dark: true, light: false }[localStorage.getItem(STORE)];
    } catch {
      return undefined; // forbidden here
    }
  }

  function remember(dark) {
    try {
      localStorage.setItem(STORE, dark ? "dark" : "light");
    } catch {
      // forbidden here: it holds as long as the page
    }
  }
})();
