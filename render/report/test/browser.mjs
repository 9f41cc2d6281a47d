// A headless Chromium with one page, and what the tests ask of it.
// The packages stand in the folder that this is run in (npm ci), or beside this folder.
import { createRequire } from 'node:module';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const packages = fs.existsSync(path.join(process.cwd(), 'node_modules')) ? process.cwd() : path.dirname(here);
const require = createRequire(path.join(packages, 'package.json'));

/** Milliseconds after which a wait counts as a hang: ten times what a slow machine takes. */
export const hang = 300000;

const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium';

/** Starts the browser. */
export async function launch() {
  const { default: puppeteer } = await import(pathToFileURL(require.resolve('puppeteer-core')).href);
  return puppeteer.launch({ executablePath: chromium, headless: true, timeout: hang, protocolTimeout: hang, args: ['--no-sandbox', '--disable-gpu', '--force-device-scale-factor=1'] });
}

/** Opens a page from a file, and notes everything that goes wrong in it. `ready`: what shows that it is done. */
export async function open(browser, file, { width = 1280, height = 900, dark = false, calm = false, ready = '[data-ready="true"]' } = {}) {
  const page = await browser.newPage();
  page.setDefaultTimeout(hang);
  const troubles = [];
  const requests = [];
  page.on('console', message => {
    if (['error', 'warn', 'warning', 'assert'].includes(message.type())) troubles.push(`${message.type()}: ${message.text()}`);
  });
  page.on('pageerror', error => troubles.push(String(error.stack ?? error)));
  page.on('request', request => requests.push(request.url()));
  await page.setViewport({ width, height });
  await page.emulateMediaFeatures([
    { name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' },
    { name: 'prefers-reduced-motion', value: calm ? 'reduce' : 'no-preference' },
  ]);
  const address = pathToFileURL(path.resolve(file)).href;
  await page.goto(address, { timeout: hang });
  await page.waitForSelector(ready);
  const isOutside = url => url !== address && !url.startsWith('data:') && !url.startsWith('blob:');
  return { page, troubles, outside: () => requests.filter(isOutside) };
}

/** Faults of the page's accessibility that axe-core finds: rule and place, one line each. */
export async function accessibilityFaults(page) {
  await page.addScriptTag({ content: fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8') });
  const { violations } = await page.evaluate(() => window.axe.run({ runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }));
  return violations.flatMap(({ id, nodes }) => nodes.map(node => `${id}: ${node.html.slice(0, 120)}`));
}

/** Ids of the variants and "reference" whose pictures are drawn. */
export function shownPanes(page) {
  return page.$$eval('#panes canvas[data-pane]', nodes => nodes.map(node => node.dataset.pane));
}

/** Points at a place until a tooltip says what is expected. A chart that is drawn again hides its tooltip until the pointer moves. */
export async function waitForTooltip(page, place, pattern) {
  for (let left = 20; left >= 0; --left) {
    await page.mouse.move(place.x + left % 2, place.y);
    const shown = page.waitForFunction(text => new RegExp(text).test(document.querySelector('#vg-tooltip-element.visible')?.innerText ?? ''),
      { timeout: 2000 }, pattern);
    if (await shown.then(() => true, error => { if (left === 0) throw error; return false; })) return;
  }
}

/** Waits until the panes show these ids in this order. */
export async function waitForPanes(page, ids) {
  await page.waitForFunction(list => document.querySelector('#panes').dataset.drawn?.split('|').slice(1).join('|') === list,
    {}, ids.join('|'));
}

/** Does something that draws the panes again, and waits until they are drawn. */
export async function redraw(page, act) {
  await page.evaluate(() => { delete document.querySelector('#panes').dataset.drawn; });
  await act();
  await page.waitForSelector('#panes[data-drawn]');
}

/** Selected variants, as the table shows them. */
export function selectedRows(page) {
  return page.$$eval('tr[aria-selected="true"]', nodes => nodes.map(node => node.dataset.variant));
}

/** Changes a menu by its name. */
export async function choose(page, holder, name, value) {
  await page.evaluate((area, title, key) => {
    const node = [...document.querySelectorAll(`${area} select`)].find(select => select.name === title);
    node.value = key;
    node.dispatchEvent(new Event('change', { bubbles: true }));
  }, holder, name, value);
}

/**
 * Clicks an element in the page itself. When this ends, its handlers have run, and so have the listeners of the page's
 * choices, which run once in the next frame of the screen.
 */
export function click(page, selector) {
  return page.$eval(selector, async node => {
    node.click();
    await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  });
}

/** Clicks the middle of a pixel of a pane, at zoom 1. */
export async function clickPixel(page, id, x, y, size) {
  const canvas = await page.$(`#panes canvas[data-pane="${id}"]`);
  await canvas.scrollIntoView();
  const box = await canvas.boundingBox();
  await page.mouse.click(box.x + (x + 0.5) * box.width / size.width, box.y + (y + 0.5) * box.height / size.height);
}

/** Waits until the walk shows a pixel of a variant and frame; then its values by channel. */
export async function readWalk(page, x, y, variant, frame) {
  await page.waitForFunction((pixel, id, number) => {
    const { dataset } = document.querySelector('#walk');
    return dataset.pixel === pixel && dataset.variant === id && dataset.frame === number;
  }, {}, `${x},${y}`, variant, String(frame));
  return Object.fromEntries(await page.$$eval('#walk [data-channel]', nodes =>
    nodes.map(node => [node.dataset.channel, Number(node.dataset.value)])));
}

/** Drags over the whole plot of the chart. */
export async function brushAll(page) {
  await page.evaluate(() => document.querySelector('#chart').scrollIntoView({ block: 'center' }));
  const box = await page.$eval('#chart svg .background', node => {
    const { x, y, width, height } = node.getBoundingClientRect();
    return { x, y, width, height };
  });
  await page.mouse.move(box.x + 2, box.y + 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 3 });
  await page.mouse.move(box.x + box.width - 2, box.y + box.height - 2, { steps: 3 });
  await page.mouse.up();
  return box;
}

/** Milliseconds from selecting to all frames drawn, for each selection so far. */
export function selectionTimes(page) {
  return page.evaluate(() => performance.getEntriesByName('selection to frames').map(entry => entry.duration));
}
