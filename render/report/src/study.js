// The study's data, and look-ups in it.
import { settingText } from './format.js';

/** Reads the study of this page. Parts that are absent become empty. @throws {Error} if there is none, or it is of another version */
export function readStudy(text) {
  if (!text) throw new Error('This page is a template without data. `aleph study` writes pages with data.');
  const study = JSON.parse(text);
  if (study.schema_version !== 1) throw new Error(`The data are of version ${study.schema_version}; this page reads version 1.`);
  for (const name of ['axes', 'metrics', 'variants', 'pictures', 'maps', 'walk', 'judges', 'frames', 'ledger']) study[name] ??= [];
  const varied = study.axes.filter(axis => axis.values.length > 1);
  for (const variant of study.variants) {
    variant.settings ??= {};
    variant.metrics ??= {};
    variant.frames ??= [];
    const name = (axes, between) => axes.map(axis => `${axis.setting}${between}${settingText(variant.settings[axis.setting])}`);
    variant.swept = study.axes.length > 0 && name(study.axes, '=').join(',') === variant.id;
    variant.label = variant.swept ? name(varied.length > 0 ? varied : study.axes, ' ').join(', ') : variant.id;
  }
  return study;
}

export function findVariant(study, id) {
  return study.variants.find(variant => variant.id === id);
}

/** A variant's data of one frame, or undefined. */
export function variantFrame(study, id, frame) {
  return findVariant(study, id)?.frames.find(entry => entry.frame === frame);
}

/** What all variants share of one frame, or undefined. */
export function sharedFrame(study, frame) {
  return study.pictures.find(entry => entry.frame === frame);
}

/** A map's layer: the variant's, else the frame's, else undefined. */
export function findLayer(study, id, frame, name) {
  return variantFrame(study, id, frame)?.maps?.[name] ?? sharedFrame(study, frame)?.maps?.[name];
}

/** A metric of a variant: {value, error} or null. @param {string} over  "mean", or the number of a frame */
export function metricOf(variant, name, over) {
  const metrics = over === 'mean' ? variant.metrics
    : variant.frames.find(entry => String(entry.frame) === over)?.metrics;
  const metric = metrics?.[name];
  return metric && Number.isFinite(metric.value) ? metric : null;
}

/**
 * Ids of the variants that no other beats on both metrics; lower is better. In the order of x.
 * @param {Array<{id: string, x: number, y: number}>} points
 */
export function paretoFront(points) {
  let best = Infinity;
  return [...points].sort((a, b) => a.x - b.x || a.y - b.y).filter(point => {
    if (point.y >= best) return false;
    best = point.y;
    return true;
  }).map(point => point.id);
}
