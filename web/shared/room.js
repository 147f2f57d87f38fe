/** Return the id of a class's room in the page's address; "" for a page without a class. */
export function roomOfPage() {
  return /\/r\/([\w-]+)\//.exec(location.pathname)?.[1] ?? "";
}
