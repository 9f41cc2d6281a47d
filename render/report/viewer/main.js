// The viewer test: set-up, trials, results.
import { byId, fill, make } from '../src/dom.js';
import { cardWidth, distanceForOne, scaleFor } from './geometry.js';
import { clear, decode, playPair } from './player.js';
import { fit } from './psychometric.js';
import { drawResults } from './results.js';
import { byLevel, makeTrials, summarize } from './trials.js';

const data = JSON.parse(byId('test')?.textContent ?? 'null');
const practiceTrials = 3;
const state = { trials: [], at: 0, dropped: 0, setup: null, waiting: null };

function settings() {
  const cardPixels = Number(byId('card-pixels').value);
  const distance = Number(byId('distance').value) * 10;
  const mmPerPixel = cardWidth / cardPixels;
  return {
    cardPixels, distance, mmPerPixel,
    scale: scaleFor(data.pixels_per_degree, mmPerPixel, distance),
    each: Math.max(1, Math.round(Number(byId('each').value))),
    seed: Math.round(Number(byId('seed').value)) >>> 0,
    practice: byId('practice').checked,
  };
}

/** Says how large the pictures will be, and what would be better. */
function showSize() {
  const { cardPixels, mmPerPixel, scale } = settings();
  byId('card').style.width = `${cardPixels}px`;
  const width = Math.round(data.width * scale);
  const notes = [`The pictures will be ${width} pixels wide: ${data.pixels_per_degree} of their pixels to a degree.`];
  const one = Math.round(distanceForOne(data.pixels_per_degree, mmPerPixel) / 10);
  if (Math.abs(scale - 1) > 0.02) notes.push(`They are scaled by ${scale.toFixed(2)}; from ${one} cm they would not be.`);
  if (width > window.innerWidth) notes.push('They do not fit this window: make it larger, or sit farther away.');
  byId('size').textContent = notes.join(' ');
}

function showPart(name) {
  for (const part of ['setup', 'trial', 'results']) byId(part).hidden = part !== name;
  byId(name).focus();
}

async function begin() {
  state.setup = settings();
  const canvas = byId('screen');
  canvas.width = Math.max(1, Math.round(data.width * state.setup.scale));
  canvas.height = Math.max(1, Math.round(data.height * state.setup.scale));
  canvas.style.imageRendering = Number.isInteger(state.setup.scale) ? 'pixelated' : 'auto';
  clear(canvas);
  state.pictures = new Map([['reference', await decode(data.reference.frames)]]);
  for (const test of data.tests) state.pictures.set(test.id, await decode(test.frames));
  const trials = makeTrials(data.tests, state.setup.each, state.setup.seed);
  const practice = state.setup.practice
    ? makeTrials(data.tests, 1, state.setup.seed + 1).slice(0, practiceTrials).map(trial => ({ ...trial, practice: true })) : [];
  Object.assign(state, { trials: [...practice, ...trials], at: 0, dropped: 0 });
  showPart('trial');
  await run();
}

async function run() {
  const trial = state.trials[state.at];
  if (!trial) return finish();
  byId('progress').textContent = `${trial.practice ? 'Practice' : 'Trial'} ${state.at + 1} of ${state.trials.length}`;
  const pair = [state.pictures.get('reference'), state.pictures.get(trial.id)];
  if (trial.testInterval === 1) pair.reverse();
  state.waiting = null;
  enableAnswers(false);
  state.dropped += await playPair(byId('screen'), pair[0], pair[1], data.frames_per_second, interval => {
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
  showResults({
    schema_version: 1, title: data.title, made: new Date().toISOString(), study_date: data.date, setup: state.setup,
    frames_dropped: state.dropped, browser: navigator.userAgent, trials,
  });
}

function showResults(results) {
  const rows = summarize(results.trials);
  const fitted = fit(byLevel(rows), results.setup?.seed ?? 1);
  drawResults(byId('results-body'), { rows, levels: byLevel(rows), fitted, level: data.level, dropped: results.frames_dropped });
  const text = JSON.stringify({ ...results, rows, fit: fitted }, null, 1);
  const link = make('a', { href: URL.createObjectURL(new Blob([text], { type: 'application/json' })), download: 'viewer-test.json', id: 'save' }, 'Save the results');
  fill(byId('save-place'), link);
  byId('results').dataset.results = text;
  showPart('results');
}

async function load(event) {
  const [file] = event.target.files;
  if (!file) return;
  try {
    const results = JSON.parse(await file.text());
    if (results.schema_version !== 1 || !Array.isArray(results.trials)) throw new Error('not results of this test');
    showResults(results);
  } catch (error) {
    byId('size').textContent = `${file.name} could not be read: ${error.message}`;
  }
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
  remember('aleph viewer card', 'card-pixels');
  remember('aleph viewer distance', 'distance');
  for (const id of ['card-pixels', 'distance']) byId(id).addEventListener('input', showSize);
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
