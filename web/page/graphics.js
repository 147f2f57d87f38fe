/** Detection of browsers that draw without a graphics card. */

const SOFTWARE_RENDERERS = ["swiftshader", "llvmpipe", "softpipe", "software"];

/** Return true if WebGL is drawn by the processor. */
export function isDrawnBySoftware() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const renderer = names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)).toLowerCase() : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext(); // browsers keep few contexts; the picture needs its own
  return SOFTWARE_RENDERERS.some((name) => renderer.includes(name));
}
