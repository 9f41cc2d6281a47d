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
 * @param {number} scale level at which 63 % of the differences are seen
 */
export function weibull(level, scale, slope) {
  return 0.5 + (0.5 - lapse) * (1 - Math.exp(-((level / scale) ** slope)));
}

/** The level at which 75 % of the answers are right, over the scale. */
export function thresholdOverScale(slope) {
  return (-Math.log(1 - 0.25 / (0.5 - lapse))) ** (1 / slope);
}

function logLikelihood(rows, scale, slope) {
  return rows.reduce((sum, { level, trials, correct }) => {
    const share = weibull(level, scale, slope);
    return sum + correct * Math.log(share) + (trials - correct) * Math.log(1 - share);
  }, 0);
}

/** Slopes that are tried: .3 to 10. */
const slopes = Array.from({ length: 71 }, (_, i) => 0.3 * (10 / 0.3) ** (i / 70));

/** The most likely function with this threshold. @param {number} log of the threshold */
function withThreshold(rows, log) {
  let best = { value: -Infinity };
  for (const slope of slopes) {
    const scale = Math.exp(log) / thresholdOverScale(slope);
    const value = logLikelihood(rows, scale, slope);
    if (value > best.value) best = { log, scale, slope, value };
  }
  return best;
}

/** The most likely function: its threshold on a grid that is refined three times. @param {[number, number]} ends logs */
function search(rows, ends) {
  let [centre, reach] = [(ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2];
  let best = { value: -Infinity };
  for (let round = 0; round < 4; ++round) {
    for (let i = -20; i <= 20; ++i) {
      const found = withThreshold(rows, Math.min(ends[1], Math.max(ends[0], centre + reach * i / 20)));
      if (found.value > best.value) best = found;
    }
    centre = best.log;
    reach /= 10;
  }
  return best;
}

/**
 * The limit of the thresholds that are as likely as the best but for so much, on one side.
 * @param {number} end log of the threshold, where the search ends @param {number} beyond where all of them are
 */
function limitTowards(rows, best, end, beyond) {
  // Twice the log-likelihood: 3.84 by Wilks 1938, which covers 93 to 95 % of simulated tests of 60 to 200 trials.
  const fits = log => 2 * (best.value - withThreshold(rows, log).value) <= 4.6;
  if (fits(end)) return beyond;
  let [inside, outside] = [best.log, end];
  for (let i = 0; i < 20; ++i) {
    const middle = (inside + outside) / 2;
    if (fits(middle)) inside = middle;
    else outside = middle;
  }
  return Math.exp(outside);
}

/**
 * Fits the function, and tells its threshold with a 95 % interval by the likelihood of thresholds (profile likelihood).
 * @param {{level: number, trials: number, correct: number}[]} rows
 * @returns {{scale: number, slope: number, threshold: number, interval: [number, number]} | {reason: string}} where the
 * answers do not limit the threshold, 0 and Infinity are its limits
 */
export function fit(rows) {
  const used = rows.filter(row => row.level > 0 && row.trials > 0);
  if (new Set(used.map(row => row.level)).size < 2) return { reason: 'A threshold needs answers at two levels or more.' };
  const trials = used.reduce((sum, row) => sum + row.trials, 0);
  const correct = used.reduce((sum, row) => sum + row.correct, 0);
  const levels = used.map(row => Math.log(row.level));
  const ends = [Math.min(...levels) - 3, Math.max(...levels) + 3];
  const best = search(used, ends);
  const chance = trials * Math.log(0.5);
  // Two more parameters: 6 is twice the log-likelihood that chance exceeds in 5 % of the cases.
  if (2 * (best.value - chance) < 6) return { reason: 'The answers are no better than guessing: no difference was seen.' };
  if (correct === trials) return { reason: 'All answers are right: the threshold lies below all levels.' };
  return {
    scale: best.scale, slope: best.slope, threshold: Math.exp(best.log),
    interval: [limitTowards(used, best, ends[0], 0), limitTowards(used, best, ends[1], Infinity)],
  };
}
