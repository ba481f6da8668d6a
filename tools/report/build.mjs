// Build the assets of the report page into scene2hap/report/assets: `npm ci && npm run build`.

import { createHash } from "node:crypto";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const assets = join(here, "..", "..", "scene2hap", "report", "assets");
const MOST_BYTES = 750_000;

const result = await build({
  absWorkingDir: here,
  entryPoints: { report: "src/main.js", style: "src/style.css" },
  outdir: assets,
  bundle: true,
  minify: true,
  write: false,
  format: "iife",
  target: ["es2022", "chrome111", "firefox113", "safari16.4"],
  // The page is sent as UTF-8, but a copy may not be.
  charset: "ascii",
  // Licences are in a separate file.
  legalComments: "none",
});

const texts = new Map(result.outputFiles.map((file) => [file.path.split(/[\\/]/).pop(), file.text.trimEnd()]));
const script = texts.get("report.js");
const style = texts.get("style.css");
if (script.length > MOST_BYTES) throw new Error(`report.js has ${script.length} bytes; the limit is ${MOST_BYTES}.`);
for (const [text, bad] of [
  [script, /<\/script|<!--|\r|\/\*STYLE\*\//i],
  [style, /<\/style|<!--|\r|\/\*SCRIPT\*\//i],
]) {
  const found = bad.exec(text);
  if (found) throw new Error(`An asset holds ${JSON.stringify(found[0])}, which would end its element in the page.`);
}

const licences = [];
for (const name of ["three", "uplot"]) {
  const folder = join(here, "node_modules", name);
  const { version } = JSON.parse(await readFile(join(folder, "package.json"), "utf8"));
  licences.push(`${name} ${version}\n\n${(await readFile(join(folder, "LICENSE"), "utf8")).trim()}\n`);
}
const licenceText = `report.js and style.css contain:\n\n${licences.join("\n----\n\n")}`;

// The page's policy allows the style and the script with these hashes and no others.
const hash = (text) => `sha256-${createHash("sha256").update(text).digest("base64")}`;
const inHtml = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
const page = (await readFile(join(here, "src", "page.html"), "utf8"))
  .replace("%SCRIPT_HASH%", hash(script))
  .replace("%STYLE_HASH%", hash(style))
  // A page contains copies of the libraries, so it must contain their licences.
  .replace("%LICENCES%", () => inHtml(licenceText));

await mkdir(assets, { recursive: true });
await writeFile(join(assets, "report.js"), script);
await writeFile(join(assets, "style.css"), style);
await writeFile(join(assets, "page.html"), page);
await writeFile(join(assets, "LICENSES.txt"), licenceText);
console.log(`report.js ${script.length} bytes, style.css ${style.length} bytes`);
