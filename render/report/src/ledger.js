// The ledger of effects: what each costs in a scene, and what a viewer misses without it.
import { byId, fill, make, makeTable } from './dom.js';
import { number, withError } from './format.js';

export function showLedger(study) {
  fill(byId('ledger-body'), ...study.ledger.map(sceneTable));
}

function sceneTable(ledger) {
  const heads = [['Effect'], ['Plan'], ['Seconds saved without it', 'numeric'], ['Pixels seen to err without it (%)', 'numeric'],
    ['Bound of what the plan leaves out (thresholds)', 'numeric']];
  const table = makeTable({}, heads, ledger.effects.map(entry => ({
    'data-ledger': entry.effect,
    cells: [entry.effect.replaceAll('_', ' '), entry.decision, withError(entry.seconds), withError(entry.seen),
      entry.bound === null ? 'not known' : number(entry.bound)],
  })));
  table.prepend(make('caption', {}, `${ledger.scene}: ${withError(ledger.seconds)} s a frame with all effects, ${withError(ledger.seen)} % of the pixels seen to err`));
  return make('div', { class: 'scroll', tabindex: 0 }, table);
}
