// The plan of effects of the current variant and frame.
import { byId, fill, make, makeTable } from './dom.js';
import { number } from './format.js';
import { findVariant, variantFrame } from './study.js';

const heads = [['Effect'], ['Decision'], ['Reason', 'reason'], ['Bound (cd/m²)', 'numeric'], ['Bound (thresholds)', 'numeric']];
const decisions = { simulate: 'simulated', simplify: 'simplified', skip: 'left out' };

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
      make('div', { class: 'scroll', tabindex: 0 }, makeTable({}, heads, plan.map(planRow))));
  };
  store.on(['current', 'frame'], draw);
  draw();
}

function planRow(entry) {
  const decision = make('span', { class: 'decision', 'data-decision': entry.decision }, decisions[entry.decision] ?? entry.decision);
  return {
    'data-effect': entry.effect,
    cells: [entry.effect.replaceAll('_', ' '), decision, entry.reason ?? '', number(entry.bound?.luminance), number(entry.bound?.thresholds)],
  };
}
