// Draws the figure of a page by `zonal-gen paper --html` into it, so that it needs neither scripts nor a network.
//   node draw.mjs IN.html OUT.html
import { readFileSync, writeFileSync } from "node:fs";
import * as vega from "vega";
import { compile } from "vega-lite";

const [input, output] = process.argv.slice(2);
if (!output) throw new Error("wanted: node draw.mjs IN.html OUT.html");
const page = readFileSync(input, "utf8");
const found = page.match(/<script>\nconst figure = (.*);\n[^]*?<\/script>\n/);
if (!found) throw new Error(`${input}: found no figure, wanted a page that zonal-gen paper --html wrote`);

const view = new vega.View(vega.parse(compile(JSON.parse(found[1])).spec), { renderer: "none" });
const picture = await view.toSVG();
const drawn = page
  .replace(found[0], "")
  .replace(/<script src=.*><\/script>\n/g, "")
  .replace(/<div id="figure">.*<\/div>/, () => `<div id="figure">${picture}</div>`);
if (drawn.includes("<script") || !drawn.includes("<svg")) throw new Error(`${input}: the picture found no place`);
writeFileSync(output, drawn);
