// Which trials are shown, and what the answers of one viewer or several say.
import { randomFrom, wilson } from './psychometric.js';

/** @typedef {{scene: string, id: string, series: ?string, level: ?number}} Test */
/** @typedef {Test & {testInterval: number, answer?: number}} Trial */

/** Every test as often as asked, in random order; in each trial the test is first or second at random. @returns {Trial[]} */
export function makeTrials(tests, each, seed) {
  const random = randomFrom(seed);
  const trials = tests.flatMap(({ scene, id, series, level }) => Array.from({ length: each }, () => ({ scene, id, series, level })));
  for (let i = trials.length - 1; i > 0; --i) {
    const k = Math.floor(random() * (i + 1));
    [trials[i], trials[k]] = [trials[k], trials[i]];
  }
  return trials.map(trial => ({ ...trial, testInterval: random() < 0.5 ? 1 : 2 }));
}

/** A row per test: trials, right answers, share with its interval. @param {Trial[]} trials */
export function summarize(trials) {
  const rows = new Map();
  for (const { scene, id, series, level, testInterval, answer } of trials) {
    if (answer === undefined) continue;
    const key = JSON.stringify([scene, id]);
    const row = rows.get(key) ?? { scene, id, series, level, trials: 0, correct: 0 };
    ++row.trials;
    row.correct += answer === testInterval ? 1 : 0;
    rows.set(key, row);
  }
  return [...rows.values()]
    .map(row => ({ ...row, share: row.correct / row.trials, interval: wilson(row.correct, row.trials) }))
    .sort((a, b) => a.scene.localeCompare(b.scene) || (a.level ?? Infinity) - (b.level ?? Infinity) || a.id.localeCompare(b.id));
}

/** Rows of one level together, of all scenes. @param {?string} series of the levels */
export function byLevel(rows, series) {
  const levels = new Map();
  for (const { series: own, level, trials, correct } of rows) {
    if (own !== series || level === null || level === undefined) continue;
    const sum = levels.get(level) ?? { level, trials: 0, correct: 0 };
    sum.trials += trials;
    sum.correct += correct;
    levels.set(level, sum);
  }
  return [...levels.values()].sort((a, b) => a.level - b.level);
}

function isTrial(trial) {
  const isText = value => typeof value === 'string';
  return trial && isText(trial.scene) && isText(trial.id) && (trial.series === null || isText(trial.series))
    && (trial.level === null || Number.isFinite(trial.level)) && [1, 2].includes(trial.testInterval) && [1, 2].includes(trial.answer);
}

/** Results that were saved, checked. @throws Error saying what is wrong */
export function readResults(text) {
  const results = JSON.parse(text);
  if (results?.schema_version !== 2 || !Array.isArray(results.trials) || !Array.isArray(results.series)) throw new Error('it has no results of this test');
  const wrong = results.trials.findIndex(trial => !isTrial(trial));
  if (wrong >= 0) throw new Error(`trial ${wrong + 1} has no scene, test or answer`);
  return results;
}

/** Results without those that are there twice. */
export function withoutCopies(all) {
  const seen = new Set();
  return all.filter(({ made, trials }) => {
    const key = JSON.stringify([made, trials]);
    return !seen.has(key) && seen.add(key);
  });
}
