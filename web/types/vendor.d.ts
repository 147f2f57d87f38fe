/** Libraries of vendor/, by the version in their address. They come without types. */

declare module "*/blockly.js?v=e631db10";
declare module "*/codemirror.js?v=b595b00f";
declare module "*/msgpack.js?v=269ec7b2";
declare module "*/pyodide.asm.mjs?v=f7cdc8ec";
declare module "*/pyodide.mjs?v=6f1d60f7";
