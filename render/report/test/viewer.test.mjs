// The viewer test: its statistics with simulated viewers, its geometry, and the whole way by keyboard.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import zlib from 'node:zlib';
import { after, before, describe, it } from 'node:test';
import { distanceForOne, pixelsPerDegree, scaleFor } from '../viewer/geometry.js';
import { fit, randomFrom, thresholdOf, weibull, wilson } from '../viewer/psychometric.js';
import { byLevel, makeTrials, summarize } from '../viewer/trials.js';
import { launch, open } from './browser.mjs';

const build = process.env.BUILD ?? '.';

describe('statistics of the viewer test', () => {
  const levels = [0.5, 1, 2, 4, 8];

  /** Answers of a viewer with a known function. */
  function observe(scale, slope, trials, seed) {
    const random = randomFrom(seed);
    return levels.map(level => {
      let correct = 0;
      for (let i = 0; i < trials; ++i) correct += random() < weibull(level, scale, slope) ? 1 : 0;
      return { level, trials, correct };
    });
  }

  it('finds the threshold of simulated viewers', () => {
    for (const [scale, slope, seed] of [[2, 2, 1], [1, 3, 2], [4, 1.5, 3]]) {
      const found = fit(observe(scale, slope, 400, seed));
      const truth = thresholdOf({ scale, slope });
      assert.ok(Math.abs(found.threshold / truth - 1) < 0.15, `${found.threshold} for ${truth}`);
      assert.ok(found.interval[0] < truth && truth < found.interval[1], `${found.interval} around ${truth}`);
    }
    assert.ok(Math.abs(weibull(thresholdOf({ scale: 2, slope: 2 }), 2, 2) - 0.75) < 1e-12);
  });

  it('says where no threshold can be told', () => {
    assert.match(fit(levels.map(level => ({ level, trials: 40, correct: 40 }))).reason, /below all levels/);
    assert.match(fit(levels.map(level => ({ level, trials: 40, correct: 20 }))).reason, /guessing/);
    assert.match(fit([{ level: 1, trials: 40, correct: 30 }]).reason, /two levels/);
    assert.match(fit([]).reason, /two levels/);
  });

  it('knows the interval of a share', () => {
    const [low, high] = wilson(8, 10); // Wilson 1927: .490 to .943
    assert.ok(Math.abs(low - 0.4902) < 5e-4 && Math.abs(high - 0.9433) < 5e-4);
    assert.deepEqual(wilson(0, 0), [0, 1]);
  });

  it('makes balanced trials that the seed repeats', () => {
    const tests = levels.map(level => ({ id: `error=${level}`, level }));
    const trials = makeTrials(tests, 100, 7);
    assert.equal(trials.length, 500);
    assert.deepEqual(trials, makeTrials(tests, 100, 7));
    assert.notDeepEqual(trials, makeTrials(tests, 100, 8));
    const first = trials.filter(trial => trial.testInterval === 1).length;
    assert.ok(first > 200 && first < 300);
    for (const trial of trials) trial.answer = trial.level > 1 ? trial.testInterval : 1;
    const rows = summarize(trials);
    assert.deepEqual(rows.map(row => row.level), levels);
    assert.equal(rows[4].share, 1);
    assert.ok(rows[0].share > 0.3 && rows[0].share < 0.7);
    assert.equal(byLevel([...rows, { ...rows[0], id: 'other' }])[0].trials, 200);
  });

  it('knows how large a degree is', () => {
    assert.ok(Math.abs(pixelsPerDegree(0.25, 573) - 40) < 0.02); // 1 cm at 57.3 cm
    assert.ok(Math.abs(scaleFor(31, 0.25, distanceForOne(31, 0.25)) - 1) < 1e-12);
  });
});

/** A PNG of one grey, as a data URI. */
function greyPicture(value, size) {
  const chunk = (name, body) => {
    const data = Buffer.concat([Buffer.from(name), body]);
    const out = Buffer.alloc(body.length + 12);
    out.writeUInt32BE(body.length, 0);
    data.copy(out, 4);
    const packed = zlib.gzipSync(data); // its trailer has the same checksum
    out.writeUInt32BE(packed.readUInt32LE(packed.length - 8), body.length + 8);
    return out;
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(size, 0);
  head.writeUInt32BE(size, 4);
  head.writeUInt8(8, 8);
  const rows = Buffer.concat(Array.from({ length: size }, () => Buffer.concat([Buffer.from([0]), Buffer.alloc(size, value)])));
  const file = Buffer.concat([Buffer.from('89504e470d0a1a0a', 'hex'), chunk('IHDR', head), chunk('IDAT', zlib.deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
  return `data:image/png;base64,${file.toString('base64')}`;
}

describe('the viewer test', () => {
  let browser;
  let file;
  before(async () => {
    browser = await launch();
    const frames = value => Array.from({ length: 4 }, () => greyPicture(value, 8));
    const test = {
      schema_version: 1, title: 'A small <test>', date: '', width: 8, height: 8, frames_per_second: 30, pixels_per_degree: 31,
      level: { title: 'error', unit: 'visible thresholds', log: true }, reference: { frames: frames(100) },
      tests: [{ id: 'error=1', level: 1, frames: frames(101) }, { id: 'error=8', level: 8, frames: frames(200) }],
    };
    const template = fs.readFileSync(path.join(build, 'viewer-template.html'), 'utf8');
    const json = JSON.stringify(test).replaceAll('<', '\\u003c');
    file = path.join(build, 'viewer-sample.html');
    fs.writeFileSync(file, template.replace('<!-- TEST DATA -->', () => `<script id="test" type="application/json">${json}</script>`));
  });
  after(() => browser?.close());

  it('goes from set-up to results by keyboard', async () => {
    const { page, troubles, outside } = await open(browser, file);
    assert.equal(await page.$eval('#title', node => node.textContent), 'A small <test>');
    assert.match(await page.$eval('#size', node => node.textContent), /pixels wide: 31 of their pixels to a degree/);
    await page.$eval('#each', node => { node.value = '2'; });
    await page.$eval('#practice', node => { node.checked = false; });
    await page.focus('#begin');
    await page.keyboard.press('Enter');
    for (let i = 0; i < 4; ++i) {
      await page.waitForFunction(number => document.querySelector('#progress').textContent.startsWith(`Trial ${number} `)
        && !document.querySelector('#answer-1').disabled, {}, i + 1);
      await page.keyboard.press(i % 2 ? '1' : '2');
    }
    await page.waitForSelector('#results:not([hidden])');
    const results = JSON.parse(await page.$eval('#results', node => node.dataset.results));
    assert.deepEqual(results.trials.map(trial => trial.answer), [2, 1, 2, 1]);
    assert.equal(results.rows.reduce((sum, row) => sum + row.trials, 0), 4);
    for (const row of results.rows) {
      const shown = await page.$eval(`tr[data-test="${row.id}"]`, node => Number(node.dataset.correct));
      assert.equal(shown, results.trials.filter(trial => trial.id === row.id && trial.answer === trial.testInterval).length);
    }
    assert.ok(await page.$eval('#verdict', node => node.textContent.length > 0));
    assert.deepEqual(troubles, []);
    assert.deepEqual(outside(), []);
    await page.close();
  });

  it('says so where it has no data', async () => {
    const { page, troubles } = await open(browser, path.join(build, 'viewer-template.html'));
    assert.match(await page.$eval('#size', node => node.textContent), /no data/);
    assert.deepEqual(troubles, []);
    await page.close();
  });
});
