// node build.mjs OUT/report-template.html: bundles each page, its style and its script into one file: the report, and
// beside it OUT/viewer-template.html, the viewer test.
// The packages stand in the folder that this is run in (npm ci), or beside this file.
import { createRequire } from 'node:module';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const out = process.argv[2];
if (!out) {
  console.error('usage: node build.mjs OUT/report-template.html');
  process.exit(2);
}
const packages = fs.existsSync(path.join(process.cwd(), 'node_modules')) ? process.cwd() : here;
const esbuild = createRequire(path.join(packages, 'package.json'))('esbuild');

/** The bundled text of one entry file, and the folders of the packages in it. */
async function bundle(entry) {
  const result = await esbuild.build({
    entryPoints: [path.join(here, entry)],
    bundle: true,
    write: false,
    metafile: true,
    minify: true,
    format: 'iife',
    target: 'es2022',
    charset: 'utf8',
    legalComments: 'none',
    logLevel: 'warning',
    nodePaths: [path.join(packages, 'node_modules')],
  });
  const folders = Object.keys(result.metafile.inputs).map(file => file.match(/^.*node_modules\/(?:@[^/]+\/)?[^/]+/)?.[0]);
  return { text: result.outputFiles[0].text.trim(), folders: [...new Set(folders.filter(Boolean))] };
}

/** The licences of the bundled packages, each text once, as HTML text; they must go with every copy. */
function licences(folders) {
  const texts = new Map();
  for (const folder of folders.sort()) {
    const { name, version } = JSON.parse(fs.readFileSync(path.join(folder, 'package.json'), 'utf8'));
    const file = fs.readdirSync(folder).find(entry => /^licen[cs]e/i.test(entry));
    if (!file) throw new Error(`${name} has no licence file`);
    const text = fs.readFileSync(path.join(folder, file), 'utf8').trim();
    texts.set(text, [...texts.get(text) ?? [], `${name} ${version}`]);
  }
  const all = [...texts].map(([text, names]) => `${names.join(', ')}\n\n${text}`).join('\n\n');
  return all.replaceAll('&', '&amp;').replaceAll('<', '&lt;');
}

/**
 * Writes one page with its style and script inside.
 * @param {string} html @param {string} styleEntry @param {string} scriptEntry
 * @param {string[]} places comments for data, each of which has to be there once
 */
async function write(html, styleEntry, scriptEntry, places, file) {
  const style = await bundle(styleEntry);
  const script = await bundle(scriptEntry);
  const parts = { STYLE: style.text, SCRIPT: script.text, LICENCES: licences(script.folders) };
  let page = fs.readFileSync(path.join(here, html), 'utf8');
  for (const [name, text] of Object.entries(parts)) page = page.replace(`{{${name}}}`, () => text);
  for (const place of places) {
    if (page.split(place).length !== 2) throw new Error(`${place} does not occur exactly once in ${html}`);
  }
  // "<!--" within a script starts a state in which "</script>" may not end it.
  if (parts.SCRIPT.includes('<!--')) throw new Error(`the script of ${html} holds "<!--"`);
  if (/(?:src|href)="(?!data:|#)/.test(page.replace(parts.SCRIPT, ''))) throw new Error(`${html} refers to a file`);
  fs.mkdirSync(path.dirname(path.resolve(file)), { recursive: true });
  fs.writeFileSync(file, page);
  console.log(`${file}: ${(Buffer.byteLength(page) / 1e6).toFixed(2)} MB`);
}

await write('page.html', 'src/page.css', 'src/main.js', ['<!-- STUDY DATA -->', '<!-- STUDY LAYERS -->'], out);
await write('viewer.html', 'viewer/viewer.css', 'viewer/main.js', ['<!-- TEST DATA -->'], path.join(path.dirname(out), 'viewer-template.html'));
