// Which trials are shown, and what the answers say.
import { randomFrom, wilson } from './psychometric.js';

/**
 * Every test as often as asked, in random order; in each trial the test is first or second at random.
 * @param {{id: string, level: ?number}[]} tests @param {number} each @param {number} seed
 */
export function makeTrials(tests, each, seed) {
  const random = randomFrom(seed);
  const trials = tests.flatMap(test => Array.from({ length: each }, () => ({ id: test.id, level: test.level })));
  for (let i = trials.length - 1; i > 0; --i) {
    const k = Math.floor(random() * (i + 1));
    [trials[i], trials[k]] = [trials[k], trials[i]];
  }
  return trials.map(trial => ({ ...trial, testInterval: random() < 0.5 ? 1 : 2 }));
}

/**
 * A row per test: trials, right answers, share with its interval.
 * @param {{id: string, level: ?number, testInterval: number, answer?: number}[]} trials
 */
export function summarize(trials) {
  const rows = new Map();
  for (const trial of trials) {
    if (trial.answer === undefined) continue;
    const row = rows.get(trial.id) ?? { id: trial.id, level: trial.level, trials: 0, correct: 0 };
    ++row.trials;
    row.correct += trial.answer === trial.testInterval ? 1 : 0;
    rows.set(trial.id, row);
  }
  return [...rows.values()]
    .map(row => ({ ...row, share: row.correct / row.trials, interval: wilson(row.correct, row.trials) }))
    .sort((a, b) => (a.level ?? Infinity) - (b.level ?? Infinity) || a.id.localeCompare(b.id));
}

/** Rows of one level together. */
export function byLevel(rows) {
  const levels = new Map();
  for (const { level, trials, correct } of rows) {
    if (level === null || level === undefined) continue;
    const sum = levels.get(level) ?? { level, trials: 0, correct: 0 };
    sum.trials += trials;
    sum.correct += correct;
    levels.set(level, sum);
  }
  return [...levels.values()].sort((a, b) => a.level - b.level);
}
