// What a page must be: its problems, one line each, and the files it links.
(() => {
  const problems = new Set();
  const say = (text) => problems.add(text);
  const all = (selector) => [...document.querySelectorAll(selector)];
  const where = (element) => {
    const named = element.closest("[id]");
    const tag = element.tagName.toLowerCase();
    return named ? `${tag} in #${named.id}` : tag;
  };
  const root = document.documentElement;

  // Overflow, with everything folded and unfolded.
  const overflow = (state) => {
    if (root.scrollWidth <= root.clientWidth) return;
    say(`overflow: ${root.scrollWidth} px in ${root.clientWidth}, ${state}`);
    const clipped = (element) => {
      for (let e = element; e && e !== document.body; e = e.parentElement) {
        if (getComputedStyle(e).overflowX !== "visible") return true;
      }
      return false;
    };
    let shown = 0;
    for (const element of all("body *")) {
      const right = element.getBoundingClientRect().right;
      if (right > root.clientWidth + 0.5 && !clipped(element) && shown < 5) {
        shown += 1;
        say(`overflow: ${where(element)} ends at ${Math.round(right)} px`);
      }
    }
  };
  overflow("folded");
  for (const details of all("details")) details.open = true;
  overflow("unfolded");

  // Language, title, landmarks, headings.
  if (!root.lang) say("language: none");
  if (!document.title.trim()) say("title: none");
  for (const [tag, least, most] of
       [["main", 1, 1], ["h1", 1, 1], ["nav", 1, 9], ["header", 1, 1],
        ["footer", 1, 1]]) {
    const count = all(tag).length;
    if (count < least || count > most) say(`landmark ${tag}: ${count}`);
  }
  for (const child of document.body.children) {
    const known = ["HEADER", "NAV", "MAIN", "FOOTER", "A", "SCRIPT"];
    if (!known.includes(child.tagName)) {
      say(`landmark: ${where(child)} is in none`);
    }
  }
  let level = 0;
  for (const heading of all("h1, h2, h3, h4, h5, h6")) {
    const own = Number(heading.tagName[1]);
    if (own > level + 1) say(`heading: h${level} to h${own}, ` +
      `"${heading.textContent.trim()}"`);
    if (!heading.textContent.trim()) say(`heading: ${where(heading)} empty`);
    level = own;
  }

  // Names: ids once, links with text and a target.
  const ids = new Set();
  for (const element of all("[id]")) {
    if (ids.has(element.id)) say(`id: ${element.id} twice`);
    ids.add(element.id);
  }
  const files = new Set();
  for (const link of all("a[href]")) {
    const href = link.getAttribute("href");
    if (!link.textContent.trim()) say(`link: ${href} without text`);
    if (href.startsWith("#")) {
      if (!ids.has(decodeURIComponent(href.slice(1)))) {
        say(`link: ${href} leads nowhere`);
      }
    } else files.add(href);
  }
  for (const element of all("[aria-labelledby]")) {
    for (const id of element.getAttribute("aria-labelledby").split(/\s+/)) {
      if (!ids.has(id)) say(`label: ${where(element)} names #${id}`);
    }
  }

  // Drawings: there, named, and with something in them.
  for (const image of all("img")) {
    if (!image.complete || image.naturalWidth === 0) {
      say(`image: ${image.getAttribute("src")} not there`);
    }
    if (!image.alt) say(`image: ${image.getAttribute("src")} without words`);
  }
  const shapes = "path, line, polyline, polygon, rect, circle, use";
  for (const svg of all("svg")) {
    const box = svg.getBoundingClientRect();
    const title = svg.querySelector(":scope > title");
    if (!title || !title.textContent.trim()) {
      say(`drawing: ${where(svg)} without title`);
    }
    if (!(box.width > 100 && box.height > 50)) {
      say(`drawing: ${where(svg)} ${box.width} by ${box.height} px`);
    }
    const drawn = [...svg.querySelectorAll(shapes)].filter((shape) => {
      const own = shape.getBoundingClientRect();
      return own.width + own.height > 1;
    });
    if (drawn.length < 3) say(`drawing: ${where(svg)} is empty`);
    for (const text of svg.querySelectorAll("text")) {
      const own = text.getBoundingClientRect();
      if (own.left < box.left - 1 || own.right > box.right + 1 ||
          own.top < box.top - 1 || own.bottom > box.bottom + 1) {
        say(`drawing: "${text.textContent}" in ${where(svg)} is clipped`);
      }
    }
    if (/NaN|undefined/.test(svg.outerHTML)) say(`drawing: NaN in ${where(svg)}`);
  }

  // Tables: named, with headers of a scope.
  for (const table of all("table")) {
    if (!table.caption || !table.caption.textContent.trim()) {
      say(`table: ${where(table)} without caption`);
    }
    const headers = [...table.querySelectorAll("th")];
    if (!headers.length) say(`table: ${where(table)} without headers`);
    if (headers.some((header) => !header.scope)) {
      say(`table: ${where(table)} has a header without scope`);
    }
    const widths = [...table.rows].map(() => 0);
    [...table.rows].forEach((row, first) => {
      for (const cell of row.cells) {
        for (let k = 0; k < cell.rowSpan; k += 1) {
          widths[first + k] += cell.colSpan;
        }
      }
    });
    if (new Set(widths).size > 1) say(`table: ${where(table)} has uneven rows`);
  }
  for (const element of all("*")) {
    const style = getComputedStyle(element);
    const scrolls = ["auto", "scroll"].includes(style.overflowX) &&
      element.scrollWidth > element.clientWidth + 1;
    if (scrolls && element !== root && element.tabIndex < 0) {
      say(`keyboard: ${where(element)} scrolls but has no focus`);
    }
  }

  // Contrast of text against what is behind it.
  const parse = (text) => {
    const numbers = text.match(/^rgba?\(([^)]*)\)$/);
    if (!numbers) return null;
    const [r, g, b, a = 1] = numbers[1].split(/[\s,/]+/).map(Number);
    return [r, g, b, a];
  };
  const over = (front, back) => [0, 1, 2].map((i) =>
    front[3] * front[i] + (1 - front[3]) * back[i]).concat(1);
  const behind = (element) => {
    const layers = [];
    for (let e = element; e; e = e.parentElement) {
      const colour = parse(getComputedStyle(e).backgroundColor);
      if (colour && colour[3] > 0) layers.push(colour);
      if (colour && colour[3] === 1) break;
    }
    return layers.reduceRight((back, front) => over(front, back),
      [255, 255, 255, 1]);
  };
  const luminance = (colour) => {
    const [r, g, b] = colour.map((c) => c / 255).map((c) =>
      c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const opacity = (element) => {
    let product = 1;
    for (let e = element; e; e = e.parentElement) {
      product *= Number(getComputedStyle(e).opacity);
    }
    return product;
  };
  const seen = new Map();
  const walker = document.createTreeWalker(document.body,
    NodeFilter.SHOW_TEXT);
  let words = 0;
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const element = node.parentElement;
    if (!node.textContent.trim()) continue;
    if (element.closest("script, style, title, desc")) continue;
    const style = getComputedStyle(element);
    if (style.visibility !== "visible" || !element.getClientRects().length) {
      continue;
    }
    words += 1;
    const drawn = element.namespaceURI.endsWith("/svg");
    const colour = parse(drawn ? style.fill : style.color);
    const back = behind(element);
    if (!colour) {
      say(`contrast: colour ${style.color} of ${where(element)}`);
      continue;
    }
    const size = parseFloat(style.fontSize);
    const large = size >= 24 ||
      (size >= 18.66 && Number(style.fontWeight) >= 700);
    const key = [colour, back, opacity(element), large].join();
    if (seen.has(key)) continue;
    seen.set(key, true);
    const front = over([...colour.slice(0, 3),
      colour[3] * opacity(element)], back);
    const [a, b] = [luminance(front), luminance(back)];
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (!(ratio >= (large ? 3 : 4.5))) {
      say(`contrast: ${ratio.toFixed(2)} of "${node.textContent.trim()
        .slice(0, 30)}", ${where(element)}`);
    }
  }
  if (!words) say("text: none");
  return { problems: [...problems], files: [...files] };
})()
