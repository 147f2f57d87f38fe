/**
 * The page's random id. The panel's socket and viser's both carry it, so that the server knows which picture
 * belongs to which panel.
 *
 * The page has a panel where the server says so (data-panel).
 * A classic script, not a module, because it must run before viser starts: viser's client connects to the
 * address in the query parameter "websocket", which is there until it has connected.
 */
(() => {
  const PARAMETER = "websocket";
  /** viser's parameter for a resolution of the picture that does not change. */
  const RESOLUTION = "fixedDpr";
  const CHECK_PERIOD_MS = 1000;
  /** Checks after which the parameter stays where it is. */
  const MAX_CHECKS = 30;
  const url = new URL(location.href);
  // viser writes the address again, without what stands after its "#"; scenes/share.js looks here first
  document.documentElement.dataset.ai4uFragment = url.hash;
  if (!("panel" in document.currentScript.dataset)) return;

  // crypto.randomUUID is missing on pages without HTTPS
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  const id = Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
  window.ai4uPageId = id;
  document.documentElement.dataset.ai4uPanel = "open"; // styles/panel/layout.css makes room for it
  url.searchParams.set(PARAMETER, `${location.origin.replace(/^http/, "ws")}${location.pathname}?page=${id}`);
  const resolution = rememberedResolution();
  const isResolutionOurs = resolution > 0 && !url.searchParams.has(RESOLUTION);
  if (isResolutionOurs) url.searchParams.set(RESOLUTION, String(resolution));
  history.replaceState(history.state, "", url);

  // viser's canvas is there after viser has read the parameter, and viser may write it again
  let checks = 0;
  const timer = setInterval(() => {
    const now = new URL(location.href);
    if (now.searchParams.has(PARAMETER) && document.querySelector("canvas")) {
      now.searchParams.delete(PARAMETER);
      if (isResolutionOurs) now.searchParams.delete(RESOLUTION);
      history.replaceState(history.state, "", now);
    }
    checks += 1;
    if (checks === MAX_CHECKS) clearInterval(timer);
  }, CHECK_PERIOD_MS);

  // Without a graphics chip, smooth edges take a third of a picture's time, and a higher resolution looks better.
  // The prototype is as it was once viser has its context.
  const prototype = /** @type {any} */ (HTMLCanvasElement.prototype);
  const { getContext } = prototype;
  prototype.getContext = function (/** @type {string} */ kind, /** @type {any} */ options) {
    if (kind !== "webgl2" || !options?.antialias) return getContext.call(this, kind, options);
    prototype.getContext = getContext;
    return getContext.call(this, kind, { ...options, antialias: !isDrawnBySoftware() });
  };

  /** Return true if WebGL is drawn by the processor; page/graphics.js, a module, comes too late. */
  function isDrawnBySoftware() {
    const gl = document.createElement("canvas").getContext("webgl2");
    const names = gl?.getExtension("WEBGL_debug_renderer_info");
    const renderer = names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
    gl?.getExtension("WEBGL_lose_context")?.loseContext(); // browsers keep few contexts
    return /swiftshader|llvmpipe|softpipe|software/i.test(renderer);
  }

  /** Return the resolution that page/resolution.js found for this browser; 0 for viser's own. */
  function rememberedResolution() {
    try {
      const value = Number(JSON.parse(localStorage.getItem("ai4u-resolution") ?? "0"));
      return value >= 0.25 && value <= 4 ? value : 0;
    } catch {
      return 0; // storage is blocked, or holds something else
    }
  }
})();
