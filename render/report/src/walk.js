// The pixel walk: what is stored of one pixel, step by step, and its error.
import { menu, refill } from './controls.js';
import { byId, fill, make, makeTable } from './dom.js';
import { number } from './format.js';
import { colorLuminance } from './luminance.js';
import { readLayer, valueAt } from './layers.js';
import { reference } from './panes.js';
import { findLayer, findVariant, sharedFrame, variantFrame } from './study.js';

export function showWalk(study, store) {
  const node = byId('walk');
  let turn = 0;
  const draw = async () => {
    const mine = ++turn;
    const { current, frame, pixel } = store.values;
    showControls(study, store);
    if (!pixel) {
      fill(node, make('p', { class: 'note' }, 'Click a pixel in a picture here, or press Enter at the cursor.'));
      return;
    }
    const read = readerOf(study, current, frame, pixel);
    const steps = await Promise.all(study.walk.map(step => stepNode(step, read)));
    const result = await resultNode(study, current, frame, read);
    if (mine !== turn) return;
    fill(node, make('ol', { class: 'steps' }, ...steps.filter(Boolean), result));
    node.dataset.pixel = `${pixel.x},${pixel.y}`;
    node.dataset.variant = current ?? '';
    node.dataset.frame = frame;
  };
  const report = () => draw().catch(error => fill(node, `The pixel cannot be read: ${error.message}.`));
  store.on(['current', 'frame', 'pixel', 'selected'], report);
  report();
}

function showControls(study, store) {
  const { values } = store;
  const ids = values.selected.length > 0 ? values.selected : [values.current].filter(Boolean);
  refill(byId('pixel-controls'),
    ids.length > 0 ? menu('Variant', ids.map(id => [id, findVariant(study, id).label]), values.current, current => store.set({ current })) : null,
    values.pixel ? make('p', { class: 'control place' }, make('span', {}, 'Pixel'),
      make('strong', {}, `column ${values.pixel.x}, row ${values.pixel.y}, frame ${values.frame}`)) : null);
}

/** Reads stored values of the pixel; undefined where there are none. */
function readerOf(study, id, frame, { x, y }) {
  const at = async (layer, channel = 0) => layer && valueAt(await readLayer(layer), x, y, study.width, study.height, channel);
  return {
    map: name => at(findLayer(study, id, frame, name)),
    luminance: async layer => {
      if (!layer) return undefined;
      return colorLuminance(await Promise.all([0, 1, 2].map(channel => at(layer, channel))));
    },
  };
}

/** A value with its digits; the whole value stands in the attribute. */
function valueNode(name, value, unit) {
  return make('span', { class: 'value', 'data-channel': name, 'data-value': String(value), title: String(value) },
    number(value), unit ? make('small', {}, ` ${unit}`) : null);
}

async function stepNode(step, read) {
  const channels = await Promise.all((step.channels ?? []).map(async channel => ({ ...channel, value: await read.map(channel.name) })));
  const known = channels.filter(channel => channel.value !== undefined);
  const bands = step.bands ? await bandsNode(step.bands, read) : null;
  if (known.length === 0 && !bands) return null;
  return make('li', {}, make('h3', {}, step.title), step.text ? make('p', {}, step.text) : null,
    known.length > 0 ? valueList(known) : null, bands);
}

/** @param {Array<{name: string, title: string, value: number, unit: string}>} values */
function valueList(values) {
  return make('dl', { class: 'values' }, ...values.map(({ name, title, value, unit }) =>
    make('div', {}, make('dt', {}, title), make('dd', {}, valueNode(name, value, unit)))));
}

/** Bands of spatial frequency: a row each, with bars for contrast and elevation, each relative to its largest. */
async function bandsNode(bands, read) {
  const columns = [{ title: 'contrast', names: bands.channels ?? [] }, { title: 'elevation', names: bands.elevation ?? [] }];
  for (const column of columns) {
    column.values = await Promise.all(column.names.map(name => read.map(name)));
    column.largest = Math.max(...column.values.map(value => Math.abs(value) || 0), 1e-30);
  }
  const shown = columns.filter(column => column.values.some(value => value !== undefined));
  if (shown.length === 0) return null;
  const cell = (column, i) => column.values[i] === undefined ? '–' : make('span', { class: 'band' },
    valueNode(column.names[i], column.values[i]),
    make('span', { class: 'band-track', 'aria-hidden': 'true' }, make('span', {
      class: 'band-bar', style: `inline-size: ${100 * Math.abs(column.values[i]) / column.largest}%`,
    })));
  return makeTable({ class: 'bands' }, [['cycles/degree'], ...shown.map(column => [column.title])],
    bands.frequency.map((frequency, i) => ({ cells: [number(frequency), ...shown.map(column => cell(column, i))] })));
}

async function resultNode(study, id, frame, read) {
  const white = study.display_white;
  const [own, wanted, threshold] = await Promise.all([
    read.luminance(variantFrame(study, id, frame)?.picture), read.luminance(sharedFrame(study, frame)?.[reference]),
    read.map('threshold.Y')]);
  const rows = [];
  if (own !== undefined) rows.push(['result.luminance', 'luminance', own * white, 'cd/m²']);
  if (wanted !== undefined) rows.push(['result.reference', 'luminance of the reference', wanted * white, 'cd/m²']);
  if (own !== undefined && wanted !== undefined) {
    const error = (own - wanted) * white;
    rows.push(['result.error', 'error', error, 'cd/m²']);
    if (threshold !== undefined) rows.push(['result.thresholds', 'error in visible thresholds', Math.abs(error) / threshold, '']);
  }
  if (rows.length === 0) return null;
  return make('li', { class: 'result' }, make('h3', {}, 'Result'),
    make('p', {}, 'Luminance as displayed, and its difference from the reference. Beyond 1 threshold, a viewer can see it.'),
    valueList(rows.map(([name, title, value, unit]) => ({ name, title, value, unit }))));
}
