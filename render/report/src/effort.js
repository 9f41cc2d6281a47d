// Bars of time by stage and of rays by kind, for each frame of the selected variants.
import { byId, fill, make } from './dom.js';
import { findVariant } from './study.js';
import { drawChart, onResize } from './vega_view.js';

const charts = [
  { list: 'stages', part: 'stage', amount: 'seconds', title: 'Time by stage', axis: 'seconds', format: '~g' },
  { list: 'rays', part: 'kind', amount: 'count', title: 'Rays by kind', axis: 'rays', format: '~s' },
];

/** @param {object} study @param {object} store */
export function showEffort(study, store) {
  const holder = byId('bars');
  const nodes = charts.map(chart => make('figure', { class: 'chart', role: 'img', 'aria-label': `${chart.title}, for each frame of the selected variants` }));
  fill(holder, ...nodes, make('div', { class: 'tables' }));

  const draw = async () => {
    for (const [i, chart] of charts.entries()) {
      const rows = rowsOf(study, store.values.selected, chart);
      nodes[i].hidden = rows.length === 0;
      if (rows.length > 0) await drawChart(nodes[i], specOf(chart, rows, nodes[i].clientWidth));
    }
    fill(holder.lastChild, ...charts.map(chart => tableOf(chart, rowsOf(study, store.values.selected, chart))));
    holder.dataset.drawn = store.values.selected.join('|');
  };
  let queue = Promise.resolve();
  const report = () => { queue = queue.then(draw); };
  store.on(['selected'], report);
  onResize(holder, report);
  report();
  return queue;
}

function rowsOf(study, ids, chart) {
  return ids.map(id => findVariant(study, id)).flatMap(variant => variant.frames.flatMap(entry =>
    (entry[chart.list] ?? []).map((part, order) => ({
      bar: `${variant.label}\nframe ${entry.frame}`, part: part[chart.part], amount: part[chart.amount], order,
    }))));
}

function specOf(chart, rows, width) {
  const narrow = width < 520;
  const parts = [...new Set(rows.map(row => row.part))];
  return {
    width, height: 38 * new Set(rows.map(row => row.bar)).size, autosize: { type: 'fit-x', contains: 'padding' },
    title: chart.title,
    data: { values: rows },
    mark: { type: 'bar', tooltip: true, height: { band: 0.72 } },
    encoding: {
      y: { field: 'bar', type: 'nominal', sort: null, title: null, axis: { labelExpr: `split(datum.label, '\\n')`, labelLimit: narrow ? 130 : 260, labelLineHeight: 14, ticks: false, domain: false } },
      x: { field: 'amount', type: 'quantitative', aggregate: 'sum', stack: 'zero', title: chart.axis, axis: { format: chart.format, tickCount: 5 } },
      color: {
        field: 'part', type: 'nominal', title: null, sort: parts, scale: { scheme: 'tableau20', domain: parts },
        legend: { orient: 'bottom', columns: Math.max(1, Math.floor(width / 170)), symbolType: 'square', labelLimit: 150 },
      },
      order: { field: 'order', type: 'quantitative' },
      tooltip: [{ field: 'bar', title: 'frame' }, { field: 'part', title: chart.part },
        { field: 'amount', aggregate: 'sum', title: chart.axis, format: chart.format === '~s' ? ',' : '.4~g' }],
    },
  };
}

/** The same values as text. */
function tableOf(chart, rows) {
  if (rows.length === 0) return null;
  const parts = [...new Set(rows.map(row => row.part))];
  const bars = [...new Set(rows.map(row => row.bar))];
  const amount = (bar, part) => rows.filter(row => row.bar === bar && row.part === part).reduce((sum, row) => sum + row.amount, 0);
  return make('details', {}, make('summary', {}, `${chart.title} as a table`), make('div', { class: 'scroll', tabindex: 0 },
    make('table', {}, make('thead', {}, make('tr', {}, make('th', { scope: 'col' }, 'Frame'),
      ...parts.map(part => make('th', { scope: 'col', class: 'numeric' }, part)))),
    make('tbody', {}, ...bars.map(bar => make('tr', {}, make('th', { scope: 'row' }, bar.replace('\n', ', ')),
      ...parts.map(part => make('td', { class: 'numeric' }, amount(bar, part).toLocaleString('en', { maximumSignificantDigits: 4 })))))))));
}
