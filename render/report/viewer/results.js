// The results as sentences, charts and tables.
import { fill, make, makeTable } from '../src/dom.js';
import { fit, weibull, wilson } from './psychometric.js';
import { byLevel, summarize } from './trials.js';

const [width, height, left, bottom] = [600, 320, 110, 45];

function percent(share) {
  return `${(100 * share).toFixed(0)} %`;
}

function svg(tag, attributes, ...children) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, String(value));
  node.append(...children);
  return node;
}

/** Right answers against level, with intervals, the fitted function and chance. */
function drawChart({ levels, fitted, series }) {
  const log = levels.every(row => row.level > 0);
  const place = value => (log ? Math.log(value) : value);
  const ends = [place(levels[0].level), place(levels.at(-1).level)];
  const room = Math.max(1e-6, ends[1] - ends[0]) * 0.08;
  const x = value => left + (place(value) - ends[0] + room) / (ends[1] - ends[0] + 2 * room) * (width - left - 10);
  const y = share => 10 + (1 - share) * (height - bottom - 10);
  const text = (at, up, words, anchor = 'middle') => svg('text', { x: at, y: up, 'text-anchor': anchor }, words);
  const chart = svg('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': 'Right answers against level' });
  for (const share of [0, 0.25, 0.5, 0.75, 1]) {
    chart.append(svg('line', { x1: left, x2: width - 10, y1: y(share), y2: y(share), class: share === 0.5 ? 'chance' : 'rule' }),
      text(left - 6, y(share) + 4, share === 0.5 ? '50 % (guessing)' : percent(share), 'end'));
  }
  for (const { level: value, trials, correct } of levels) {
    const [low, high] = wilson(correct, trials);
    chart.append(svg('line', { x1: x(value), x2: x(value), y1: y(low), y2: y(high), class: 'bar' }),
      svg('circle', { cx: x(value), cy: y(correct / trials), r: 5, class: 'point' }), text(x(value), height - bottom + 16, String(value)));
  }
  if (fitted.scale) {
    const points = Array.from({ length: 81 }, (_, i) => {
      const at = ends[0] + (ends[1] - ends[0]) * i / 80;
      const value = log ? Math.exp(at) : at;
      return `${x(value)},${y(weibull(Math.max(value, 1e-9), fitted.scale, fitted.slope))}`;
    });
    chart.append(svg('polyline', { points: points.join(' '), class: 'curve' }));
  }
  chart.append(text((width + left) / 2, height - 4, `${series.title}${series.unit ? ` (${series.unit})` : ''}`));
  return chart;
}

function describeThreshold({ threshold, interval: [low, high] }) {
  const most = high === Infinity ? 'no limit' : high.toPrecision(3);
  return `${threshold.toPrecision(3)} (95 %: ${low ? low.toPrecision(3) : 0} to ${most})`;
}

/** Rows of all trials, and per series its levels and its function. @param {object[]} all results of viewers */
export function evaluate(all) {
  const rows = summarize(all.flatMap(results => results.trials));
  const series = new Map(all.flatMap(results => results.series).map(one => [one.id, one]));
  const functions = [...series.values()].map(one => ({ series: one, levels: byLevel(rows, one.id) }))
    .filter(({ levels }) => levels.length > 0)
    .map(found => ({ ...found, fitted: fit(found.levels) }));
  return { rows, functions };
}

/** A row per viewer: trials, and the threshold of each series. */
function drawViewers(all, functions) {
  const rows = all.map((results, i) => {
    const own = evaluate([results]);
    const cells = functions.map(({ series }) => {
      const found = own.functions.find(one => one.series.id === series.id);
      return found?.fitted.threshold ? describeThreshold(found.fitted) : '';
    });
    return { cells: [results.viewer || `viewer ${i + 1}`, results.trials.length, ...cells] };
  });
  return makeTable({}, [['viewer'], ['trials'], ...functions.map(({ series }) => [series.title])], rows);
}

/** @param {HTMLElement} node @param {object[]} all results, one or more */
export function drawResults(node, all) {
  const { rows, functions } = evaluate(all);
  const table = makeTable({}, [['test'], ['scene'], ['level'], ['trials'], ['right'], ['share'], ['95 %']], rows.map(row => ({
    'data-test': row.id, 'data-correct': row.correct, 'data-trials': row.trials,
    cells: [row.id, row.scene, row.level ?? '', row.trials, row.correct, percent(row.share), `${percent(row.interval[0])} to ${percent(row.interval[1])}`],
  })));
  const parts = functions.flatMap(({ series, levels, fitted }) => [
    make('p', { class: 'verdict' }, `${series.title}: ${fitted.reason ?? `right in 75 % of the trials at ${describeThreshold(fitted)} ${series.unit}.`}`),
    levels.length > 1 ? drawChart({ levels, fitted, series }) : null,
  ]);
  if (functions.length === 0) parts.push(make('p', { class: 'verdict' }, 'These tests have no levels: there is no function to fit.'));
  const dropped = all.reduce((sum, results) => sum + results.frames_dropped, 0);
  fill(node, ...parts, table,
    all.length > 1 ? make('p', {}, `${all.length} viewers, pooled. The interval is that of their answers together; it does not tell how much viewers differ.`) : null,
    all.length > 1 ? drawViewers(all, functions) : null,
    dropped ? make('p', {}, `${dropped} frames came too late and were not shown: close other programs, or take fewer pixels.`) : null);
}
