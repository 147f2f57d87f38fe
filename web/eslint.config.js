/** Rules for the page's scripts and their tests. `tsc` finds names that don't exist. */

import js from "@eslint/js";

export default [
  { ignores: ["**/node_modules/", "web/vendor/"] },
  js.configs.recommended,
  { rules: { "no-undef": "off", "no-unused-vars": ["error", { ignoreRestSiblings: true }] } },
];
