/** The color scheme of a page without viser: the choice that page/dark.js stored, else the system's preference. */
(() => {
  try {
    const choice = localStorage.getItem("ai4u-dark");
    if (choice) document.documentElement.style.colorScheme = choice;
  } catch {
    // storage is blocked here
  }
})();
