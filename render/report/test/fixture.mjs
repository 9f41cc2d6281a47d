// Shared by the test files: a browser, and the page with synthetic data. BUILD (from the environment) has the template.
import assert from 'node:assert/strict';
import { after, afterEach, before } from 'node:test';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { launch, open } from './browser.mjs';
import { fillTemplate, makeStudy } from './sample.mjs';

export const size = { width: 96, height: 64 };
export const id = (error, guide) => `error=${error},guide=${guide}`;
/** All variants, in the order of the study. */
export const all = [0.5, 1, 2].flatMap(error => ['none', 'saliency'].map(guide => id(error, guide)));

export const template = fs.readFileSync(path.join(process.env.BUILD, 'report-template.html'), 'utf8');
const sample = makeStudy(size);
export const { study } = sample;

export const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'aleph-report-'));
let browser;
let opened = [];

before(async () => {
  browser = await launch();
});
after(async () => {
  await browser?.close();
  fs.rmSync(folder, { recursive: true });
});
// No page may log an error or a warning, or ask for anything.
afterEach(async () => {
  const pages = opened;
  opened = [];
  for (const { page } of pages) await page.close();
  for (const { troubles, outside } of pages) assert.deepEqual([...troubles, ...outside()], []);
});

/** Opens a page. @param {string} text  of the page @param {object} [options]  of open */
export async function openText(text, options) {
  const file = path.join(folder, 'page.html');
  fs.writeFileSync(file, text);
  const result = await open(browser, file, options);
  opened.push(result);
  return result.page;
}

/** Opens the report with the data given, else those of `study`. @param {object} [data]  of makeStudy; null for the template itself */
export function openPage(options, data = sample) {
  return openText(data ? fillTemplate(template, data) : template, options);
}
