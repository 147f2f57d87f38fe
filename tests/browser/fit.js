() => {
  const SLACK_PX = 1.5;
  const isHidden = ({ width, height }) => width <= 1 || height <= 1; // for screen readers alone
  // what has one row by design, and stands in full elsewhere: names and reasons on small cards, the goal above a large tab
  const SHORTENED = ".ai4u-name, .ai4u-room-name, .ai4u-room-scene, .ai4u-room-why, [data-small] .ai4u-goal-text";
  const found = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const text = node.nodeValue.trim();
    const parent = node.parentElement;
    if (!text || !parent.checkVisibility({ visibilityProperty: true, opacityProperty: true })) continue;
    if (parent.closest("script, style, svg, select, textarea, .cm-editor") || parent.closest(SHORTENED)) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    const rects = [...range.getClientRects()].filter((rect) => rect.width && rect.height);
    if (!rects.length) continue;
    const left = Math.min(...rects.map((rect) => rect.left));
    const right = Math.max(...rects.map((rect) => rect.right));
    let place = "";
    for (let box = parent; box && box !== document.body; box = box.parentElement) {
      const edge = box.getBoundingClientRect();
      const { overflowX, position } = getComputedStyle(box);
      if (isHidden(edge)) { place = ""; break; }
      if (overflowX === "auto" || overflowX === "scroll") break;
      const isClip = overflowX === "hidden" || overflowX === "clip" || box.matches("button, [role=tab], [role=button], summary, td, th, label");
      if (isClip && getComputedStyle(box).display !== "inline" && (right > edge.right + SLACK_PX || left < edge.left - SLACK_PX)) {
        place = `${box.tagName.toLowerCase()}.${box.className}`;
        break;
      }
      if (position === "fixed" && (right > innerWidth + SLACK_PX || left < -SLACK_PX)) { place = "window"; break; }
    }
    if (place) found.push(`${text.slice(0, 80)} (${place})`);
  }
  return [...new Set(found)];
}
