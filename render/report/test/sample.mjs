// node sample.mjs TEMPLATE OUT: a synthetic study in the page. Every stored value comes from a formula of its place,
// so that tests can compare what the page shows with it.
import fs from 'node:fs';
import { fileURLToPath } from 'node:url';
import zlib from 'node:zlib';

export const frames = [20, 60];
const errors = [0.5, 1, 2];
const guides = ['none', 'saliency'];
const frequencies = [16, 8, 4, 2, 1, 0.5];

/** The nearest half-precision number, as bits; for values of normal size. */
function halfBits(value) {
  if (value === 0) return 0;
  const sign = value < 0 ? 0x8000 : 0;
  const size = Math.abs(value);
  const exponent = Math.max(-14, Math.min(15, Math.floor(Math.log2(size))));
  const fraction = size / 2 ** exponent;
  if (fraction < 1) return sign | Math.round(fraction * 1024); // denormal
  return sign | Math.round((exponent + 15 + fraction - 1) * 1024);
}

/** The value of half-precision bits. */
export function halfValue(bits) {
  const exponent = bits >> 10 & 31;
  const fraction = bits & 1023;
  const size = exponent === 31 ? (fraction ? NaN : Infinity)
    : exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15);
  return bits & 0x8000 ? -size : size;
}

/** Values as the text of a layer's element. @param {Float32Array} values @param {"f16"|"f32"} type */
function packLayer(values, type) {
  const size = type === 'f16' ? 2 : 4;
  const plain = Buffer.alloc(values.length * size);
  values.forEach((value, i) => type === 'f16' ? plain.writeUInt16LE(halfBits(value), 2 * i) : plain.writeFloatLE(value, 4 * i));
  const shuffled = Buffer.alloc(plain.length);
  for (let i = 0; i < values.length; ++i) for (let byte = 0; byte < size; ++byte) shuffled[byte * values.length + i] = plain[i * size + byte];
  return zlib.deflateSync(shuffled).toString('base64');
}

/** Noise from -1 to 1 that depends on its arguments alone. */
function noise(...seeds) {
  let state = 2166136261;
  for (const seed of seeds) state = Math.imul(state ^ seed, 16777619) ^ state >>> 13;
  state = Math.imul(state ^ state >>> 15, 2246822519);
  return ((state ^ state >>> 13) >>> 0) / 2147483648 - 1;
}

/** Formulas of the layers; u and v go from 0 to 1. */
const formulas = {
  reference: frame => (u, v, channel) => {
    const disc = Math.hypot(u - 0.3 - frame / 200, 1.2 * (v - 0.5)) < 0.22;
    const floor = v > 0.62 ? 0.25 + 0.15 * ((Math.floor(u * 10) + Math.floor(v * 10)) % 2) : 0.1 + 0.5 * v;
    return (disc ? [0.9, 0.35, 0.12][channel] * (1.15 - v) : floor * [0.9, 1, 1.1][channel]) + 0.02;
  },
  'threshold.Y': () => (u, v) => 0.4 + 2 * u * v,
  'aleph.Y': frame => (u, v) => 1 + 90 * v * v * (1 + 0.01 * frame * u),
  'velocity.image': frame => (u, v) => 0.1 * frame * (v - 0.5),
  'forward.u': frame => (u, v) => frame * 0.01 + u - v,
  'samples.Y': (frame, error) => (u, v) => Math.round(4 + 60 * u / error),
  'judge.colorvideovdp': (frame, error) => (u, v) => 0.9 * error * u + 0.3 * v,
};

/** A stored value of a pixel as the page must show it: at the precision of its type. */
export function storedValue(name, frame, error, x, y, size, type = 'f32') {
  const value = formulas[name](frame, error)((x + 0.5) / size.width, (y + 0.5) / size.height, 0);
  return type === 'f16' ? halfValue(halfBits(value)) : Math.fround(value);
}

/** A writer of layers: add returns the LAYER of the study, texts holds their elements. */
function layerWriter(size) {
  const texts = [];
  return {
    texts,
    add(value, channels, type) {
      const values = new Float32Array(size.width * size.height * channels);
      let i = 0;
      for (let channel = 0; channel < channels; ++channel) {
        for (let y = 0; y < size.height; ++y) {
          for (let x = 0; x < size.width; ++x) values[i++] = value((x + 0.5) / size.width, (y + 0.5) / size.height, channel, x, y);
        }
      }
      texts.push(packLayer(values, type));
      return { element: `layer-${texts.length - 1}`, ...size, channels, type };
    },
  };
}

function metricsOf(error, guide, frame = 0) {
  const guided = guide === 'saliency';
  return {
    processor_seconds: { value: (guided ? 1.1 : 2) / error + frame / 400, error: 0.04 },
    share_beyond: { value: error < 1 && !guided ? 0 : 0.8 * error ** 1.5 * (guided ? 1.6 : 1), error: 0.1 },
    relative_mse: { value: 0.002 * error ** 2 },
    seed_flicker: null,
  };
}

function variantOf(writer, error, guide) {
  const id = `error=${error},guide=${guide}`;
  const number = errors.indexOf(error) * 2 + guides.indexOf(guide);
  return {
    id, settings: { error, guide }, metrics: metricsOf(error, guide), pareto: guide === 'saliency' || error === 0.5,
    frames: frames.map(frame => {
      const picture = formulas.reference(frame);
      return {
        frame,
        metrics: metricsOf(error, guide, frame),
        stages: [['first_hits', 0.1], ['estimate', 0.12], ['vision', 0.05], ['fill', 0.7 / error], ['shade', 0.4 / error]]
          .map(([stage, seconds]) => ({ stage, seconds })),
        rays: [['primary', 76800], ['shadow', 250000 / error], ['gather', 400000 / error]].map(([kind, count]) => ({ kind, count })),
        plan: [
          { effect: 'glossy_reflection', decision: 'simulate', reason: 'a surface with gloss is in view', bound: { luminance: 12.5, thresholds: 8.2 } },
          { effect: 'depth_of_field', decision: 'skip', reason: 'no circle of confusion reaches a quarter of a pixel <b>', bound: { luminance: 0.1, thresholds: 0.2 } },
          { effect: 'refraction', decision: 'simplify', reason: 'seen only in mirrors', bound: { luminance: 0.5, thresholds: 0.6 } },
        ],
        picture: writer.add((u, v, channel, x, y) =>
          picture(u, v, channel) + 0.012 * error * (1 + u) * noise(x, y, frame, number), 3, 'f16'),
        maps: {
          'samples.Y': writer.add(formulas['samples.Y'](frame, error), 1, 'f16'),
          'judge.colorvideovdp': writer.add(formulas['judge.colorvideovdp'](frame, error), 1, 'f32'),
        },
      };
    }),
  };
}

const walk = [
  { title: 'Motion', text: 'How far the point moves until the next frame.', channels: [
    { name: 'forward.u', title: 'to the right', unit: 'pixels' }, { name: 'velocity.image', title: 'velocity', unit: 'degrees/s' }] },
  { title: 'Bands', text: 'Contrast in each band of spatial frequency, and the elevation of its threshold.', bands: {
    frequency: frequencies, channels: frequencies.map((_, i) => `band.${i}`), elevation: frequencies.map((_, i) => `elevation.${i}`) } },
  { title: 'Aleph', text: 'How many times the threshold is raised.', channels: [{ name: 'aleph.Y', title: 'Aleph map', unit: 'times' }] },
  { title: 'Threshold', text: 'The least difference of luminance that a viewer can see here.', channels: [
    { name: 'threshold.Y', title: 'visible threshold', unit: 'cd/m²' }] },
  { title: 'Effort', text: 'What the variant spent.', channels: [
    { name: 'samples.Y', title: 'samples', unit: '' }, { name: 'not.stored', title: 'absent', unit: '' }] },
];

/** The study, and the texts of its layers. @param {{width: number, height: number}} size */
export function makeStudy(size) {
  const writer = layerWriter(size);
  const study = {
    schema_version: 1, title: 'sample: error against time', description: 'A synthetic study: every value comes from a formula.',
    scene: 'scenes/sample/scene.json', command: 'aleph study sample --sweep error=0.5,1,2 --sweep guide=none,saliency',
    date: '2026-11-23T08:00:00Z', host: { name: 'sample', processor: 'Sample processor', threads: 2, memory_mib: 24000 },
    build: { version: '0.1.0', compiler: 'GCC 12.2' }, ...size, frames, display_white: 100,
    reference: { kind: 'gather', passes: 4, note: 'Its noise is a tenth of a visible threshold.' },
    axes: [{ setting: 'error', values: errors }, { setting: 'guide', values: guides }],
    metrics: [
      { name: 'processor_seconds', title: 'processor seconds', unit: 's', log: true },
      { name: 'share_beyond', title: 'pixels beyond one visible threshold', unit: '%', log: true },
      { name: 'relative_mse', title: 'relative mean squared error', log: true },
      { name: 'seed_flicker', title: 'flicker of two seeds', unit: '%' },
    ],
    variants: errors.flatMap(error => guides.map(guide => variantOf(writer, error, guide))),
    pictures: frames.map(frame => ({
      frame, reference: writer.add(formulas.reference(frame), 3, 'f16'),
      maps: {
        ...Object.fromEntries(['threshold.Y', 'aleph.Y', 'velocity.image', 'forward.u'].map(name =>
          [name, writer.add(formulas[name](frame), 1, name === 'aleph.Y' ? 'f16' : 'f32')])),
        ...Object.fromEntries(frequencies.flatMap((_, i) => [
          [`band.${i}`, writer.add((u, v) => 0.02 * (i + 1) * u + 0.001, 1, 'f16')],
          [`elevation.${i}`, writer.add((u, v) => 1 + v * (6 - i), 1, 'f16')]])),
      },
    })),
    maps: [
      { name: 'threshold.Y', title: 'Visible threshold', unit: 'cd/m²', scale: 'log' },
      { name: 'aleph.Y', title: 'Aleph map', unit: 'times', scale: 'log', low: 1, high: 250 },
      { name: 'velocity.image', title: 'Velocity in the picture', unit: 'degrees/s', scale: 'diverging' },
      { name: 'samples.Y', title: 'Samples', unit: '', scale: 'linear' },
      { name: 'judge.colorvideovdp', title: 'ColorVideoVDP', unit: 'JOD', scale: 'linear' },
    ],
    walk,
    ledger: [{ scene: 'sample', seconds: { value: 1.5, error: 0.1 }, seen: { value: 0.7 }, effects: [
      { effect: 'area_shadows', decision: 'simulate', bound: 0, seconds: { value: 0.25, error: 0.02 }, seen: { value: 41 } },
      { effect: 'refraction', decision: 'skip', bound: null, seconds: null, seen: null },
    ] }],
    judges: [{ name: 'colorvideovdp', map: 'judge.colorvideovdp', limit: 1 }],
  };
  return { study, layers: writer.texts };
}

/** The page with the study in it. @param {string} template  the text of report-template.html */
export function fillTemplate(template, { study, layers }) {
  const data = `<script id="study" type="application/json">${JSON.stringify(study).replaceAll('<', '\\u003c')}</script>`;
  const elements = layers.map((text, i) => `<script type="text/plain" id="layer-${i}">${text}</script>`).join('\n');
  return template.replace('<!-- STUDY DATA -->', () => data).replace('<!-- STUDY LAYERS -->', () => elements);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [template, out] = process.argv.slice(2);
  fs.writeFileSync(out, fillTemplate(fs.readFileSync(template, 'utf8'), makeStudy({ width: 96, height: 64 })));
}
