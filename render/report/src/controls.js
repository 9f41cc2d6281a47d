// Labelled form controls.
import { fill, make } from './dom.js';

let count = 0;

/** A menu. `options` are [value, title] pairs, or {group, options} for a group of them. */
export function menu(title, options, value, onChange) {
  const option = ([key, text]) => make('option', { value: key, selected: key === value }, text);
  const nodes = options.map(entry => Array.isArray(entry)
    ? option(entry) : make('optgroup', { label: entry.group }, ...entry.options.map(option)));
  const select = make('select', { name: title, onchange: event => onChange(event.target.value) }, ...nodes);
  return make('label', { class: 'control' }, make('span', {}, title), select);
}

/**
 * A slider with its value as text.
 * @param {{min: number, max: number, step: number, value: number, show: (value: number) => string}} range
 */
export function slider(title, range, onInput) {
  const output = make('output', {}, range.show(range.value));
  const input = make('input', {
    type: 'range', name: title, min: range.min, max: range.max, step: range.step,
    oninput: event => {
      output.textContent = range.show(event.target.valueAsNumber);
      onInput(event.target.valueAsNumber);
    },
  });
  input.value = range.value;
  return make('label', { class: 'control' }, make('span', {}, title, ' ', output), input);
}

/** A few alternatives, of which one holds. @param {Array<[string, string]>} options  values and titles */
export function choice(title, options, value, onChange) {
  const name = `choice-${++count}`;
  return make('fieldset', { class: 'control' }, make('legend', {}, title),
    make('span', { class: 'segments' }, ...options.map(([key, text]) => make('label', {},
      make('input', { type: 'radio', name, value: key, checked: key === value, onchange: () => onChange(key) }),
      make('span', {}, text)))));
}

/** Makes controls anew in their place; the focus stays where it was. @param {HTMLElement} holder @param {...(Node|null)} controls */
export function refill(holder, ...controls) {
  const { name, type, value } = holder.contains(document.activeElement) ? document.activeElement : {};
  fill(holder, ...controls);
  const isSame = node => type === 'radio' ? node.type === type && node.value === value : node.name === name;
  if (name) [...holder.querySelectorAll('[name]')].find(isSame)?.focus();
}

/** @param {string} [label]  for screen readers */
export function button(text, onClick, label) {
  return make('button', { type: 'button', 'aria-label': label, title: label, onclick: onClick }, text);
}
