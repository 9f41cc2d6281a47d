// The ledger of effects: what each costs in a scene, and what a viewer misses without it.
import { byId, fill, make } from './dom.js';
import { number, withError } from './format.js';

/** @param {object} study */
export function showLedger(study) {
  fill(byId('ledger-body'), ...study.ledger.map(sceneTable));
}

function sceneTable(ledger) {
  const heads = ['Seconds saved without it', 'Pixels seen to err without it (%)', 'Bound of what the plan leaves out (thresholds)'];
  return make('div', { class: 'scroll', tabindex: 0 }, make('table', {},
    make('caption', {}, `${ledger.scene}: ${withError(ledger.seconds)} s a frame with all effects, ${withError(ledger.seen)} % of the pixels seen to err`),
    make('thead', {}, make('tr', {}, ...['Effect', 'Plan'].map(title => make('th', { scope: 'col' }, title)),
      ...heads.map(title => make('th', { scope: 'col', class: 'numeric' }, title)))),
    make('tbody', {}, ...ledger.effects.map(entry => make('tr', { 'data-ledger': entry.effect },
      make('th', { scope: 'row' }, entry.effect.replaceAll('_', ' ')),
      make('td', {}, entry.decision),
      make('td', { class: 'numeric' }, withError(entry.seconds)),
      make('td', { class: 'numeric' }, withError(entry.seen)),
      make('td', { class: 'numeric' }, entry.bound === null ? 'not known' : number(entry.bound)))))));
}
