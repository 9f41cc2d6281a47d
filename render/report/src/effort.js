// Bars of time by stage and of rays by kind, for each frame of the selected variants; of the frame shown where these are many.
import { byId, fill, make, makeTable } from './dom.js';
import { findVariant } from './study.js';
import { drawChart, onResize } from './vega_view.js';

const charts = [
  { list: 'stages', part: 'stage', amount: 'seconds', title: 'Time by stage', axis: 'seconds', format: '~g' },
  { list: 'rays', part: 'kind', amount: 'count', title: 'Rays by kind', axis: 'rays', format: '~s' },
];

const mostBars = 24;

export function showEffort(study, store) {
  const holder = byId('bars');
  const nodes = charts.map(chart => make('figure', { class: 'chart', role: 'img', 'aria-label': `${chart.title}, for each frame of the selected variants` }));
  const note = make('p', { class: 'note' });
  const tables = make('div', { class: 'tables' });
  fill(holder, note, ...nodes, tables);

  const draw = async () => {
    const { selected, frame } = store.values;
    const every = selected.length * study.frames.length <= mostBars;
    const ids = selected.slice(0, every ? selected.length : mostBars);
    note.textContent = every ? '' : `Only frame ${frame}${ids.length < selected.length ? ` of the first ${mostBars} variants` : ''}: too many are selected to show every frame.`;
    const lists = charts.map(chart => rowsOf(study, ids, every ? null : frame, chart));
    for (const [i, chart] of charts.entries()) {
      nodes[i].hidden = lists[i].length === 0;
      if (lists[i].length > 0) await drawChart(nodes[i], specOf(chart, lists[i], nodes[i].clientWidth));
    }
    fill(tables, ...charts.map((chart, i) => tableOf(chart, lists[i])));
    holder.dataset.drawn = selected.join('|');
  };
  let queue = Promise.resolve();
  let timer = 0;
  // The pictures come first; while a selection changes, the bars wait.
  const report = () => {
    clearTimeout(timer);
    timer = setTimeout(() => { queue = queue.then(draw); }, 150);
  };
  store.on(['selected', 'frame'], report);
  onResize(holder, report);
  queue = draw();
  return queue;
}

/** Rows of a chart: of one frame, or of all where `frame` is null. */
function rowsOf(study, ids, frame, chart) {
  const isShown = entry => frame === null || entry.frame === frame;
  return ids.map(id => findVariant(study, id)).flatMap(variant => variant.frames.filter(isShown).flatMap(entry =>
    (entry[chart.list] ?? []).map((part, order) => ({
      bar: frame === null ? `${variant.label}\nframe ${entry.frame}` : variant.label, part: part[chart.part], amount: part[chart.amount], order,
    }))));
}

function specOf(chart, rows, width) {
  const narrow = width < 520;
  const parts = [...new Set(rows.map(row => row.part))];
  const bars = [...new Set(rows.map(row => row.bar))];
  const lines = bars[0].split('\n').length;
  return {
    width, height: (lines > 1 ? 38 : 26) * bars.length, autosize: { type: 'fit-x', contains: 'padding' },
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
  const table = makeTable({}, [['Frame'], ...parts.map(part => [part, 'numeric'])], bars.map(bar => ({
    cells: [bar.replace('\n', ', '), ...parts.map(part => amount(bar, part).toLocaleString('en', { maximumSignificantDigits: 4 }))],
  })));
  return make('details', {}, make('summary', {}, `${chart.title} as a table`), make('div', { class: 'scroll', tabindex: 0 }, table));
}
