// The viewer test: its statistics with simulated viewers, its geometry, and the whole way by keyboard.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { describe, it } from 'node:test';
import { distanceForOne, pixelsPerDegree, scaleFor } from '../viewer/geometry.js';
import { fit, randomFrom, thresholdOverScale, weibull, wilson } from '../viewer/psychometric.js';
import { dimmedValues, shareOf } from '../viewer/brightness.js';
import { evaluate } from '../viewer/results.js';
import { byLevel, makeTrials, readResults, summarize, withoutCopies } from '../viewer/trials.js';
import { folder, openText } from './fixture.mjs';

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

  /** Results of such a viewer, as the page saves them. */
  function answersOf(seen, scale, slope, trials, seed) {
    const random = randomFrom(seed);
    const tests = seen.map(level => ({ scene: 'pool', id: `noise=${level}`, series: 'noise', level }));
    const answered = makeTrials(tests, trials, seed).map(trial =>
      ({ ...trial, answer: random() < weibull(trial.level, scale, slope) ? trial.testInterval : 3 - trial.testInterval }));
    return { schema_version: 2, made: String(seed), series: [{ id: 'noise', title: 'noise', unit: '' }], frames_dropped: 0, trials: answered };
  }

  it('finds the threshold of simulated viewers', () => {
    for (const [scale, slope, seed] of [[2, 2, 1], [1, 3, 2], [4, 1.5, 3]]) {
      const found = fit(observe(scale, slope, 400, seed));
      const truth = scale * thresholdOverScale(slope);
      assert.ok(Math.abs(found.threshold / truth - 1) < 0.15, `${found.threshold} for ${truth}`);
      assert.ok(found.interval[0] < truth && truth < found.interval[1], `${found.interval} around ${truth}`);
    }
    assert.ok(Math.abs(weibull(2 * thresholdOverScale(2), 2, 2) - 0.75) < 1e-12);
  });

  it('covers the threshold of simulated viewers as often as it says', () => {
    const viewers = 3; // whose answers are pooled
    for (const [seen, scale, slope, trials] of [[[0.5, 1, 2], 1, 2, 60], [[0.5, 1, 2, 4], 1.5, 3, 21], [levels, 1, 1, 39]]) {
      const truth = scale * thresholdOverScale(slope);
      let covered = 0;
      for (let test = 0; test < 120; ++test) {
        const all = Array.from({ length: viewers }, (_, i) => answersOf(seen, scale, slope, trials / viewers, 7919 * (viewers * test + i) + 13));
        const { interval } = evaluate(all).functions[0].fitted;
        covered += interval[0] <= truth && truth <= interval[1] ? 1 : 0;
      }
      assert.ok(covered >= 0.95 * 120, `${covered} of 120 for a scale of ${scale}`);
    }
  });

  it('says that answers do not limit a threshold', () => {
    const { interval } = fit([{ level: 1, trials: 20, correct: 11 }, { level: 2, trials: 20, correct: 16 }]);
    assert.equal(interval[1], Infinity);
    const low = fit([{ level: 1, trials: 20, correct: 19 }, { level: 2, trials: 20, correct: 20 }]);
    assert.equal(low.interval[0], 0);
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
    const tests = levels.map(level => ({ scene: 'pool', id: `error=${level}`, series: 'error', level }));
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
    assert.equal(byLevel([...rows, { ...rows[0], scene: 'other' }], 'error')[0].trials, 200);
    assert.deepEqual(byLevel(rows, 'noise'), []);
  });

  it('pools results of viewers, each once, and refuses what is none', () => {
    const [one, other] = [answersOf(levels, 2, 2, 10, 1), answersOf(levels, 2, 2, 10, 2)];
    const text = JSON.stringify(one);
    assert.deepEqual(readResults(text), one);
    assert.equal(withoutCopies([one, readResults(text), other]).length, 2);
    const { rows, functions } = evaluate([one, other]);
    assert.deepEqual(rows.map(row => row.trials), [20, 20, 20, 20, 20]);
    assert.equal(functions.length, 1);
    const scenes = evaluate([one, { ...other, trials: other.trials.map(trial => ({ ...trial, scene: 'hall' })) }]);
    assert.equal(scenes.rows.length, 10);
    assert.deepEqual(scenes.functions, functions, 'scenes are pooled by level');
    for (const wrong of ['{', '[]', '{}', JSON.stringify({ ...one, schema_version: 1 }), JSON.stringify({ ...one, trials: [{ ...one.trials[0], answer: 3 }] })])
      assert.throws(() => readResults(wrong), wrong);
  });

  it('shows pictures as bright as they were made for', () => {
    assert.equal(shareOf(100, 400), 0.25);
    assert.equal(shareOf(100, 80), 1);
    const values = dimmedValues(0.25);
    assert.deepEqual([...dimmedValues(1)], Array.from({ length: 256 }, (_, value) => value));
    assert.equal(values[255], 137); // sRGB of .25
    assert.equal(values[188], 99); // of .503 / 4
    assert.equal(values[0], 0);
  });

  it('knows how large a degree is', () => {
    assert.ok(Math.abs(pixelsPerDegree(0.25, 573) - 40) < 0.02); // 1 cm at 57.3 cm
    assert.ok(Math.abs(scaleFor(31, 0.25, distanceForOne(31, 0.25)) - 1) < 1e-12);
  });
});

/** A picture of one grey, as a data URI. */
function greyPicture(value, size) {
  const shape = `<svg xmlns="http://www.w3.org/2000/svg" width="${size}" height="${size}"><rect width="100%" height="100%" fill="rgb(${value},${value},${value})"/></svg>`;
  return `data:image/svg+xml,${encodeURIComponent(shape)}`;
}

describe('the viewer test', () => {
  const template = fs.readFileSync(path.join(process.env.BUILD, 'viewer-template.html'), 'utf8');
  const frames = value => Array.from({ length: 4 }, () => greyPicture(value, 8));
  const scene = name => ({
    name, frames_per_second: 30, pixels_per_degree: 31, display_white: 100, reference: frames(100),
    tests: [{ id: 'error=1', series: 'error', level: 1, frames: frames(101) }, { id: 'error=8', series: 'error', level: 8, frames: frames(200) }],
  });
  const json = JSON.stringify({
    schema_version: 2, title: 'A small <test>', date: '', width: 8, height: 8,
    series: [{ id: 'error', title: 'asked error', unit: 'visible thresholds' }], scenes: [scene('hall'), scene('pool')],
  }).replaceAll('<', '\\u003c');

  it('goes from set-up to results by keyboard', async () => {
    const page = await openText(template.replace('<!-- TEST DATA -->', () => `<script id="test" type="application/json">${json}</script>`));
    assert.equal(await page.$eval('#title', node => node.textContent), 'A small <test>');
    const size = () => page.$eval('#size', node => node.textContent);
    const enter = (id, value) => page.$eval(id, (node, text) => {
      node.value = text;
      node.dispatchEvent(new Event('input'));
    }, value);
    assert.match(await size(), /pixels wide: 31 of their pixels to a degree.*white of 100 cd/);
    assert.doesNotMatch(await size(), /scaled|brighter/);
    await enter('#distance', '94');
    assert.match(await size(), /scaled by 2.00.*sit 47 cm/);
    await enter('#white', '400');
    assert.match(await size(), /brighter.*25 %/);
    await enter('#white', '50');
    assert.match(await size(), /display_white=50/);
    await enter('#white', '400');
    await enter('#viewer', 'anna');
    await page.$eval('#each', node => { node.value = '1'; });
    await page.$eval('#practice', node => { node.checked = false; });
    await page.focus('#begin');
    await page.keyboard.press('Enter');
    for (let i = 0; i < 4; ++i) {
      await page.waitForFunction(number => document.querySelector('#progress').textContent.startsWith(`Trial ${number} `)
        && !document.querySelector('#answer-1').disabled, {}, i + 1);
      if (i === 0) {
        const grey = await page.$eval('#screen', node => node.getContext('2d').getImageData(8, 8, 1, 1).data[0]);
        assert.equal(grey, 99, 'half of a quarter of the luminance');
      }
      await page.keyboard.press(i % 2 ? '1' : '2');
    }
    await page.waitForSelector('#results:not([hidden])');
    const results = JSON.parse(await page.$eval('#results', node => node.dataset.results));
    assert.deepEqual(results.trials.map(trial => trial.answer), [2, 1, 2, 1]);
    assert.equal(results.rows.reduce((sum, row) => sum + row.trials, 0), 4);
    for (const row of results.rows) {
      const shown = await page.$$eval(`tr[data-test="${row.id}"]`, (nodes, scene) =>
        Number(nodes.find(node => node.children[1].textContent === scene).dataset.correct), row.scene);
      assert.equal(shown, results.trials.filter(trial => trial.id === row.id && trial.scene === row.scene && trial.answer === trial.testInterval).length);
    }
    assert.equal(results.viewer, 'anna');
    assert.ok(await page.$eval('.verdict', node => node.textContent.length > 0));

    const saved = ['one', 'other', 'copy'].map((name, i) => path.join(folder, `viewer-results-${name}.json`));
    saved.forEach((name, i) => fs.writeFileSync(name, JSON.stringify({ ...results, viewer: `viewer <${i % 2}>`, made: String(i % 2) })));
    const input = await page.$('#load');
    await input.uploadFile(...saved);
    await page.waitForFunction(() => document.querySelector('#results-body').textContent.includes('2 viewers, pooled'));
    const pooled = JSON.parse(await page.$eval('#results', node => node.dataset.results));
    assert.deepEqual(pooled.rows.map(row => row.trials), [2, 2, 2, 2]);
    assert.match(await page.$eval('#results-body', node => node.textContent), /viewer <1>/);
    assert.equal(await page.$('#save'), null, 'what was loaded is saved already');
    fs.writeFileSync(saved[2], '{}');
    await input.uploadFile(saved[2]);
    await page.waitForFunction(() => document.querySelector('#size').textContent.includes('viewer-results-copy.json could not be read'));
  });

  it('says so where it has no data', async () => {
    const page = await openText(template);
    assert.match(await page.$eval('#size', node => node.textContent), /no data/);
  });
});
