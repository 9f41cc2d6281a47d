// The chart of error against time.
import { chartNote, chartPoints, findMetric } from './chart_points.js';
import { menu, refill } from './controls.js';
import { byId } from './dom.js';
import { settingText, withUnit } from './format.js';
import { select, toggleSelected } from './selection.js';
import { drawChart, onResize, rampColor, seriesColors } from './vega_view.js';

export function showChart(study, store) {
  const node = byId('chart');
  const { values } = store;
  let view = null;
  let brushed = []; // the selection that the brush made
  let drawn = Promise.resolve();

  const markSelected = points => points.map(point => ({ ...point, selected: values.selected.includes(point.id) }));

  const draw = () => {
    showControls(study, store);
    const data = chartPoints(study, values);
    byId('chart-note').textContent = chartNote(data);
    byId('results-title').textContent = titleOf(study, values);
    drawn = drawn.then(async () => {
      view = await drawChart(node, specOf(study, values, { ...data, points: markSelected(data.points) }, node.clientWidth));
      listen(view, study, store, data.points, ids => { brushed = ids; });
    });
  };
  store.on(['x', 'y', 'color', 'shape', 'over'], draw);
  store.on(['selected'], () => {
    if (!view) return;
    view.data('points', markSelected(chartPoints(study, values).points));
    // A selection made elsewhere ends the brush.
    if (values.selected.join() !== brushed.join()) view.signal('brush_x', []).signal('brush_y', []);
    view.runAsync();
  });
  onResize(node, draw);
  draw();
  return drawn;
}

function titleOf(study, values) {
  const usual = values.x === study.metrics[0]?.name && /seconds|time/.test(values.x);
  return usual ? 'Error against time' : `${findMetric(study, values.y).title} against ${findMetric(study, values.x).title}`;
}

function listen(view, study, store, points, onBrush) {
  let brushed = false;
  view.addSignalListener('brush', (_, brush) => {
    const { xPlace: x, yPlace: y } = brush;
    if (!x || !y) return;
    brushed = true;
    const inside = (value, [a, b]) => value >= Math.min(a, b) && value <= Math.max(a, b);
    const ids = points.filter(point => inside(point.xPlace, x) && inside(point.yPlace, y)).map(point => point.id);
    onBrush(ids);
    select(study, store, ids);
  });
  view.addEventListener('pointerdown', () => { brushed = false; });
  view.addEventListener('click', (event, item) => {
    const id = item?.datum?.id;
    if (!id || brushed) return;
    if (event.shiftKey || event.ctrlKey || event.metaKey) toggleSelected(study, store, id);
    else select(study, store, [id]);
  });
}

function showControls(study, store) {
  const { values } = store;
  const metrics = study.metrics.map(metric => [metric.name, withUnit(metric)]);
  const axes = [['none', 'nothing'], ...study.axes.map(axis => [axis.setting, axis.setting])];
  const frames = [['mean', 'mean of all'], ...study.frames.map(frame => [String(frame), String(frame)])];
  refill(byId('chart-controls'),
    menu('Horizontal axis', metrics, values.x, x => store.set({ x })),
    menu('Vertical axis', metrics, values.y, y => store.set({ y })),
    menu('Colour', axes, values.color, color => store.set({ color })),
    menu('Shape', axes, values.shape, shape => store.set({ shape })),
    study.frames.length > 1 ? menu('Frames', frames, values.over, over => store.set({ over })) : null);
}

function axisSpec(study, values, axis, domains, ticks) {
  const metric = findMetric(study, values[axis]);
  return {
    field: `${axis}Place`, type: 'quantitative', title: axis === 'x' ? withUnit(metric) : null,
    scale: { type: metric.log ? 'log' : 'linear', domain: domains[axis], nice: false, ...(metric.log ? {} : { zero: false }) },
    axis: { format: '~g', tickCount: ticks, labelOverlap: 'greedy', labelSeparation: 10 },
  };
}

/** Colour or shape by the values of a setting; numbers get colours in order. */
function settingSpec(study, setting, channel, narrow) {
  if (setting === 'none') return { value: channel === 'color' ? 'var(--accent)' : 'circle' };
  const { values } = study.axes.find(axis => axis.setting === setting);
  const domain = values.map(settingText);
  const ordered = values.length > 2 && values.every(value => typeof value === 'number');
  const colors = { range: domain.map((_, i) => ordered ? rampColor(i / (domain.length - 1)) : seriesColors[i % seriesColors.length]) };
  return {
    field: channel, type: ordered ? 'ordinal' : 'nominal', title: setting,
    scale: { domain, ...(channel === 'color' ? colors : {}) },
    legend: narrow ? { orient: 'bottom', direction: 'horizontal', columns: 3 } : { orient: 'right' },
  };
}

function specOf(study, values, { points, front, domains }, width) {
  const narrow = width < 620;
  const x = axisSpec(study, values, 'x', domains, width / 120);
  const y = axisSpec(study, values, 'y', domains, 6);
  const yTitle = withUnit(findMetric(study, values.y));
  const color = settingSpec(study, values.color, 'color', narrow);
  const same = values.color === values.shape;
  const tooltip = [{ field: 'label', title: 'variant' }, { field: 'xText', title: x.title }, { field: 'yText', title: yTitle },
    ...study.axes.map((axis, i) => ({ field: `setting${i}`, title: axis.setting }))];
  const bar = (axis, other) => ({
    mark: { type: 'rule', strokeWidth: 1.2, opacity: 0.7, tooltip: null },
    encoding: {
      [axis]: { ...(axis === 'x' ? x : y), field: `${axis}Low` }, [`${axis}2`]: { field: `${axis}High` },
      [other]: other === 'x' ? x : y, color: { ...color, legend: undefined },
    },
  });
  return {
    width, height: narrow ? 300 : 380, autosize: { type: 'fit', contains: 'padding' },
    title: yTitle, data: { name: 'points', values: points },
    layer: [
      {
        data: { name: 'front', values: front },
        mark: { type: 'line', interpolate: 'step-after', color: 'var(--ink-3)', strokeDash: [5, 4], strokeWidth: 1.5, tooltip: null },
        encoding: { x, y, order: { field: 'xPlace', type: 'quantitative' } },
      },
      bar('x', 'y'),
      bar('y', 'x'),
      {
        params: [{ name: 'brush', select: { type: 'interval', zoom: false, translate: false, mark: { fill: 'var(--accent)', fillOpacity: 0.1, stroke: 'var(--accent)' } } }],
        mark: { type: 'point', filled: true, size: narrow ? 130 : 110, cursor: 'pointer' },
        encoding: {
          x, y, color, tooltip, description: { field: 'label' },
          shape: settingSpec(study, values.shape, 'shape', narrow),
          opacity: { condition: { test: 'datum.selected', value: 1 }, value: 0.75 },
          stroke: { condition: { test: 'datum.selected', value: 'var(--ink)' }, value: 'transparent' },
          strokeWidth: { value: 2 },
        },
      },
    ],
    resolve: same ? {} : { legend: { color: 'shared', shape: 'independent' } },
  };
}
