// Titles and captions of the panes.
import { fill, make } from './dom.js';
import { number, withError } from './format.js';
import { valueAt } from './layers.js';
import { disagreementTitles } from './shown_maps.js';
import { findVariant, metricOf } from './study.js';

/** @param {object} study @param {string} id  a variant or "reference" */
export function paneTitle(study, id) {
  return id === 'reference' ? 'Reference' : findVariant(study, id)?.label ?? id;
}

/** Writes the caption of a view: what it shows, its metrics, and the counts of a disagreement. */
export function paneCaption(study, store, view) {
  fill(view.caption, ...view.items.flatMap((item, i) => {
    const parts = [make('strong', {}, view.items.length > 1 ? `${'AB'[i]}: ${paneTitle(study, item.id)}` : paneTitle(study, item.id))];
    const variant = findVariant(study, item.id);
    const shown = variant ? [store.values.x, store.values.y].map(name => study.metrics.find(metric => metric.name === name)) : [];
    for (const metric of shown) {
      const value = metric && metricOf(variant, metric.name, String(store.values.frame));
      if (value) parts.push(make('span', {}, `${withError(value)} ${metric.unit === '%' ? '% ' : metric.unit ? `${metric.unit} ` : ''}`,
        make('small', {}, metric.title)));
    }
    if (item.made?.beyond !== undefined) {
      parts.push(make('span', { class: 'beyond', 'data-value': item.made.beyond },
        `${(100 * item.made.beyond / item.made.values.length).toFixed(2)} % of this frame's pixels beyond 1 threshold`));
    }
    const at = store.values.cursor;
    if (item.made && item.made.channels !== 3 && !item.made.counts && at) {
      parts.push(make('span', {}, `${number(valueAt(item.made, at.x, at.y, study.width, study.height))} `, make('small', {}, 'at the cursor')));
    }
    if (item.made?.counts) parts.push(countsText(item.made.counts, store));
    return [make('div', {}, ...parts)];
  }));
}

function countsText(counts, store) {
  const judge = store.values.show.replace(/^disagreement\./, '');
  const total = counts.reduce((sum, count) => sum + count, 0);
  return make('ul', { class: 'counts' }, ...disagreementTitles(judge).map((title, kind) => make('li', {
    'data-kind': kind, 'data-value': counts[kind],
  }, `${title}: ${counts[kind].toLocaleString('en')} pixels (${(100 * counts[kind] / total).toFixed(1)} %)`)));
}
