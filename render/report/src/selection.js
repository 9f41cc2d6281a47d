// Which variants are selected: one list for the chart, the table and the pictures.
import { announce } from './dom.js';
import { findVariant, metricOf, paretoFront } from './study.js';

/** Selects variants, in the order of the study. */
export function select(study, store, ids) {
  const selected = study.variants.map(variant => variant.id).filter(id => ids.includes(id));
  const before = store.values.selected;
  if (selected.length === before.length && selected.every((id, i) => id === before[i])) return;
  performance.clearMarks('selection');
  performance.mark('selection');
  const { current, b } = store.values;
  const first = selected[0] ?? null;
  store.set({
    selected,
    current: selected.includes(current) ? current : first ?? current,
    b: selected.includes(b) ? b : first ?? b,
  });
  announce(selectionText(study, selected));
}

/** Adds a variant to the selection, or takes it out. */
export function toggleSelected(study, store, id) {
  const { selected } = store.values;
  select(study, store, selected.includes(id) ? selected.filter(other => other !== id) : [...selected, id]);
}

export function selectionText(study, selected) {
  const labels = selected.slice(0, 3).map(id => findVariant(study, id).label);
  const more = selected.length > 3 ? ` and ${selected.length - 3} more` : '';
  return selected.length === 0 ? 'No variant selected' : `${selected.length} of ${study.variants.length} selected: ${labels.join('; ')}${more}`;
}

/** The selection to begin with: the fastest and the most accurate variant of the front. */
export function firstSelection(study, x, y) {
  const points = study.variants.map(variant => ({ id: variant.id, x: metricOf(variant, x, 'mean')?.value, y: metricOf(variant, y, 'mean')?.value }))
    .filter(point => point.x !== undefined && point.y !== undefined);
  const front = paretoFront(points);
  const ids = front.length > 0 ? front : study.variants.map(variant => variant.id);
  const ends = [ids[0], ids.at(-1)];
  return study.variants.map(variant => variant.id).filter(id => ends.includes(id));
}
