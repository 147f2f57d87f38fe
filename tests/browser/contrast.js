({ controls: selector, minText, minIcon }) => {
  /** Pseudo-classes that only a person's hand or focus brings about, by what the person does. */
  const HANDLED = {
    "at rest": [],
    hover: ["hover"],
    focus: ["focus-visible", "focus-within", "focus"],
    pressed: ["hover", "active"],
  };
  /** Attributes by the state that they stand for. */
  const STATES = {
    "": [],
    chosen: ["aria-pressed", "aria-selected", "aria-checked", "aria-expanded", "aria-current", "data-held"],
    disabled: ["disabled", "aria-disabled"],
  };
  /** Selectors of controls that may get an attribute which they don't have now. */
  const MAY_GET = { "data-held": ".ai4u-keycap", disabled: "*", "aria-disabled": ".ai4u-tile" };
  const NO_TEXT = "[type=checkbox], [type=radio], [type=range], [type=color]";
  const controls = [...document.querySelectorAll(selector)].filter(isShown);
  const found = {};
  // text changes at once: a background that takes its time would be for a moment that of the other state
  for (const each of controls) {
    const { transitionProperty, transitionDuration } = getComputedStyle(each);
    const isSlow = /background/.test(transitionProperty) && /[1-9]/.test(transitionDuration);
    if (isSlow && each.innerText?.trim()) found[each.className] = `${each.className}: its background changes after its text`;
  }
  const still = new CSSStyleSheet();
  still.replaceSync("* { transition: none !important; animation: none !important }");
  document.adoptedStyleSheets = [...document.adoptedStyleSheets, still];
  for (const [handled, pseudos] of Object.entries(HANDLED)) {
    const undo = force(pseudos);
    for (const [state, names] of Object.entries(STATES)) {
      const reset = set(names);
      measure(`${handled}, ${state}`);
      reset();
    }
    undo();
  }
  document.adoptedStyleSheets = document.adoptedStyleSheets.filter((each) => each !== still);
  return [Object.values(found), controls.length];

  function isShown(element) {
    return element.checkVisibility({ visibilityProperty: true });
  }

  /** Let these pseudo-classes hold everywhere: another one of the same specificity, which always holds, replaces them. */
  function force(pseudos) {
    if (!pseudos.length) return () => {};
    const wanted = new RegExp(`:(${pseudos.join("|")})(?![\\w-])`, "g");
    const before = [];
    const visit = (rules) => {
      for (const rule of rules) {
        const forced = rule.selectorText?.replace(wanted, ":nth-child(n)");
        if (forced !== rule.selectorText) {
          before.push([rule, rule.selectorText]);
          rule.selectorText = forced;
        }
        if (rule.cssRules) visit(rule.cssRules);
      }
    };
    for (const sheet of [...document.styleSheets, ...document.adoptedStyleSheets]) visit(sheet.cssRules);
    return () => before.forEach(([rule, text]) => (rule.selectorText = text));
  }

  function set(names) {
    const before = [];
    for (const control of controls) {
      for (const name of names) {
        const value = control.getAttribute(name);
        if (value === null && !control.matches(MAY_GET[name] ?? ":not(*)")) continue;
        before.push([control, name, value]);
        control.setAttribute(name, "true");
      }
    }
    return () => {
      for (const [control, name, value] of before) {
        if (value === null) control.removeAttribute(name);
        else control.setAttribute(name, value);
      }
    };
  }

  function measure(state) {
    for (const control of controls) {
      for (const [element, colour, least, text] of texts(control)) {
        const ratio = contrast(element, colour);
        if (ratio >= least - 0.01) continue;
        const name = `${control.tagName.toLowerCase()}.${control.className} ${text.slice(0, 30)}`;
        found[name] ??= `${state}: ${name}: ${ratio.toFixed(2)}`;
      }
    }
  }

  function* texts(control) {
    if (control.matches(NO_TEXT)) return;
    if (control.matches("select, textarea, input")) {
      if (control.matches("select") || control.value) yield [control, getComputedStyle(control).color, minText, control.value];
      if (control.placeholder) yield [control, getComputedStyle(control, "::placeholder").color, minText, control.placeholder];
      return;
    }
    for (const each of [control, ...control.querySelectorAll("*")]) {
      if (!isShown(each)) continue;
      const own = [...each.childNodes].filter(({ nodeType }) => nodeType === 3).map(({ data }) => data.trim()).join("");
      if (own) yield [each, getComputedStyle(each).color, minText, own];
      if (each.matches("svg")) yield [each, getComputedStyle(each).color, minIcon, "icon"];
    }
  }

  function contrast(element, colour) {
    const path = [];
    for (let each = element; each; each = each.parentElement) path.unshift(getComputedStyle(each));
    const { ai4uScheme } = document.documentElement.dataset;
    const isDark = ai4uScheme ? ai4uScheme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    const base = isDark ? [26, 27, 30] : [255, 255, 255];
    const [low, high] = painted(path, rgba(colour), base).map(luminance).sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
  }

  /** Return what is painted in the end, [background, text]: opacity and brightness hold for all that is inside. */
  function painted(path, text, below) {
    if (path.length === 0) return [below, over(below, text)];
    const [{ backgroundColor, opacity, filter }, ...rest] = path;
    const brightness = Number(/brightness\(([\d.]+)\)/.exec(filter)?.[1] ?? 1);
    return painted(rest, text, over(below, rgba(backgroundColor))).map((each) =>
      mix(below, each.map((part) => Math.min(255, part * brightness)), Number(opacity)),
    );
  }

  function over(below, [r, g, b, a]) {
    return mix(below, [r, g, b], a);
  }

  function mix(below, above, share) {
    return below.map((each, index) => each + share * (above[index] - each));
  }

  function luminance(colour) {
    const [r, g, b] = colour.map((each) => {
      const part = each / 255;
      return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  }

  /** Return a colour in any notation of CSS as [r, g, b, alpha]: a canvas reads them all. */
  function rgba(colour) {
    const colours = (self.ai4uColours ??= new Map());
    if (!colours.has(colour)) {
      const pen = (self.ai4uPen ??= new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true }));
      pen.clearRect(0, 0, 1, 1);
      pen.fillStyle = colour;
      pen.fillRect(0, 0, 1, 1);
      const [r, g, b, a] = pen.getImageData(0, 0, 1, 1).data;
      colours.set(colour, [r, g, b, a / 255]);
    }
    return colours.get(colour);
  }
}
