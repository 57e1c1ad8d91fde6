// Draws the time of one call against its largest error: speed_error.json, which zonal-bench writes, as
// speed_error.svg. One line a kernel or baseline, one mark an order, both axes logarithmic. No dependency.
//   node tests/bench/speed_error.mjs [IN.json [OUT.svg]]
// Both files anew: cmake --build build/release --target speed-error
import {readFileSync, writeFileSync} from "node:fs";

const beside = name => new URL(name, import.meta.url).pathname;
const [source = beside("speed_error.json"), target = beside("speed_error.svg")] = process.argv.slice(2);
const measured = JSON.parse(readFileSync(source, "utf8"));
const calls = measured.results.filter(r => r.workload === "single" && r.place === "L2" && r.type === "float");
if (calls.length === 0) throw new Error(`${source}: no single calls in float from L2; write it with zonal-bench`);

const width = 880, height = 560;
const plot = {left: 74, right: 20, top: 64, bottom: 96};
const radius = 8.5, letter = 8.3, line = 16;  // of a mark; of text at 13 px, bold

const axis = (values, ticks, from, to) => {
    const low = Math.min(...values) / 1.25, high = Math.max(...values) * 1.25;
    const at = value => from + (to - from) * Math.log(value / low) / Math.log(high / low);
    return {at, ticks: ticks.filter(tick => tick >= low && tick <= high)};
};
const decades = [1, 2, 5].flatMap(digit => Array.from({length: 24}, (_, k) => Number(`${digit}e${k - 16}`)));
const x = axis(calls.map(c => c.ns), decades, plot.left, width - plot.right);
const y = axis(calls.map(c => c.error), decades, height - plot.bottom, plot.top);

const names = [...new Set(calls.map(c => c.contestant))];
const series = names.map((name, k) => ({
    name, k, is_ours: name.startsWith("rotate"),
    points: calls.filter(c => c.contestant === name).sort((a, b) => a.order - b.order)
        .map(c => ({order: c.order, x: x.at(c.ns), y: y.at(c.error)})),
}));

// A name stands where it covers least: beside a mark of its own, away from marks, lines and other names.
const box = (cx, cy, w, h) => ({left: cx - w / 2, right: cx + w / 2, top: cy - h / 2, bottom: cy + h / 2});
const shared = (a, b) => Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left)) *
                         Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));
const taken = series.flatMap(s => s.points.flatMap((p, k) => {
    const next = s.points[k + 1] ?? p;
    const along = Array.from({length: 20}, (_, t) =>
        box(p.x + (next.x - p.x) * t / 20, p.y + (next.y - p.y) * t / 20, 6, 6));
    return [box(p.x, p.y, 2 * radius, 2 * radius), ...along];
}));
const inside = {left: plot.left, right: width - plot.right, top: plot.top, bottom: height - plot.bottom};
for (const s of series) {
    const w = s.name.length * letter, aside = radius + 5 + w / 2, above = radius + 4 + line / 2;
    const places = s.points.flatMap(p => [[aside, 0], [-aside, 0], [0, -above], [0, above], [w / 2, -above],
        [w / 2, above], [-w / 2, -above], [-w / 2, above]].map(([dx, dy]) => box(p.x + dx, p.y + dy, w, line)));
    const cost = place => taken.reduce((sum, other) => sum + shared(place, other), 0) +
                          10 * (w * line - shared(place, inside));
    s.label = places.reduce((best, place) => cost(place) < cost(best) - 1e-9 ? place : best);
    taken.push(s.label);
}

const escaped = text => text.replace(/&/g, "&amp;").replace(/</g, "&lt;");
const number = value => value.toFixed(1).replace(/\.0$/, "");
const text = (tx, ty, content, attributes = "") =>
    `<text x="${number(tx)}" y="${number(ty)}"${attributes}>${escaped(content)}</text>`;
const power = value => value.toExponential(0).replace("e-", "e−");

const svg = [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" role="img">`,
    "<title>Time of one call against its largest error, orders " +
        `${Math.min(...calls.map(c => c.order))} to ${Math.max(...calls.map(c => c.order))}</title>`,
    "<style>",
    "svg{--paper:#fff;--ink:#1f2328;--faint:#59636e;--grid:#e3e6ea;font:13px sans-serif}",
    "@media(prefers-color-scheme:dark){svg{--paper:#0d1117;--ink:#e6edf3;--faint:#9198a1;--grid:#2a313c}}",
    "text{fill:var(--ink)}.faint{fill:var(--faint)}.grid{stroke:var(--grid)}.mid{text-anchor:middle}",
    ".end{text-anchor:end}.small{font-size:11px}.title{font-size:16px;font-weight:bold}.name{font-weight:bold}",
    ".line{fill:none;stroke-width:1.6}.theirs .line{stroke-dasharray:3 4}.digit{fill:#fff;font-size:11px;font-weight:bold}",
    // Colours of one luminance: a contrast of 4.3 to the light paper and to the dark one.
    ...["#d6434d", "#bd5e00", "#8c5ee1", "#2c8946", "#2177de", "#138592", "#c54a92", "#717a84"].map((colour, k) =>
        `.c${k} .line{stroke:${colour}}.c${k} circle,.c${k} .name{fill:${colour}}`),
    "</style>",
    `<rect width="${width}" height="${height}" fill="var(--paper)"/>`,
    text(plot.left, 26, "One call in float: time against largest error", ' class="title"'),
    text(plot.left, 46, "digit: order N; solid: zonal's kernels, dashed: what others do; left and low is better",
         ' class="faint"'),
    ...x.ticks.map(t => `<path class="grid" d="M${number(x.at(t))} ${plot.top}V${height - plot.bottom}"/>` +
        text(x.at(t), height - plot.bottom + 18, String(t), ' class="mid"')),
    ...y.ticks.map(t => `<path class="grid" d="M${plot.left} ${number(y.at(t))}H${width - plot.right}"/>` +
        text(plot.left - 8, y.at(t) + 4, power(t), ' class="end"')),
    text((plot.left + width - plot.right) / 2, height - plot.bottom + 38, "nanoseconds of one call", ' class="mid"'),
    text(0, 0, "largest error, relative to the input",
         ` class="mid" transform="translate(18 ${(plot.top + height - plot.bottom) / 2}) rotate(-90)"`),
    ...series.map(s => `<g class="c${s.k % 8} ${s.is_ours ? "ours" : "theirs"}">` +
        `<path class="line" d="M${s.points.map(p => `${number(p.x)} ${number(p.y)}`).join("L")}"/>` +
        s.points.map(p => `<circle cx="${number(p.x)}" cy="${number(p.y)}" r="${radius}"/>` +
            text(p.x, p.y + 4, String(p.order), ' class="mid digit"')).join("") +
        text((s.label.left + s.label.right) / 2, s.label.bottom - 4, s.name, ' class="mid name"') + "</g>"),
    text(plot.left, height - 32, `${measured.machine}; ${measured.compiler} ${measured.flags}; ${measured.date}; ` +
        `errors over ${measured.error_rotations} random rotations`, ' class="faint small"'),
    text(plot.left, height - 16, measured.command, ' class="faint small"'),
    "</svg>", "",
].join("\n");
writeFileSync(target, svg);
console.log(`${target}: ${series.length} kernels and baselines, ${calls.length} marks, ${svg.length} bytes`);
