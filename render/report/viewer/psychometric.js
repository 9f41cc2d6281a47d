// Statistics of a two-interval forced choice: shares with their uncertainty, and a psychometric function.

/** A generator of numbers in [0, 1) from a seed (mulberry32). @param {number} seed */
export function randomFrom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ state >>> 15, 1 | state);
    mixed = mixed + Math.imul(mixed ^ mixed >>> 7, 61 | mixed) ^ mixed;
    return ((mixed ^ mixed >>> 14) >>> 0) / 4294967296;
  };
}

/** Wilson's interval of a share at 95 %. @param {number} correct @param {number} trials @returns {[number, number]} */
export function wilson(correct, trials) {
  if (!trials) return [0, 1];
  const z = 1.96;
  const share = correct / trials;
  const middle = share + z * z / (2 * trials);
  const half = z * Math.sqrt(share * (1 - share) / trials + z * z / (4 * trials * trials));
  const scale = 1 + z * z / trials;
  return [Math.max(0, (middle - half) / scale), Math.min(1, (middle + half) / scale)];
}

/** Share of viewers who are right by attention lapses alone in wrong answers. */
const lapse = 0.02;

/**
 * Probability of a right answer: guessing gives .5 (Weibull 1951, with a fixed rate of lapses).
 * @param {number} level above 0 @param {number} scale level at which 63 % of the differences are seen @param {number} slope
 */
export function weibull(level, scale, slope) {
  return 0.5 + (0.5 - lapse) * (1 - Math.exp(-((level / scale) ** slope)));
}

/** The level at which 75 % of the answers are right. */
export function thresholdOf({ scale, slope }) {
  return scale * (-Math.log(1 - 0.25 / (0.5 - lapse))) ** (1 / slope);
}

function logLikelihood(rows, scale, slope) {
  return rows.reduce((sum, { level, trials, correct }) => {
    const share = weibull(level, scale, slope);
    return sum + correct * Math.log(share) + (trials - correct) * Math.log(1 - share);
  }, 0);
}

/**
 * The most likely function on a grid that is refined three times.
 * @param {{level: number, trials: number, correct: number}[]} rows levels above 0
 */
function search(rows) {
  const levels = rows.map(row => row.level);
  let centre = { log: Math.log(Math.sqrt(Math.min(...levels) * Math.max(...levels))), slope: Math.log(2) };
  let reach = { log: Math.log(Math.max(...levels) / Math.min(...levels)) + 2, slope: Math.log(4) };
  let best = { value: -Infinity };
  for (let round = 0; round < 4; ++round) {
    for (let i = -10; i <= 10; ++i) {
      for (let k = -10; k <= 10; ++k) {
        const log = centre.log + reach.log * i / 10;
        const slope = Math.min(Math.log(10), Math.max(Math.log(0.3), centre.slope + reach.slope * k / 10));
        const value = logLikelihood(rows, Math.exp(log), Math.exp(slope));
        if (value > best.value) best = { value, log, slope };
      }
    }
    centre = best;
    reach = { log: reach.log / 5, slope: reach.slope / 5 };
  }
  return { scale: Math.exp(best.log), slope: Math.exp(best.slope), value: best.value };
}

/**
 * Fits the function, and tells its threshold with a 95 % interval from 200 parametric bootstraps.
 * @param {{level: number, trials: number, correct: number}[]} rows
 * @param {number} [seed]
 * @returns {{scale: number, slope: number, threshold: number, interval: [number, number]} | {reason: string}}
 */
export function fit(rows, seed = 1) {
  const used = rows.filter(row => row.level > 0 && row.trials > 0);
  if (new Set(used.map(row => row.level)).size < 2) return { reason: 'A threshold needs answers at two levels or more.' };
  const trials = used.reduce((sum, row) => sum + row.trials, 0);
  const correct = used.reduce((sum, row) => sum + row.correct, 0);
  const found = search(used);
  const chance = trials * Math.log(0.5);
  // Two more parameters: 6 is twice the log-likelihood that chance exceeds in 5 % of the cases.
  if (2 * (found.value - chance) < 6) return { reason: 'The answers are no better than guessing: no difference was seen.' };
  if (correct === trials) return { reason: 'All answers are right: the threshold lies below all levels.' };
  const random = randomFrom(seed);
  const thresholds = [];
  for (let i = 0; i < 200; ++i) {
    const again = used.map(({ level, trials: count }) => {
      const share = weibull(level, found.scale, found.slope);
      let right = 0;
      for (let k = 0; k < count; ++k) right += random() < share ? 1 : 0;
      return { level, trials: count, correct: right };
    });
    thresholds.push(thresholdOf(search(again)));
  }
  thresholds.sort((a, b) => a - b);
  return { ...found, threshold: thresholdOf(found), interval: [thresholds[5], thresholds[194]] };
}
