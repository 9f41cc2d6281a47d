// The pictures, and the values that the pixel walk shows of them.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { luminance } from '../src/luminance.js';
import { choose, click, clickPixel, readWalk, redraw, waitForPanes } from './browser.mjs';
import { all, id, openPage, size, study } from './fixture.mjs';
import { frames, storedValue } from './sample.mjs';

describe('pixel walk', () => {
  it('shows exactly what is stored', async () => {
    const page = await openPage();
    const variant = id(2, 'saliency');
    await click(page, `tr[data-variant="${variant}"]`);
    await waitForPanes(page, ['reference', variant]);
    for (const frame of frames) {
      await choose(page, '#frame-controls', 'Frame', String(frame));
      for (const [x, y] of [[0, 5], [17, 40], [90, 63]]) { // corners of the stage are round
        await clickPixel(page, variant, x, y, size);
        const shown = await readWalk(page, x, y, variant, frame);
        for (const [name, type] of [['threshold.Y', 'f32'], ['forward.u', 'f32'], ['velocity.image', 'f32'], ['aleph.Y', 'f16'], ['samples.Y', 'f16']]) {
          assert.equal(shown[name], storedValue(name, frame, 2, x, y, size, type), `${name} at ${x}, ${y}`);
        }
        assert.ok(!('not.stored' in shown));
        const error = shown['result.luminance'] - shown['result.reference'];
        assert.ok(Math.abs(shown['result.error'] - error) < 1e-9);
        assert.ok(Math.abs(shown['result.thresholds'] - Math.abs(error) / shown['threshold.Y']) < 1e-9);
        assert.equal(Object.keys(shown).filter(name => name.startsWith('band.')).length, 6);
      }
    }
  });

  it('follows the keyboard cursor', async () => {
    const page = await openPage();
    const variant = all[0];
    await page.focus('.stage');
    await page.keyboard.down('Shift');
    for (let i = 0; i < 3; ++i) await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowUp');
    await page.keyboard.up('Shift');
    await page.keyboard.press('Enter');
    const shown = await readWalk(page, 51, 31, variant, 20);
    assert.equal(shown['threshold.Y'], storedValue('threshold.Y', 20, 0.5, 51, 31, size));
  });

  it('finds the pixel under the pointer in a zoomed view', async () => {
    const page = await openPage();
    await page.focus('.stage');
    for (const key of ['+', '+', '+', 'ArrowRight', 'ArrowDown']) await page.keyboard.press(key);
    const canvas = await page.$('#panes canvas[data-pane="reference"]');
    await canvas.scrollIntoView();
    const box = await canvas.boundingBox();
    await page.mouse.click(box.x + 0.25 * box.width, box.y + 0.75 * box.height);
    const zoom = 1.5 ** 3; // three steps, then 0.15 of the view to the right and down
    const place = share => 0.5 + 0.15 / zoom + (share - 0.5) / zoom;
    const [x, y] = [Math.floor(96 * place(0.25)), Math.floor(64 * place(0.75))];
    const shown = await readWalk(page, x, y, all[0], 20);
    assert.equal(shown['threshold.Y'], storedValue('threshold.Y', 20, 0.5, x, y, size));
  });
});

describe('luminance', () => {
  it('is that which a display shows', () => {
    const values = [0.5, 2, 3, 0.5, 2, 0.5, 0.5, 2, 0.25]; // grey, white, orange
    const expected = [0.5, 1, 0.2126 + 0.5 * 0.7152 + 0.25 * 0.0722];
    luminance({ width: 3, height: 1, values }).forEach((value, i) => assert.ok(Math.abs(value - expected[i]) < 1e-6, `${i}: ${value}`));
  });
});

describe('pictures', () => {
  /** The colour of a pixel on the screen, at zoom 1. */
  const colorAt = (page, pane, x, y) => page.$eval(`#panes canvas[data-pane="${pane}"]`, (canvas, u, v) => {
    const copy = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
    copy.drawImage(canvas, -Math.floor(u * canvas.width), -Math.floor(v * canvas.height));
    return [...copy.getImageData(0, 0, 1, 1).data];
  }, (x + 0.5) / size.width, (y + 0.5) / size.height);

  it('are linear values encoded as sRGB, with exposure', async () => {
    const page = await openPage();
    const encode = linear => Math.round(255 * Math.min(1, linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
    const layer = study.pictures[0].reference;
    assert.equal(layer.type, 'f16');
    // The floor of the reference at the lower left: a grey of 0.25 or 0.4 with weights 0.9, 1, 1.1, and 0.02 more.
    const gray = (Math.floor(0.5 / 96 * 10) + Math.floor(60.5 / 64 * 10)) % 2 ? 0.4 : 0.25;
    for (const stops of [0, 1]) {
      if (stops) {
        await redraw(page, () => page.$eval('#frame-controls input[name="Exposure"]', node => {
          node.value = 1;
          node.dispatchEvent(new Event('input', { bubbles: true }));
        }));
      }
      const color = await colorAt(page, 'reference', 0, 60);
      [0.9, 1, 1.1].forEach((weight, channel) => {
        const wanted = encode((gray * weight + 0.02) * 2 ** stops);
        assert.ok(Math.abs(color[channel] - wanted) <= 1, `stops ${stops}, channel ${channel}: ${color[channel]}, not ${wanted}`);
      });
    }
  });

  it('count the pixels beyond one threshold', async () => {
    const page = await openPage();
    const counts = async variant => {
      await click(page, `tr[data-variant="${variant}"]`);
      await waitForPanes(page, ['reference', variant]);
      await page.waitForSelector('.beyond');
      return page.$eval('.beyond', node => Number(node.dataset.value));
    };
    await choose(page, '#frame-controls', 'Show', 'computed.thresholds');
    const [small, large] = [await counts(id(0.5, 'none')), await counts(id(2, 'none'))];
    await choose(page, '#frame-controls', 'Show', 'disagreement.colorvideovdp');
    await page.waitForSelector('.counts li');
    const kinds = await page.$$eval('.counts li', nodes => nodes.map(node => Number(node.dataset.value)));
    assert.equal(kinds[1] + kinds[2], large); // visible by our threshold, with the judge or without
    assert.ok(small < large);
  });

  it('count disagreement with a judge, pixel by pixel', async () => {
    const page = await openPage();
    const variant = id(2, 'saliency');
    await click(page, `tr[data-variant="${variant}"]`);
    await choose(page, '#frame-controls', 'Show', 'disagreement.colorvideovdp');
    await page.waitForSelector('.counts li');
    const counts = await page.$$eval('.counts li', nodes => nodes.map(node => Number(node.dataset.value)));
    assert.equal(counts.reduce((sum, count) => sum + count, 0), 96 * 64);
    let judged = 0;
    for (let y = 0; y < 64; ++y) for (let x = 0; x < 96; ++x) judged += storedValue('judge.colorvideovdp', 20, 2, x, y, size) > 1;
    assert.equal(counts[1] + counts[3], judged); // visible to the judge, with us or without
    assert.ok(counts[2] > 0 && counts[3] > 0);
  });

  it('show maps in colours of a legend whose ends can be changed', async () => {
    const page = await openPage();
    await choose(page, '#frame-controls', 'Show', 'aleph.Y');
    await page.waitForSelector('#legend:not([hidden]) input[name="high"]');
    assert.match(await page.$eval('#legend', node => node.textContent), /times/);
    const before = await colorAt(page, 'reference', 90, 60);
    await redraw(page, () => page.$eval('#legend input[name="high"]', node => {
      node.value = 10;
      node.dispatchEvent(new Event('change', { bubbles: true }));
    }));
    const clipped = await colorAt(page, 'reference', 90, 60);
    assert.notDeepEqual(clipped, before);
    assert.deepEqual(clipped.slice(0, 3), [253, 231, 37]); // the upper end of viridis
  });

  it('can be swiped with the keyboard', async () => {
    const page = await openPage();
    await click(page, 'input[value="swipe"]');
    await page.waitForSelector('.handle');
    await page.focus('.handle');
    await page.keyboard.press('Home');
    for (let i = 0; i < 5; ++i) await page.keyboard.press('ArrowRight');
    await page.waitForSelector('.handle[aria-valuenow="10"]');
    assert.match(await page.$eval('.stage canvas:nth-of-type(2)', node => node.style.clipPath), /10%/);
    await choose(page, '#frame-controls', 'B', id(1, 'none'));
    await waitForPanes(page, ['reference', id(1, 'none')]);
  });

  it('blink, but not where motion is to be reduced', async () => {
    for (const calm of [false, true]) {
      const page = await openPage({ calm });
      await click(page, 'input[value="blink"]');
      await page.waitForSelector('.stage[data-visible]');
      const changes = page.evaluate(stop => new Promise(resolve => {
        const observer = new MutationObserver(() => resolve('blinked'));
        observer.observe(document.querySelector('.stage'), { attributes: true, attributeFilter: ['data-visible'] });
        if (stop) setTimeout(() => resolve('stopped'), 1300);
      }), calm);
      assert.equal(await changes, calm ? 'stopped' : 'blinked');
    }
  });
});
