/**
 * Has the browser start what draws in 3D while viser's script is still being read.
 *
 * The first context that asks for anything waits until that process runs, for a third of a second
 * where there is no graphics card. Not a module, for those wait until the page has been read.
 */
(() => {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 1;
  const gl = canvas.getContext("webgl2");
  gl?.flush();
  addEventListener("load", () => gl?.getExtension("WEBGL_lose_context")?.loseContext());
})();
