// The page as a whole: narrow windows, contrast, absent data, speed and size.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import {
  accessibilityFaults, brushAll, choose, click, clickPixel, readWalk, redraw, selectedRows, selectionTimes, waitForPanes,
} from './browser.mjs';
import { all, openPage, size, study, template } from './fixture.mjs';
import { makeStudy } from './sample.mjs';

describe('the page', () => {
  it('has no horizontal scroll in a narrow window', async () => {
    for (const width of [360, 768]) {
      const page = await openPage({ width, height: 740 });
      await page.evaluate(() => document.querySelectorAll('details').forEach(node => { node.open = true; }));
      await clickPixel(page, 'reference', 10, 10, size);
      await readWalk(page, 10, 10, all[0], 20);
      for (const show of ['disagreement.colorvideovdp', 'threshold.Y']) {
        await redraw(page, () => choose(page, '#frame-controls', 'Show', show));
        const [scroll, inner] = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
        assert.ok(scroll <= inner, `${scroll} pixels in a window of ${inner}`);
      }
    }
  });

  it('has text with enough contrast, light and dark', async () => {
    for (const dark of [false, true]) {
      const page = await openPage({ dark });
      const weak = await page.evaluate(findWeakText);
      assert.deepEqual(weak, [], dark ? 'dark' : 'light');
    }
  });

  it('keeps the rules of axe-core on accessibility', async () => {
    for (const layout of ['side', 'swipe', 'blink']) {
      const page = await openPage({ calm: true, dark: layout === 'swipe', width: layout === 'blink' ? 360 : 1280 });
      await page.evaluate(() => document.querySelectorAll('details').forEach(node => { node.open = true; }));
      await click(page, `input[value="${layout}"]`);
      await page.waitForSelector(`#panes[data-layout="${layout}"]`);
      await page.focus('.stage');
      await page.keyboard.press('Enter');
      await readWalk(page, 48, 32, all[0], 20);
      await redraw(page, () => choose(page, '#frame-controls', 'Show', layout === 'side' ? 'threshold.Y' : 'disagreement.colorvideovdp'));
      assert.deepEqual(await accessibilityFaults(page), [], layout);
    }
  });

  it('keeps the theme that is chosen', async () => {
    const page = await openPage();
    const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await background();
    await click(page, '#theme');
    await click(page, '#theme');
    assert.match(await page.$eval('#theme', node => node.textContent), /dark/);
    assert.notEqual(await background(), light);
    await page.evaluate(() => localStorage.clear());
  });

  it('leaves out what the data do not have', async () => {
    const bare = { schema_version: 1, title: 'bare', width: 8, height: 8, frames: [1], axes: [], metrics: study.metrics,
      variants: [{ id: 'only', settings: {}, metrics: { processor_seconds: { value: 1 }, share_beyond: null }, frames: [{ frame: 1, metrics: {} }] }] };
    const page = await openPage({}, { study: bare, layers: [] });
    for (const part of ['pictures', 'pixel', 'effort', 'plan', 'ledger']) assert.equal(await page.$eval(`#${part}`, node => node.hidden), true, part);
    assert.deepEqual(await selectedRows(page), ['only']);
    assert.match(await page.$eval('#facts', node => node.textContent), /frame 1, 8 × 8 pixels/);
  });

  it('says so where it has no data, or data of another version', async () => {
    for (const [data, reason] of [[null, /template without data/], [{ study: { schema_version: 2 }, layers: [] }, /version 2/]]) {
      const page = await openPage({ ready: '#notice:not([hidden])' }, data);
      assert.match(await page.$eval('#notice', node => node.textContent), reason);
    }
  });

  it('paints and draws with 20 MB of layers', async context => {
    const data = makeStudy({ width: 320, height: 240 });
    const copies = Math.ceil(20e6 / data.layers.reduce((sum, text) => sum + text.length, 0));
    data.layers = Array.from({ length: copies }, () => data.layers).flat();
    const page = await openPage({}, data);
    const bytes = data.layers.reduce((sum, text) => sum + text.length, 0);
    const paint = await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime);
    await click(page, '[data-sort="metric:processor_seconds"]');
    await brushAll(page);
    await waitForPanes(page, ['reference', ...all]);
    await click(page, `tr[data-variant="${all[1]}"]`);
    await waitForPanes(page, ['reference', all[1]]);
    await page.evaluate(() => [...document.querySelectorAll('#table-buttons button')].find(node => node.textContent === 'Select all').click());
    await waitForPanes(page, ['reference', ...all]);
    const times = await selectionTimes(page);
    context.diagnostic(`layers of ${(bytes / 1e6).toFixed(1)} MB; first paint ${paint.toFixed(0)} ms; ` +
      `selection to frames ${times.map(time => time.toFixed(0)).join(', ')} ms`);
    assert.ok(times.length >= 3);
  });

  it('is of modest size, with each place for data once', () => {
    assert.ok(template.length < 1.3e6, `${template.length} bytes`);
    for (const place of ['<!-- STUDY DATA -->', '<!-- STUDY LAYERS -->']) assert.equal(template.split(place).length, 2);
  });
});

/** In the page: texts of the page's own style with less contrast than 4.5 (WCAG 2.2, 1.4.3), with their contrast. */
function findWeakText() {
  const canvas = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  const parse = color => {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = color;
    canvas.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data;
    return { rgb: [r, g, b], alpha: a / 255 };
  };
  const luminance = rgb => rgb.map(value => value / 255).map(value => value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4)
    .reduce((sum, value, i) => sum + value * [0.2126, 0.7152, 0.0722][i], 0);
  const backgroundOf = node => {
    for (let at = node; at; at = at.parentElement) {
      const color = parse(getComputedStyle(at).backgroundColor);
      if (color.alpha > 0.99) return color.rgb;
    }
    return [255, 255, 255];
  };
  const weak = [];
  for (const node of document.querySelectorAll('body *')) {
    const own = [...node.childNodes].some(child => child.nodeType === 3 && child.textContent.trim());
    if (!own || !node.checkVisibility() || node.closest('.stage, .visually-hidden, option')) continue;
    const style = getComputedStyle(node);
    const ink = node instanceof SVGElement ? style.fill : style.color;
    const [a, b] = [luminance(parse(ink).rgb), luminance(backgroundOf(node))].sort((left, right) => right - left);
    const contrast = (a + 0.05) / (b + 0.05);
    if (contrast < 4.5) weak.push(`${node.textContent.trim().slice(0, 30)}: ${contrast.toFixed(2)}`);
  }
  return weak;
}
