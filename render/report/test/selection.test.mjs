// The selection by chart and table, and what follows it.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { brushAll, choose, click, selectedRows, shownPanes, waitForPanes, waitForTooltip } from './browser.mjs';
import { all, id, openPage, size, study } from './fixture.mjs';
import { makeStudy } from './sample.mjs';

describe('selection', () => {
  it('begins with the ends of the front, and their frames are drawn', async () => {
    const page = await openPage();
    const first = [id(0.5, 'none'), id(2, 'saliency')];
    await waitForPanes(page, ['reference', ...first]);
    assert.deepEqual(await selectedRows(page), first);
    assert.deepEqual(await shownPanes(page), ['reference', ...first]);
  });

  it('follows a brush over the chart, and ends it when it is made elsewhere', async () => {
    const page = await openPage();
    await brushAll(page);
    await waitForPanes(page, ['reference', ...all]);
    assert.deepEqual(await selectedRows(page), all);
    const width = () => page.$eval('#chart .brush_brush path', node => node.getBoundingClientRect().width);
    assert.ok(await width() > 100);
    await click(page, `tr[data-variant="${all[2]}"]`);
    await waitForPanes(page, ['reference', all[2]]);
    assert.ok(await width() < 2);
  });

  it('takes only the points inside the brush', async () => {
    const page = await openPage();
    await page.evaluate(() => document.querySelector('#chart').scrollIntoView({ block: 'center' }));
    const box = await page.$eval('#chart svg .background', node => node.getBoundingClientRect().toJSON());
    // The left upper quarter holds the two variants with error 2: the fastest ones with the largest errors.
    await page.mouse.move(box.x + 2, box.y + 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.38, box.y + box.height * 0.3, { steps: 4 });
    await page.mouse.up();
    await waitForPanes(page, ['reference', id(2, 'none'), id(2, 'saliency')]);
  });

  it('follows a click on a point inside the brush, whose settings a tooltip shows', async () => {
    const page = await openPage();
    await brushAll(page);
    await waitForPanes(page, ['reference', ...all]);
    const point = await page.$$eval('#chart svg path[aria-roledescription="point"], #chart svg .mark-symbol path', nodes => {
      const { x, y, width, height } = nodes[2].getBoundingClientRect();
      return { x: x + width / 2, y: y + height / 2, data: nodes[2].__data__.datum.id };
    });
    const { error, guide } = study.variants.find(variant => variant.id === point.data).settings;
    await waitForTooltip(page, point, `error\\s+${error}\\s+guide\\s+${guide}`);
    await page.mouse.click(point.x, point.y);
    await waitForPanes(page, ['reference', point.data]);
  });

  it('works in the table with the keyboard alone', async () => {
    const page = await openPage();
    await page.focus('tr[data-variant]');
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Enter');
    await waitForPanes(page, ['reference', all[1]]);
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Space');
    await waitForPanes(page, ['reference', all[1], all[2]]);
    assert.match(await page.$eval('#live', node => node.textContent), /2 of 6 selected/);
    await page.keyboard.press('Space');
    await waitForPanes(page, ['reference', all[1]]);
  });
});

describe('table', () => {
  it('names variants that are none of the sweep', async () => {
    const data = makeStudy(size);
    Object.assign(data.study.variants[1], { id: 'fixed 3', settings: { error: 0, spp: 8 } });
    Object.assign(data.study.variants[2], { id: 'old', settings: { error: 1, guide: 'none' } });
    const page = await openPage({}, data);
    const names = await page.$$eval('td[data-column="variant"]', nodes => nodes.map(node => node.textContent.replace('front', '')));
    assert.deepEqual(names.slice(0, 4), ['error 0.5, guide none', 'fixed 3', 'old', 'error 1, guide saliency']);
    await click(page, 'tr[data-variant="fixed 3"]');
    assert.match(await page.$eval('#selection', node => node.textContent), /1 of 6 selected: fixed 3$/);
    const swept = await openPage();
    assert.equal(await swept.$('td[data-column="variant"]'), null, 'its settings name each');
  });

  it('sorts by a metric, both ways', async () => {
    const page = await openPage();
    const seconds = () => page.$$eval('td[data-column="metric:processor_seconds"]', nodes => nodes.map(node => Number(node.dataset.value)));
    const wanted = study.variants.map(variant => variant.metrics.processor_seconds.value).sort((a, b) => a - b);
    await click(page, 'button[data-sort="metric:processor_seconds"]');
    assert.deepEqual(await seconds(), wanted);
    await click(page, 'button[data-sort="metric:processor_seconds"]');
    assert.deepEqual(await seconds(), wanted.reverse());
  });

  it('is saved as CSV with full precision', async () => {
    const page = await openPage();
    const text = await page.evaluate(async () => {
      const make = URL.createObjectURL;
      const blobs = [];
      URL.createObjectURL = blob => { blobs.push(blob); return make(blob); };
      [...document.querySelectorAll('#table-buttons button')].find(node => /CSV/.test(node.textContent)).click();
      return blobs[0].text();
    });
    const lines = text.trim().split('\r\n');
    assert.equal(lines.length, 7);
    const { value, error } = study.variants[3].metrics.share_beyond;
    assert.ok(lines[4].startsWith('"error=1,guide=saliency",1,saliency,'));
    assert.ok(lines[4].includes(`,${value},${error},`), lines[4]);
  });
});

describe('other parts', () => {
  it('show the bars of time and rays, and the plan', async () => {
    const page = await openPage();
    await click(page, `tr[data-variant="${all[3]}"]`);
    await page.waitForFunction(key => document.querySelector('#bars').dataset.drawn === key, {}, all[3]);
    assert.ok(await page.$$eval('#bars svg .mark-rect path', nodes => nodes.length) >= 2 * (5 + 3));
    assert.match(await page.$eval('[data-effect="depth_of_field"]', node => node.textContent), /left out.*<b>/);
  });

  it('show what each effect costs', async () => {
    const page = await openPage();
    const row = name => page.$eval(`[data-ledger="${name}"]`, node => [...node.children].map(cell => cell.textContent));
    assert.deepEqual(await row('area_shadows'), ['area shadows', 'simulate', '0.25 ± 0.02', '41', '0']);
    assert.deepEqual(await row('refraction'), ['refraction', 'skip', '–', '–', 'not known']);
    assert.match(await page.$eval('#ledger caption', node => node.textContent), /^sample: 1.5 ± 0.1 s/);
  });

  it('change the axes, and the front with them', async () => {
    const page = await openPage();
    await choose(page, '#chart-controls', 'Vertical axis', 'relative_mse');
    await page.waitForFunction(() => /relative mean squared error/.test(document.querySelector('#results-title').textContent)
      || /relative mean squared error/.test(document.querySelector('#chart svg').textContent));
    assert.equal(await page.$eval('#chart-note', node => node.textContent), '');
    await choose(page, '#chart-controls', 'Vertical axis', 'seed_flicker');
    await page.waitForFunction(() => /6 variants have no value/.test(document.querySelector('#chart-note').textContent));
  });
});
