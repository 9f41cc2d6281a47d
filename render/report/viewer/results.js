// The results as a table, a chart and sentences.
import { fill, make } from '../src/dom.js';
import { weibull, wilson } from './psychometric.js';

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
function drawChart({ levels, fitted, level }) {
  const log = level?.log && levels.every(row => row.level > 0);
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
  chart.append(text((width + left) / 2, height - 4, `${level?.title ?? 'level'}${level?.unit ? ` (${level.unit})` : ''}`));
  return chart;
}

/** @param {HTMLElement} node @param {{rows: object[], levels: object[], fitted: object, level: ?object, dropped: number}} results */
export function drawResults(node, { rows, levels, fitted, level, dropped }) {
  const head = make('tr', {}, ...['test', 'level', 'trials', 'right', 'share', '95 %'].map(name => make('th', { scope: 'col' }, name)));
  const body = rows.map(row => make('tr', { 'data-test': row.id, 'data-correct': row.correct, 'data-trials': row.trials },
    make('th', { scope: 'row' }, row.id), make('td', {}, row.level ?? ''), make('td', {}, row.trials), make('td', {}, row.correct),
    make('td', {}, percent(row.share)), make('td', {}, `${percent(row.interval[0])} to ${percent(row.interval[1])}`)));
  const sentence = fitted.reason ?? `Right in 75 % of the trials at ${fitted.threshold.toPrecision(3)} ${level?.unit ?? ''} `
    + `(95 %: ${fitted.interval.map(value => value.toPrecision(3)).join(' to ')}).`;
  fill(node, make('p', { id: 'verdict' }, sentence), make('table', {}, make('thead', {}, head), make('tbody', {}, ...body)),
    levels.length > 1 ? drawChart({ levels, fitted, level }) : null,
    dropped ? make('p', {}, `${dropped} frames came too late and were not shown: close other programs, or take fewer pixels.`) : null);
}
