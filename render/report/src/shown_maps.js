// The maps that can be shown: those stored in the report, and those computed from its pictures.
import { luminance } from './luminance.js';
import { readLayer, valueAt } from './layers.js';
import { findLayer, sharedFrame, variantFrame } from './study.js';

const thresholdMap = 'threshold.Y';
const computedTitle = 'Computed on this page';

const errorMaps = [
  { key: 'computed.thresholds', title: 'Error in visible thresholds', unit: 'thresholds', scale: 'linear', low: 0, high: 4 },
  { key: 'computed.signed', title: 'Error in visible thresholds, signed', unit: 'thresholds', scale: 'diverging', low: -4, high: 4 },
];
const differenceMap = { key: 'computed.difference', title: 'Difference of luminance', unit: 'cd/m²', scale: 'diverging' };

/** What the values of a disagreement map mean. */
export const disagreementTitles = judge => ['not visible', 'visible by both', 'visible by our threshold only', `visible by ${judge} only`];
const disagreementColors = [7, 2, 0, 5]; // grey, green, blue, orange of the categories

/** The entries of the map menu, in groups. @returns {Array<{group: string, maps: object[]}>} */
export function listMaps(study) {
  const stored = name => study.pictures.some(frame => frame.maps?.[name])
    || study.variants.some(variant => variant.frames.some(frame => frame.maps?.[name]));
  const hasReference = study.pictures.some(frame => frame.reference);
  const computed = [];
  if (hasReference && stored(thresholdMap)) {
    computed.push(...errorMaps);
    for (const judge of study.judges) {
      if (stored(judge.map)) {
        computed.push({ key: `disagreement.${judge.name}`, title: `Disagreement with ${judge.name}`, scale: 'category', judge });
      }
    }
  }
  if (hasReference) computed.push(differenceMap);
  const kept = study.maps.filter(map => stored(map.name)).map(map => ({ ...map, key: map.name }));
  return [{ group: computedTitle, maps: computed }, { group: 'Stored', maps: kept }].filter(entry => entry.maps.length > 0);
}

/**
 * Layers that a map of one pane is made of, or null if it has none there.
 * @param {string|null} id  a variant, or null for the reference
 */
function neededLayers(study, map, id, frame) {
  const shared = sharedFrame(study, frame);
  if (map.name) {
    const layer = id === null ? shared?.maps?.[map.name] : findLayer(study, id, frame, map.name);
    return layer ? { stored: layer } : null;
  }
  const picture = id === null ? undefined : variantFrame(study, id, frame)?.picture;
  const layers = { picture, reference: shared?.reference };
  if (map !== differenceMap) layers.threshold = findLayer(study, id, frame, thresholdMap);
  if (map.judge) layers.judge = findLayer(study, id, frame, map.judge.map);
  return Object.values(layers).every(Boolean) ? layers : null;
}

/**
 * A map (of listMaps) of one pane: {width, height, values}, with the number of pixels `beyond` one threshold for an
 * error, and `counts` of pixels for a disagreement; null if it has none there.
 */
export async function makeMap(study, map, id, frame) {
  const needed = neededLayers(study, map, id, frame);
  if (!needed) return null;
  const layers = Object.fromEntries(await Promise.all(Object.entries(needed).map(async ([name, layer]) => [name, await readLayer(layer)])));
  if (layers.stored) return layers.stored;

  const { width, height } = layers.picture;
  const error = luminanceError(layers.picture, layers.reference, study.display_white);
  if (map === differenceMap) return { width, height, values: error };
  for (let i = 0; i < error.length; ++i) error[i] /= valueAt(layers.threshold, i % width, Math.floor(i / width), width, height);
  if (map.key === 'computed.signed') return { width, height, values: error };
  if (map.judge) return disagreement(error, layers.judge, map.judge.limit, width, height);
  const values = error.map(Math.abs);
  return { width, height, values, beyond: values.reduce((count, value) => count + (value > 1), 0) };
}

/** Luminance of a picture minus that of the reference, in cd/m². */
function luminanceError(picture, reference, displayWhite) {
  const error = luminance(picture);
  const wanted = luminance(reference);
  for (let i = 0; i < error.length; ++i) error[i] = (error[i] - wanted[i]) * displayWhite;
  return error;
}

function disagreement(error, judge, limit, width, height) {
  const counts = [0, 0, 0, 0];
  const values = error.map((value, i) => {
    const ours = Math.abs(value) > 1;
    const theirs = valueAt(judge, i % width, Math.floor(i / width), width, height) > limit;
    const kind = ours ? (theirs ? 1 : 2) : theirs ? 3 : 0;
    ++counts[kind];
    return disagreementColors[kind];
  });
  return { width, height, values, counts };
}

/** Categories of a disagreement map for its legend: [value, title]. */
export function disagreementCategories(judge) {
  return disagreementTitles(judge.name).map((title, kind) => [disagreementColors[kind], title]);
}

/** The range of a map's scale: as chosen, else as stored, else that of the maps shown. */
export function scaleOf(map, chosen, shown) {
  const scale = { kind: map.scale, low: chosen?.low ?? map.low, high: chosen?.high ?? map.high };
  if (scale.kind === 'category' || (scale.low !== undefined && scale.high !== undefined)) return scale;
  let low = Infinity;
  let high = -Infinity;
  for (const { values } of shown) {
    for (const value of values) {
      if (!Number.isFinite(value) || (scale.kind === 'log' && value <= 0)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  if (low > high) [low, high] = scale.kind === 'log' ? [0.1, 1] : [0, 1];
  if (scale.kind === 'diverging') [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
  if (low === high) [low, high] = scale.kind === 'log' ? [low / 2, high * 2] : [low - 0.5, high + 0.5];
  return { kind: scale.kind, low: scale.low ?? low, high: scale.high ?? high };
}
