"use strict";
(async () => {
const $ = (id) => document.getElementById(id);

// An engine in a worker of its own: a question in, an answer out.
function worker() {
  let module, ready;
  const start = () => { ready = WebAssembly.instantiate(module, {}); };
  // Bytes in, bytes out, by the two buffers of a WebAssembly module.
  const call = ({ room, answer, answer_start, memory }, bytes) => {
    const at = room(bytes.length);
    new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
    const length = answer();
    return new Uint8Array(memory.buffer, answer_start(), length);
  };
  onmessage = async ({ data }) => {
    if (data.module) { module = data.module; start(); return; }
    let answer;
    try {
      const question = new TextEncoder().encode(JSON.stringify(data));
      const found = call((await ready).exports, question);
      answer = JSON.parse(new TextDecoder().decode(found));
    } catch (error) {
      answer = { error: `the engine stopped: ${error.message}` };
      start();
    }
    postMessage(answer);
  };
}
const source = URL.createObjectURL(
  new Blob([`(${worker})()`], { type: "text/javascript" }));

// Some engines that share a queue of questions.
class Engines {
  constructor(module, most) {
    Object.assign(this, { module, most, idle: [], all: [], queue: [] });
  }
  ask(question) {
    return new Promise((resolve, reject) => {
      this.queue.push({ question, resolve, reject });
      this.next();
    });
  }
  next() {
    if (!this.queue.length) return;
    if (!this.idle.length && this.all.length < this.most) {
      const fresh = new Worker(source);
      fresh.postMessage({ module: this.module });
      this.all.push(fresh);
      this.idle.push(fresh);
    }
    const own = this.idle.pop();
    if (!own) return;
    const task = own.task = this.queue.shift();
    own.onmessage = ({ data }) => {
      own.task = null;
      this.idle.push(own);
      if (data.error === undefined) task.resolve(data);
      else task.reject(new Error(data.error));
      this.next();
    };
    own.postMessage(task.question);
    this.next();
  }
  stop() {
    const left = [...this.all.map((own) => own.task), ...this.queue];
    this.all.forEach((own) => own.terminate());
    this.idle = []; this.all = []; this.queue = [];
    left.filter(Boolean).forEach((task) => task.reject(new Error("stopped")));
  }
}

const native = JSON.parse($("native").textContent);
const compiled = async () => {
  if (!globalThis.DecompressionStream) throw new Error("this browser has no " +
    "DecompressionStream, which unpacks it. A newer browser has one.");
  const packed = Uint8Array.from(atob($("engine").textContent),
    (c) => c.charCodeAt(0));
  const engine = new Blob([packed]).stream()
    .pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(engine).arrayBuffer());
};
const module = await compiled().catch((error) => {
  $("state").textContent = `The engine cannot start: ${error.message}`;
});
if (!module) return;
const cores = Math.min(4, Math.max(1, navigator.hardwareConcurrency || 1));
const own = new Engines(module, 1);
const many = new Engines(module, cores);

const make = (tag, content = "", attributes = {}) => {
  const element = document.createElement(tag);
  element.append(...[content].flat());
  Object.entries(attributes).forEach((pair) => element.setAttribute(...pair));
  return element;
};
const digits = (x, n = 6) =>
  typeof x === "number" ? String(Number(x.toPrecision(n))) : "none";
// The digits of a number that lie above the bound on its error.
const sure = (x, bound) => digits(x, bound > 0
  ? Math.min(12, Math.max(1, Math.floor(Math.log10(Math.abs(x) / bound)))) : 6);
const rows = (table, pairs) => $(table).tBodies[0].replaceChildren(
  ...pairs.map((cells) => make("tr", cells.map((text, k) => k
    ? make("td", text) : make("th", text, { scope: "row" })))));

// ---- Reference cases ----
const listed = await many.ask({ ask: "cases" });
$("state").textContent = `The engine is ready, on ${cores} ` +
  `${cores > 1 ? "cores" : "core"}.`;
const results = new Map();
const lines = new Map();
const runs = listed.filter((own) => native.cases[own.id]);

function tally() {
  const count = (what) => [...results.values()]
    .filter((result) => result === what).length;
  const wrong = count("differs") + count("fails");
  $("progress").max = runs.length;
  $("progress").value = results.size;
  $("tally").textContent = `${results.size} of ${runs.length} cases run, ` +
    `${count("equal")} equal to the last bit` +
    (wrong ? `, ${count("differs")} differ, ${count("fails")} fail.` : ".");
}
async function run({ id }) {
  const line = lines.get(id);
  line.result.textContent = "running";
  try {
    const found = await many.ask({ ask: "case", id });
    line.here.textContent = found.first;
    line.bits.textContent = found.bits;
    const result = found.bits !== native.cases[id].bits ? "differs"
      : found.holds ? "equal" : "fails";
    results.set(id, result);
    line.result.textContent = result;
    line.result.className = `verdict ${result === "equal" ? "yes" : "no"}`;
  } catch (error) {
    const stopped = error.message === "stopped";
    if (!stopped) results.set(id, "fails");
    line.result.textContent = stopped ? "not run" : error.message;
  }
  tally();
}
async function runAll(cases) {
  $("stop").disabled = false;
  await Promise.all(cases.map(run));
  $("stop").disabled = true;
}
for (const [family, cases] of Object.entries(
  Object.groupBy(runs, (own) => own.id.split("/")[0]))) {
  const name = family.replaceAll("-", " ");
  const title = `${name}, ${cases.length}`;
  const button = make("button", `Run ${name}`);
  button.onclick = () => runAll(cases);
  const heads = ["Claim", "First number here", "Compiled program", "Bits here",
    "Bits of the program", "Result"];
  const body = cases.map(({ id, claim }) => {
    const due = native.cases[id];
    const cells = ["", `${due.quantity} ${due.first}`, "", due.bits, "not run"]
      .map((text, k) => make("td", text, { "data-label": heads[k + 1] }));
    const [here, , bits, , result] = cells;
    lines.set(id, { here, bits, result });
    return make("tr", [make("th", claim, { scope: "row" }), ...cells]);
  });
  const head = heads.map((text) => make("th", text, { scope: "col" }));
  const table = make("table", [make("caption", `Cases: ${title}`),
    make("thead", make("tr", head)), make("tbody", body)],
  { class: "cards cases" });
  const box = make("div", table, { class: "scroll", role: "region",
    tabindex: "0", "aria-label": `Cases: ${title}` });
  $("cases").append(make("details", [make("summary", title), button, box]));
}
$("left-why").textContent = `${native.left.length} of ` +
  `${runs.length + native.left.length} reference cases take longer than about ` +
  "a second in a browser, or use quantiles of Student's t and of the beta " +
  "distribution from the library statrs, which uses the logarithm of the " +
  "platform: last digits differ there.";
$("left-list").append(...native.left.map((id) => make("li", id)));
$("all").onclick = () => runAll(runs);
$("stop").onclick = () => many.stop();
tally();

// ---- Drawings ----
const ticks = (low, high) => {
  const ten = 10 ** Math.floor(Math.log10((high - low) / 5));
  const step = ten * [1, 2, 5, 10].find((m) => 5 * m * ten >= high - low);
  const first = Math.ceil(low / step);
  return Array.from({ length: Math.floor(high / step) - first + 1 },
    (_, k) => Number(((first + k) * step).toPrecision(9)));
};
// Lines of [class, points] over axes; y is the range of the ordinate.
function plot(title, across, up, series, x, y, limits = []) {
  const [w, h, left, low] = [640, 300, 56, 44];
  const to = (v, [a, b], from, until) => from + (until - from) * (v - a) / (b - a);
  const px = (v) => to(v, x, left, w - 12).toFixed(1);
  const py = (v) => to(v, y, h - low, 22).toFixed(1);
  const line = (a, b, kind) =>
    `<path class="${kind}" d="M${px(a[0])} ${py(a[1])}L${px(b[0])} ${py(b[1])}"/>`;
  const parts = [`<title>${title}</title>`,
    `<path class="axis" d="M${left} 22V${h - low}H${w - 12}"/>`];
  for (const v of ticks(...x)) parts.push(
    `<text x="${px(v)}" y="${h - low + 17}" text-anchor="middle">${v}</text>`);
  for (const v of ticks(...y)) parts.push(
    `<text x="${left - 6}" y="${py(v)}" dy=".35em" text-anchor="end">${v}</text>`);
  parts.push(`<text x="${(left + w) / 2}" y="${h - 8}" text-anchor="middle">${across}</text>`,
    `<text x="4" y="14">${up}</text>`);
  for (const v of limits) parts.push(line([x[0], v], [x[1], v], "limit"));
  for (const [kind, points] of series) {
    const path = points.map(([a, b]) => `${px(a)} ${py(b)}`).join("L");
    parts.push(`<path class="${kind}" d="M${path}"/>`);
  }
  return `<svg viewBox="0 0 ${w} ${h}" role="img" aria-label="${title}">${parts.join("")}</svg>`;
}

// ---- Your block ----
const number = (id) => Number($(id).value);
let components = [], motions = [], shown = null, changed = 0, playing = false;
const isPulse = () => !["motion", "file"].includes($("kind").value);
const recorded = () => $("kind").value === "file"
  ? components[number("component")] : motions[number("motion")];
const shape = () => $("given").value === "lengths"
  ? { width_m: number("width"), height_m: number("height") }
  : { alpha_rad: number("alpha"), p_rad_s: number("p") };
function ground() {
  const [kind, duration_s] = [$("kind").value, number("duration")];
  if (!isPulse()) {
    const { dt_s, samples_g } = recorded();
    return { kind: "record", dt_s, samples_g };
  }
  if (kind === "rectangle") return { kind, duration_s };
  if (kind === "ricker") return { kind, period_s: duration_s / 2 };
  const turns = kind === "half-sine" ? 1 : 2;
  return { kind, omega_rad_s: turns * Math.PI / duration_s };
}
const scene = () => ({ block: shape(), eta: number("eta"), ground: ground(),
  intensity: number("intensity") });

const outcomes = {
  "no-uplift": () => "The block does not lift.",
  rocked: (c) => "The block rocks but stays up. Its peak rotation is " +
    `${digits(c.edp, 3)} alpha.`,
  overturned: (c) =>
    `The block overturns after ${digits(c.overturning_time_s, 3)} s.`,
};
const settled = (c) => !c.resolved
  ? " Even the highest precision does not decide the outcome."
  : c.by === "double" ? " Double precision is enough here."
  : ` The outcome was decided in ${c.by} precision.`;
// Without a result nothing of the last one is left.
function clear(words) {
  shown = null;
  playing = false;
  $("verdict").textContent = words;
  ["numbers", "fragility"].forEach((table) => rows(table, []));
  ["history", "scene", "ida-drawing", "ida-words", "fragility-words"]
    .forEach((id) => $(id).replaceChildren());
}
// The first field on show that has no number in its range.
function wrong() {
  const field = [...$("form").querySelectorAll("input[type=number]")]
    .find((own) => !own.closest("[hidden]") && !own.validity.valid ||
      own.min && !own.closest("[hidden]") && own.id !== "dt" && !own.value);
  return field && `${field.closest("label").textContent.trim()}: expected a ` +
    `number of at least ${field.min}` + (field.max ? ` and at most ${field.max}.` : ".");
}
function show(found, took_ms) {
  shown = found;
  const { response: r, certified: c } = found;
  $("verdict").textContent = outcomes[c.counts_as](c) + settled(c);
  const least = r.certificate?.least;
  rows("numbers", [
    ["Slenderness alpha", `${digits(found.alpha_rad, 4)} rad`],
    ["Frequency parameter p", `${digits(found.p_rad_s, 4)} rad/s`],
    ["Width and height", `${digits(found.width_m, 4)} m, ${digits(found.height_m, 4)} m`],
    ["Peak ground acceleration", `${digits(found.pga_g, 4)} g`],
    ["Peak rotation over alpha", c.counts_as === "overturned"
      ? "none: the block overturns" : sure(r.peak_ratio, r.error_estimate)],
    ["Bound on its error", digits(r.error_estimate, 2)],
    ["Time of the peak", `${digits(r.peak_time_s, 4)} s`],
    ["Impacts", `${r.impacts.length}`],
    ["Distance from the other outcome, over alpha", digits(r.fate_margin, 3)],
    ["Least clear decision: margin over its error", least
      ? `${least.ratio.toExponential(1)} (enough from ` +
        `${r.certificate.clear_from_ratio})` : "none"],
    ["Condition number", digits(r.condition_number, 3)],
    ["Bits", found.bits],
    ["Computed in", `${took_ms.toFixed(0)} ms`],
  ]);
  const dt = found.interval_s;
  const end = dt * Math.max(1, found.ratio.length - 1);
  const most = found.ratio.reduce((m, v) => Math.max(m, Math.abs(v)), 1.1);
  const peak = found.pga_g || 1;
  const over = (values, factor) => values.map((v, k) => [k * dt, v * factor]);
  $("history").innerHTML = plot("Rotation and ground acceleration in time",
    "time (s)", "solid: rotation/alpha; ochre: ground acceleration, scaled",
    [["two", over(found.ground_g, 0.5 / peak)], ["one", over(found.ratio, 1)]],
    [0, end], [-most, most], [-1, 1]);
  $("time").max = end;
  $("time").value = 0;
  draw();
}
function draw() {
  const t = number("time");
  $("time-out").textContent = `${t.toFixed(2)} s`;
  if (!shown) return;
  const k = Math.min(Math.round(t / shown.interval_s), shown.ratio.length - 1);
  const angle = (shown.ratio[k] ?? 0) * shown.alpha_rad * 180 / Math.PI;
  const size = 190 / Math.hypot(shown.width_m, shown.height_m);
  const [w, h] = [shown.width_m * size, shown.height_m * size];
  const pivot = angle > 0 ? 160 + w / 2 : 160 - w / 2;
  $("scene").innerHTML = `<svg viewBox="0 0 320 250" role="img" ` +
    `aria-label="The block at this time"><title>The block, tilted by ` +
    `${digits(angle, 3)} degrees</title><path class="axis" d="M10 230H310"/>` +
    `<rect class="body" x="${160 - w / 2}" y="${230 - h}" width="${w}" ` +
    `height="${h}" transform="rotate(${angle} ${pivot} 230)"/>` +
    `<path class="limit" d="M160 20V230"/>` +
    `<text x="10" y="247">ground ${digits(shown.ground_g[k] ?? 0, 2)} g</text></svg>`;
}
function frame(last, now) {
  if (last) $("time").value = number("time") + (now - last) / 1000;
  draw();
  if (number("time") >= Number($("time").max)) playing = false;
  if (playing) requestAnimationFrame((next) => frame(now, next));
  $("play").textContent = playing ? "Pause" : "Play";
}
$("play").onclick = () => {
  playing = !playing;
  if (number("time") >= Number($("time").max)) $("time").value = 0;
  frame(0, performance.now());
};
$("time").oninput = draw;

async function fragility() {
  const { average_sa_g, probability, law } =
    await own.ask({ ask: "fragility", ...scene() });
  const [first, last] = [law.periods_s[0], law.periods_s.at(-1)];
  rows("fragility", [
    [`AvgSA of this motion, ${first} to ${last} s`,
      `${digits(average_sa_g, 3)} g`],
    ["Median of overturning", `${digits(law.total.median, 3)} g`],
    ["Probability of overturning", `${(100 * probability).toFixed(1)} %`],
    ["Dispersion: choice of the record; law; all, with the model",
      [law.record_dispersion, law.law_error, law.total.dispersion]
        .map((x) => digits(x, 2)).join("; ")],
  ]);
  $("fragility-words").textContent = "";
}
let busy = false, again = false;
async function answer() {
  if (wrong()) return clear(wrong());
  if (!isPulse() && !recorded()) {
    return clear("Open a record file, or drop one on this page.");
  }
  const begin = performance.now();
  const slow = setTimeout(() => {
    $("verdict").textContent = "Computing.";
  }, 200);
  const found = await own.ask({ ask: "response", ...scene() })
    .finally(() => clearTimeout(slow));
  show(found, performance.now() - begin);
  await fragility().catch((error) => {
    rows("fragility", []);
    $("fragility-words").textContent = error.message;
  });
}
// If inputs change during an answer, only the last change is answered.
async function update() {
  again = true;
  if (busy) return;
  busy = true;
  while (again) {
    again = false;
    await answer().catch((error) => clear(error.message));
  }
  busy = false;
  changed += 1;
  document.body.dataset.changed = changed;
}
const options = (id, list) => $(id).replaceChildren(...list.map((own, k) =>
  make("option", own.name, { value: k })));
async function chosen() {
  const [kind, given] = [$("kind").value, $("given").value];
  for (const part of document.querySelectorAll("[data-given]")) {
    part.hidden = part.dataset.given !== given;
  }
  for (const part of document.querySelectorAll("[data-kind]")) {
    const wanted = { pulse: isPulse(), recorded: !isPulse() };
    part.hidden = !(wanted[part.dataset.kind] ?? part.dataset.kind === kind);
  }
  $("ida").disabled = isPulse();
  $("duration-out").textContent = `${number("duration").toFixed(2)} s`;
  $("intensity-out").textContent = number("intensity").toFixed(2);
  if (kind === "motion" && !motions.length) {
    $("verdict").textContent = "Simulating the motions.";
    motions = await own.ask({ ask: "motions" });
    options("motion", motions);
  }
  await update();
}
async function read(file) {
  if (!file) return;
  $("kind").value = "file";
  components = [];
  let refused = "";
  try {
    const bytes = await file.arrayBuffer();
    const text = new TextDecoder("utf-8", { ignoreBOM: true }).decode(bytes);
    components = await own.ask({ ask: "read", name: file.name, text,
      dt_s: number("dt") || null, unit: $("unit").value || null });
  } catch (error) { refused = error.message; }
  options("component", components);
  await chosen();
  if (refused) clear(refused);
}
let dropped = null;
const reread = () => read(dropped ?? $("file").files[0]);
$("form").onsubmit = (event) => event.preventDefault();
$("form").oninput = (event) => {
  if (event.target.id === "file") dropped = null;
  if (["file", "dt", "unit"].includes(event.target.id)) reread();
  else chosen();
};
$("as-recorded").onclick = () => {
  if (!recorded() || !shown) return;
  const wanted = recorded().pga_g / Math.tan(shown.alpha_rad);
  $("intensity").step = "any";
  $("intensity").max = Math.max(10, wanted);
  $("intensity").min = Math.min(0.5, wanted);
  $("intensity").value = wanted;
  chosen();
};
const marked = (event, over) => {
  event.preventDefault();
  document.body.classList.toggle("dropping", over);
};
addEventListener("dragover", (event) => marked(event, true));
addEventListener("dragleave", (event) => marked(event, false));
addEventListener("drop", (event) => {
  marked(event, false);
  dropped = event.dataTransfer.files[0];
  read(dropped);
});

$("ida").onclick = async () => {
  const begin = performance.now();
  $("ida-words").textContent = "Running.";
  try {
    const found = await own.ask({ ask: "ida", ...scene() });
    const { points, overturning } = found;
    $("ida-words").textContent = `${found.analyses} analyses in ` +
      `${(performance.now() - begin).toFixed(0)} ms. ` + (overturning
        ? `First overturning at PGA/(g tan alpha) = ${digits(overturning)}.`
        : "The block does not overturn.") + ` Bits ${found.bits}.`;
    const right = Math.max(overturning ?? 0, ...points.map(([im]) => im)) * 1.05;
    $("ida-drawing").innerHTML = plot("IDA curve of this record",
      "PGA/(g tan alpha)", "peak rotation/alpha; dashed: overturning",
      [["one", points], ...(overturning
        ? [["limit", [[overturning, 0], [overturning, 1.1]]]] : [])],
      [0, right], [0, 1.1], [1]);
  } catch (error) { $("ida-words").textContent = error.message; }
};

// ---- Map of outcomes ----
const SIDE = 25, MIDDLE = SIDE >> 1;
function cell(canvas, i, j, fate, peak) {
  const pen = canvas.getContext("2d");
  const [left, low, w, h] = [70, 40, (620 - 80) / SIDE, (420 - 50) / SIDE];
  const [x, y] = [left + i * w, 420 - low - (j + 1) * h];
  const dark = { overturned: "#3a2020", unresolved: "#c9a227" }[fate];
  pen.fillStyle = dark ?? `hsl(212 60% ${92 - 50 * Math.min(1, peak)}%)`;
  pen.fillRect(x, y, w + 0.5, h + 0.5);
  if (fate === "unresolved") {
    pen.strokeStyle = "#000";
    pen.beginPath(); pen.moveTo(x, y); pen.lineTo(x + w, y + h); pen.stroke();
  }
}
function axes(canvas, intensities, sizes) {
  const pen = canvas.getContext("2d");
  const style = getComputedStyle(document.body);
  pen.clearRect(0, 0, 620, 420);
  pen.fillStyle = style.color;
  pen.font = "13px system-ui, sans-serif";
  for (const k of [0, MIDDLE, SIDE - 1]) {
    pen.textAlign = "center";
    pen.fillText(digits(intensities[k], 3), 70 + (k + 0.5) * 540 / SIDE, 397);
    pen.textAlign = "right";
    pen.fillText(digits(sizes[k], 3), 62, 384 - (k + 0.5) * 370 / SIDE);
  }
  pen.textAlign = "center";
  pen.fillText("intensity PGA/(g tan alpha)", 340, 415);
  pen.save();
  pen.translate(14, 200); pen.rotate(-Math.PI / 2);
  pen.fillText("frequency parameter p (rad/s)", 0, 0);
  pen.restore();
}
$("map").onclick = async () => {
  if (!shown) return;
  const around = (middle) => Array.from({ length: SIDE }, (_, k) =>
    middle * 2 ** (k / MIDDLE - 1));
  const intensities = around(number("intensity"));
  const sizes = around(shown.p_rad_s);
  const [canvas, base, begin] = [$("map-drawing"), scene(), performance.now()];
  $("map-box").hidden = false;
  axes(canvas, intensities, sizes);
  const running = (is) => {
    $("map").disabled = is;
    $("map-stop").disabled = !is;
  };
  running(true);
  const count = { overturned: 0, rocked: 0, "no-uplift": 0, unresolved: 0 };
  try {
    await Promise.all(sizes.map(async (p, j) => {
      const found = await many.ask({ ask: "fates", scene: base, intensities,
        p_rad_s: [p] });
      found.rows[0].forEach((fate, i) => {
        count[fate] += 1;
        cell(canvas, i, j, fate, found.peaks[0][i]);
      });
    }));
    const pen = canvas.getContext("2d");
    for (const [color, size] of [["#fff", 4], ["#000", 2]]) {
      pen.fillStyle = color;
      pen.fillRect(340 - 8, 195 - size / 2, 16, size);
      pen.fillRect(340 - size / 2, 195 - 8, size, 16);
    }
    const text = `${count.overturned} of ${SIDE * SIDE} blocks overturn, ` +
      `${count.rocked} rock but stay up, ${count["no-uplift"]} do not lift, ` +
      `${count.unresolved} are unresolved in double precision.`;
    $("map-words").textContent = `${text} Computed in ` +
      `${((performance.now() - begin) / 1000).toFixed(1)} s.`;
    canvas.setAttribute("aria-label", `Map of outcomes: ${text}`);
  } catch (error) { $("map-words").textContent = error.message; }
  running(false);
};
$("map-stop").onclick = () => many.stop();

// Twice: during the first answer the browser compiles what it runs.
await chosen();
await update();
document.body.dataset.ready = "yes";
})();
