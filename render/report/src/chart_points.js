// The points of the chart, from the study and the axes chosen.
import { number, settingText, withError } from './format.js';
import { metricOf, paretoFront } from './study.js';

/** A metric's entry in the study. */
export function findMetric(study, name) {
  return study.metrics.find(metric => metric.name === name);
}

/**
 * Points with positions, error bars and tooltip fields, and the Pareto front in the order of x.
 * On a logarithmic axis, values of 0 or less go near the lower edge.
 * @returns {{points: object[], front: object[], domains: {x: number[], y: number[]}, atEdge: number, missing: number}}
 */
export function chartPoints(study, values) {
  const metrics = { x: findMetric(study, values.x), y: findMetric(study, values.y) };
  const rows = study.variants.map(variant => ({
    variant, x: metricOf(variant, values.x, values.over), y: metricOf(variant, values.y, values.over),
  })).filter(row => row.x && row.y);
  const domains = {};
  let atEdge = 0;
  const edges = {};
  for (const axis of ['x', 'y']) {
    const { domain, edge } = domainOf(rows.map(row => row[axis]), metrics[axis].log);
    domains[axis] = domain;
    edges[axis] = edge;
  }

  const points = rows.map(row => {
    const point = { id: row.variant.id, label: row.variant.label };
    let edge = false;
    for (const axis of ['x', 'y']) {
      const { value, error = 0 } = row[axis];
      const clamp = place => metrics[axis].log ? Math.max(place, edges[axis]) : place;
      edge ||= clamp(value) !== value;
      point[axis] = value;
      point[`${axis}Place`] = clamp(value);
      point[`${axis}Low`] = clamp(value - (error || 0));
      point[`${axis}High`] = value + (error || 0);
      point[`${axis}Text`] = `${withError(row[axis])} ${metrics[axis].unit ?? ''}`;
    }
    if (edge) ++atEdge;
    const setting = name => name === 'none' ? '' : settingText(row.variant.settings[name]);
    point.color = setting(values.color);
    point.shape = setting(values.shape);
    study.axes.forEach((axis, i) => { point[`setting${i}`] = settingText(row.variant.settings[axis.setting]); });
    return point;
  });
  return { points, front: frontOf(study, values, points), domains, atEdge, missing: study.variants.length - rows.length };
}

/** The front as the study gives it for the default metrics; computed here for others. */
function frontOf(study, values, points) {
  const given = values.over === 'mean' && values.x === study.metrics[0]?.name && values.y === study.metrics[1]?.name
    && study.variants.some(variant => variant.pareto);
  const ids = new Set(given ? study.variants.filter(variant => variant.pareto).map(variant => variant.id) : paretoFront(points));
  return points.filter(point => ids.has(point.id)).sort((a, b) => a.x - b.x || b.y - a.y);
}

/** The ends of an axis; and for a logarithmic one, where values of 0 or less are drawn. */
function domainOf(metrics, log) {
  const ends = metrics.flatMap(({ value, error }) => [value - (error || 0), value + (error || 0), value]).filter(Number.isFinite);
  if (!log) {
    const low = Math.min(0, ...ends);
    const high = Math.max(...ends, low + 1e-12);
    return { domain: [low < 0 ? low - 0.05 * (high - low) : 0, high + 0.05 * (high - low)] };
  }
  const positive = ends.filter(value => value > 0);
  if (positive.length === 0) return { domain: [0.1, 1], edge: 0.12 };
  const low = Math.min(...positive);
  const high = Math.max(...positive);
  const pad = Math.max(1.15, (high / low) ** 0.06);
  const zeros = ends.some(value => value <= 0);
  return { domain: [low / (zeros ? pad ** 2 : pad), high * pad], edge: low / pad };
}

/** What the note below the chart says. */
export function chartNote({ atEdge, missing }) {
  const notes = [];
  if (atEdge > 0) notes.push(`${number(atEdge)} ${atEdge === 1 ? 'point is' : 'points are'} drawn near the lower edge: ${atEdge === 1 ? 'its' : 'their'} value is 0 or less, which a logarithmic axis cannot show.`);
  if (missing > 0) notes.push(`${number(missing)} ${missing === 1 ? 'variant has' : 'variants have'} no value of these metrics.`);
  return notes.join(' ');
}
