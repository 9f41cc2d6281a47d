// Checks a report that `aleph study` wrote (REPORT in the environment): it opens without errors or requests, a brush over the
// chart selects variants and draws their frames, and the pixel walk shows what the file stores.
import assert from 'node:assert/strict';
import { after, before, describe, it } from 'node:test';
import fs from 'node:fs';
import zlib from 'node:zlib';
import { brushAll, choose, click, clickPixel, launch, open, readWalk, selectedRows, shownPanes, waitForPanes } from './browser.mjs';
import { halfValue } from './sample.mjs';

const file = process.env.REPORT;
const text = fs.readFileSync(file, 'utf8');
const study = JSON.parse(text.match(/<script id="study" type="application\/json">(.*?)<\/script>/s)[1]);

/** A stored value, read from the file without the page's code. */
function storedValue(layer, x, y) {
  const start = text.indexOf(`id="${layer.element}">`) + layer.element.length + 6;
  const bytes = zlib.inflateSync(Buffer.from(text.slice(start, text.indexOf('<', start)), 'base64'));
  const count = layer.width * layer.height * layer.channels;
  const i = y * layer.width + x;
  if (layer.type === 'f16') return halfValue(bytes[i] | bytes[count + i] << 8);
  return Buffer.from([0, 1, 2, 3].map(byte => bytes[byte * count + i])).readFloatLE();
}

describe('the report', () => {
  let browser;
  let opened;
  before(async () => {
    browser = await launch();
    opened = await open(browser, file);
  });
  after(() => browser?.close());

  it('shows its title and every variant', async () => {
    assert.equal(await opened.page.title(), study.title);
    assert.equal(await opened.page.$eval('#notice', node => node.hidden), true);
    assert.equal((await opened.page.$$('tr[data-variant]')).length, study.variants.length);
  });

  it('brushes', async () => {
    const { page } = opened;
    const [x, y] = [study.metrics[0], study.metrics[1] ?? study.metrics[0]];
    const drawn = study.variants.filter(variant => [x, y].every(metric => Number.isFinite(variant.metrics[metric.name]?.value)));
    await click(page, 'tr[data-variant]');
    await brushAll(page);
    await page.waitForFunction(count => document.querySelectorAll('tr[aria-selected="true"]').length === count, { timeout: 10000 }, drawn.length);
    assert.deepEqual(await selectedRows(page), drawn.map(variant => variant.id));
    if (!study.pictures?.length) return;
    await page.waitForFunction(id => document.querySelector('#panes').dataset.drawn?.includes(id), { timeout: 20000 }, drawn.at(0).id);
    assert.ok((await shownPanes(page)).includes(drawn[0].id));
  });

  it('walks: the values shown are those stored', async context => {
    const [variant] = study.variants;
    const entry = variant.frames.find(frame => frame.picture && study.pictures?.some(shared => shared.frame === frame.frame && shared.reference));
    if (!entry) return context.skip('the report has no pictures with a reference');
    const { page } = opened;
    const { frame } = entry;
    const [x, y] = [Math.floor(study.width / 3), Math.floor(study.height / 3)];
    await click(page, 'tr[data-variant]');
    await choose(page, '#frame-controls', 'Frame', String(frame));
    await waitForPanes(page, ['reference', variant.id]);
    await clickPixel(page, variant.id, x, y, study);
    const shown = await readWalk(page, x, y, variant.id, frame);
    assert.ok(Number.isFinite(shown['result.luminance']));
    const layers = { ...study.pictures.find(shared => shared.frame === frame).maps, ...entry.maps };
    let compared = 0;
    for (const [name, value] of Object.entries(shown)) {
      const layer = layers[name];
      if (!layer || layer.width !== study.width || layer.height !== study.height) continue;
      assert.equal(value, storedValue(layer, x, y), name);
      ++compared;
    }
    context.diagnostic(`${compared} stored values compared`);
    assert.ok(compared > 0 || !study.walk?.length);
  });

  it('logged no error, and asked for nothing', () => {
    assert.deepEqual(opened.troubles, []);
    assert.deepEqual(opened.outside(), []);
  });
});
