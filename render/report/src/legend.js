// The legend of the map shown: its colours, its unit, and the ends of its scale, which can be changed.
import { categoryColor, palette } from './color.js';
import { byId, fill, make } from './dom.js';
import { number, withUnit } from './format.js';
import { disagreementCategories } from './shown_maps.js';

/** @param {object|null} map @param {object|null} scale @param {object[]} shown  the maps shown @param {object} store */
export function showLegend(map, scale, shown, store) {
  const legend = byId('legend');
  legend.hidden = !map;
  if (!map) return;
  const title = make('span', { class: 'legend-title' }, withUnit(map));
  if (shown.length === 0) fill(legend, title, make('span', { class: 'note' }, 'None of these pictures has this map.'));
  else if (shown.every(entry => entry.channels === 3)) fill(legend, title, make('span', { class: 'note' }, 'shown as a picture'));
  else if (map.scale === 'category') fill(legend, title, categories(map, shown));
  else if (!legend.contains(document.activeElement)) fill(legend, title, ...bar(map, scale, store));
  else legend.querySelector('canvas')?.replaceWith(gradient(scale));
}

function categories(map, shown) {
  const entries = map.judge ? disagreementCategories(map.judge) : valuesOf(shown).map(value => [value, String(value)]);
  return make('ul', { class: 'categories' }, ...entries.map(([value, text]) => make('li', {},
    make('span', { class: 'swatch', style: `background: rgb(${categoryColor(value).join(' ')})` }), text)));
}

function valuesOf(shown) {
  const values = new Set();
  for (const map of shown) for (const value of map.values) if (Number.isFinite(value)) values.add(value);
  return [...values].sort((a, b) => a - b).slice(0, 24);
}

function gradient(scale) {
  const canvas = make('canvas', { width: 256, height: 1, class: 'gradient', 'aria-hidden': 'true' });
  const colors = palette(scale.kind);
  const image = new ImageData(256, 1);
  for (let i = 0; i < 256; ++i) image.data.set([colors[3 * i], colors[3 * i + 1], colors[3 * i + 2], 255], 4 * i);
  canvas.getContext('2d').putImageData(image, 0, 0);
  return canvas;
}

function bar(map, scale, store) {
  const kinds = { log: 'logarithmic', linear: 'linear', diverging: '0 in the middle' };
  const symmetric = scale.kind === 'diverging';
  const limit = symmetric ? Math.max(Math.abs(scale.low), Math.abs(scale.high)) : scale.high;
  const field = (end, value, text) => make('input', {
    type: 'number', step: 'any', name: end, value: Number(value.toPrecision(4)), 'aria-label': text,
    onchange: event => {
      const typed = event.target.valueAsNumber;
      const update = symmetric ? { low: -Math.abs(typed), high: Math.abs(typed) } : { ...scale, [end]: typed };
      const valid = Number.isFinite(typed) && update.low < update.high && (scale.kind !== 'log' || update.low > 0);
      if (!valid) event.target.value = value;
      else store.set({ ranges: { ...store.values.ranges, [map.key]: { low: update.low, high: update.high } } });
    },
  });
  const low = symmetric ? make('span', { class: 'end' }, `−${number(limit)}`) : field('low', scale.low, 'lower end of the scale');
  const reset = make('button', {
    type: 'button', class: 'quiet', onclick: () => {
      const { [map.key]: _, ...rest } = store.values.ranges;
      store.set({ ranges: rest });
    },
  }, 'Reset');
  return [make('span', { class: 'scale' }, low, gradient(scale), field('high', limit, 'upper end of the scale')),
    make('span', { class: 'note' }, kinds[scale.kind] ?? ''), reset];
}
