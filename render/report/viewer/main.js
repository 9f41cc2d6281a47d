// The viewer test: set-up, trials, results.
import { byId, fill, make } from '../src/dom.js';
import { greyAround, shareOf } from './brightness.js';
import { cardWidth, distanceForOne, scaleFor } from './geometry.js';
import { clear, decode, playPair } from './player.js';
import { drawResults, evaluate } from './results.js';
import { makeTrials, readResults, withoutCopies } from './trials.js';

const data = JSON.parse(byId('test')?.textContent ?? 'null');
const practiceTrials = 3;
const state = { trials: [], at: 0, dropped: 0, setup: null, waiting: null };

function settings() {
  const cardPixels = Number(byId('card-pixels').value);
  const distance = Number(byId('distance').value) * 10;
  return {
    viewer: byId('viewer').value.trim(),
    cardPixels, distance, mmPerPixel: cardWidth / cardPixels,
    white: Number(byId('white').value) || null,
    each: Math.max(1, Math.round(Number(byId('each').value))),
    seed: Math.round(Number(byId('seed').value)) >>> 0,
    practice: byId('practice').checked,
  };
}

/** How a scene is shown: pixels of the screen per pixel, and the share of the screen's luminance. */
function viewOf(scene, { mmPerPixel, distance, white }) {
  return { scale: scaleFor(scene.pixels_per_degree, mmPerPixel, distance), share: shareOf(scene.display_white, white ?? scene.display_white) };
}

/** Says how large and bright a scene's pictures will be, and what would be better. */
function describeView(scene, setup) {
  const { scale, share } = viewOf(scene, setup);
  const width = Math.round(data.width * scale);
  const notes = [`The pictures will be ${width} pixels wide: ${scene.pixels_per_degree} of their pixels to a degree.`];
  const one = Math.round(distanceForOne(scene.pixels_per_degree, setup.mmPerPixel) / 10);
  if (Math.abs(scale - 1) > 0.02)
    notes.push(`They are scaled by ${scale.toFixed(2)}, which blurs noise: sit ${one} cm from the screen, where they are not.`);
  if (width > window.innerWidth) notes.push('They do not fit this window: make it larger, or sit farther away.');
  notes.push(`They are meant for a white of ${scene.display_white} cd/m2.`);
  if (share < 1) notes.push(`The screen is brighter, so they are shown at ${(100 * share).toFixed(0)} % of its luminance.`);
  if (setup.white && setup.white < 0.9 * scene.display_white)
    notes.push(`The screen is darker, and hides some of the errors: make it brighter, or this page with --set viewing.display_white=${setup.white}.`);
  return notes.join(' ');
}

function showSize() {
  const setup = settings();
  byId('card').style.width = `${setup.cardPixels}px`;
  fill(byId('size'), [...new Set(data.scenes.map(scene => describeView(scene, setup)))].join(' '));
}

function showPart(name) {
  for (const part of ['setup', 'trial', 'results']) byId(part).hidden = part !== name;
  byId(name).focus();
}

/** Gives the canvas the size of a scene's pictures, and grey. */
function prepareCanvas(scene) {
  const { scale, share } = viewOf(scene, state.setup);
  const canvas = byId('screen');
  canvas.width = Math.max(1, Math.round(data.width * scale));
  canvas.height = Math.max(1, Math.round(data.height * scale));
  canvas.style.imageRendering = Number.isInteger(scale) ? 'pixelated' : 'auto';
  byId('trial').style.background = greyAround(share);
  clear(canvas, share);
  return canvas;
}

async function begin() {
  state.setup = settings();
  state.pictures = new Map();
  for (const scene of data.scenes) {
    const { share } = viewOf(scene, state.setup);
    const tests = new Map();
    for (const test of scene.tests) tests.set(test.id, await decode(test.frames, share));
    state.pictures.set(scene.name, { reference: await decode(scene.reference, share), tests });
  }
  const tests = data.scenes.flatMap(scene => scene.tests.map(test => ({ ...test, scene: scene.name })));
  const trials = makeTrials(tests, state.setup.each, state.setup.seed);
  const practice = state.setup.practice
    ? makeTrials(tests, 1, state.setup.seed + 1).slice(0, practiceTrials).map(trial => ({ ...trial, practice: true })) : [];
  Object.assign(state, { trials: [...practice, ...trials], at: 0, dropped: 0 });
  showPart('trial');
  await run();
}

async function run() {
  const trial = state.trials[state.at];
  if (!trial) return finish();
  byId('progress').textContent = `${trial.practice ? 'Practice' : 'Trial'} ${state.at + 1} of ${state.trials.length}`;
  const scene = data.scenes.find(one => one.name === trial.scene);
  const { reference, tests } = state.pictures.get(trial.scene);
  const pair = [reference, tests.get(trial.id)];
  if (trial.testInterval === 1) pair.reverse();
  state.waiting = null;
  enableAnswers(false);
  const show = { rate: scene.frames_per_second, share: viewOf(scene, state.setup).share };
  state.dropped += await playPair(prepareCanvas(scene), pair[0], pair[1], show, interval => {
    byId('interval').textContent = interval ? `Sequence ${interval}` : '';
  });
  byId('interval').textContent = 'Which of the two had the errors? Press 1 or 2.';
  state.waiting = performance.now();
  enableAnswers(true);
  return undefined;
}

function enableAnswers(enabled) {
  for (const id of ['answer-1', 'answer-2']) byId(id).disabled = !enabled;
}

function answer(which) {
  if (state.waiting === null) return;
  const trial = state.trials[state.at];
  trial.answer = which;
  trial.milliseconds = Math.round(performance.now() - state.waiting);
  state.waiting = null;
  byId('feedback').textContent = trial.practice ? (which === trial.testInterval ? 'Right.' : `It was ${trial.testInterval}.`) : '';
  ++state.at;
  run();
}

function finish() {
  const trials = state.trials.filter(trial => !trial.practice);
  showResults([{
    schema_version: 2, title: data.title, made: new Date().toISOString(), study_date: data.date, viewer: state.setup.viewer,
    setup: state.setup, frames_dropped: state.dropped, browser: navigator.userAgent, series: data.series, trials,
  }]);
}

/** @param {object[]} all results of one viewer or several; those of one can be saved */
function showResults(all) {
  drawResults(byId('results-body'), all);
  const text = JSON.stringify({ ...(all.length === 1 ? all[0] : {}), ...evaluate(all) }, null, 1);
  const link = make('a', { href: URL.createObjectURL(new Blob([text], { type: 'application/json' })), download: 'viewer-test.json', id: 'save' }, 'Save the results');
  fill(byId('save-place'), all.length === 1 ? link : null);
  byId('results').dataset.results = text;
  showPart('results');
}

async function load(event) {
  const all = [];
  for (const file of event.target.files) {
    try {
      all.push(readResults(await file.text()));
    } catch (error) {
      byId('size').textContent = `${file.name} could not be read: ${error.message}`;
      return;
    }
  }
  if (all.length > 0) showResults(withoutCopies(all));
}

function remember(key, id) {
  try {
    const kept = localStorage.getItem(key);
    if (kept) byId(id).value = kept;
    byId(id).addEventListener('change', () => localStorage.setItem(key, byId(id).value));
  } catch { /* storage is blocked: the reader types it again */ }
}

if (!data) {
  byId('size').textContent = 'This page has no data: `aleph study --viewer-test` writes one that has.';
} else {
  byId('title').textContent = data.title;
  document.title = data.title;
  byId('seed').value = String(Math.floor(Math.random() * 1e6));
  byId('white').placeholder = String(data.scenes[0].display_white);
  byId('distance').value = String(Math.round(distanceForOne(data.scenes[0].pixels_per_degree, settings().mmPerPixel) / 10));
  remember('aleph viewer card', 'card-pixels');
  remember('aleph viewer distance', 'distance');
  remember('aleph viewer white', 'white');
  for (const id of ['card-pixels', 'distance', 'white']) byId(id).addEventListener('input', showSize);
  window.addEventListener('resize', showSize);
  byId('begin').addEventListener('click', begin);
  byId('load').addEventListener('change', load);
  byId('answer-1').addEventListener('click', () => answer(1));
  byId('answer-2').addEventListener('click', () => answer(2));
  byId('again').addEventListener('click', () => showPart('setup'));
  document.addEventListener('keydown', event => {
    if (byId('trial').hidden) return;
    if (event.key === '1' || event.key === '2') answer(Number(event.key));
  });
  showSize();
}
document.body.dataset.ready = 'true';
