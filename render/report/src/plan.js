// The plan of effects of the current variant and frame.
import { byId, fill, make } from './dom.js';
import { number } from './format.js';
import { findVariant, variantFrame } from './study.js';

const decisions = { simulate: 'simulated', simplify: 'simplified', skip: 'left out' };

/** @param {object} study @param {object} store */
export function showPlan(study, store) {
  const node = byId('plan-body');
  const draw = () => {
    const { current, frame } = store.values;
    const plan = current && variantFrame(study, current, frame)?.plan;
    if (!plan || plan.length === 0) {
      fill(node, make('p', { class: 'note' }, 'This variant has no plan for this frame.'));
      return;
    }
    fill(node, make('p', { class: 'note' }, `${findVariant(study, current).label}, frame ${frame}`),
      make('div', { class: 'scroll', tabindex: 0 }, make('table', {},
        make('thead', {}, make('tr', {}, ...['Effect', 'Decision', 'Reason'].map(title => make('th', { scope: 'col' }, title)),
          ...['Bound (cd/m²)', 'Bound (thresholds)'].map(title => make('th', { scope: 'col', class: 'numeric' }, title)))),
        make('tbody', {}, ...plan.map(planRow)))));
  };
  store.on(['current', 'frame'], draw);
  draw();
}

function planRow(entry) {
  return make('tr', { 'data-effect': entry.effect },
    make('th', { scope: 'row' }, entry.effect.replaceAll('_', ' ')),
    make('td', {}, make('span', { class: 'decision', 'data-decision': entry.decision }, decisions[entry.decision] ?? entry.decision)),
    make('td', { class: 'reason' }, entry.reason ?? ''),
    make('td', { class: 'numeric' }, number(entry.bound?.luminance)),
    make('td', { class: 'numeric' }, number(entry.bound?.thresholds)));
}
