// Puts the page together: the head and the table before the first paint, charts and pictures after it.
import { byId, fill } from './dom.js';
import { showChart } from './chart.js';
import { showEffort } from './effort.js';
import { showFrameControls } from './frame_controls.js';
import { showHead } from './head.js';
import { reference, showPanes } from './panes.js';
import { showLedger } from './ledger.js';
import { showPlan } from './plan.js';
import { prefetchPictures } from './prefetch.js';
import { firstSelection } from './selection.js';
import { createStore } from './store.js';
import { listMaps } from './shown_maps.js';
import { readStudy } from './study.js';
import { showTable } from './table.js';
import { enableTheme } from './theme.js';
import { fitted } from './viewport.js';
import { showWalk } from './walk.js';

const firstPaint = () => new Promise(resolve => requestAnimationFrame(() => setTimeout(resolve)));
const allParsed = () => new Promise(resolve => {
  if (document.readyState === 'loading') document.addEventListener('DOMContentLoaded', resolve, { once: true });
  else resolve();
});

function initialValues(study) {
  const x = study.metrics[0]?.name;
  const y = study.metrics[1]?.name ?? x;
  const varied = study.axes.filter(axis => axis.values.length > 1).map(axis => axis.setting);
  const selected = firstSelection(study, x, y);
  const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
  return {
    x, y, over: 'mean', color: varied[0] ?? 'none', shape: varied[1] ?? 'none',
    selected, current: selected[0] ?? null, frame: study.frames[0] ?? study.variants[0]?.frames[0]?.frame,
    layout: 'side', a: study.pictures.some(entry => entry.reference) ? reference : selected[0], b: selected[0] ?? reference, swipe: 0.5, rate: calm ? 0 : 1,
    show: 'picture', opacity: 1, ranges: {}, stops: 0, view: fitted,
    cursor: null, pixel: null,
  };
}

async function start() {
  enableTheme();
  const study = readStudy(byId('study')?.textContent);
  const store = createStore(initialValues(study));
  showHead(study);
  const hasPictures = study.pictures.length > 0 || study.variants.some(variant => variant.frames.some(frame => frame.picture));
  const has = name => study.variants.some(variant => variant.frames.some(frame => frame[name]?.length > 0));
  byId('results').hidden = study.metrics.length === 0;
  byId('pictures').hidden = byId('pixel').hidden = !hasPictures;
  byId('effort').hidden = !has('stages') && !has('rays');
  byId('plan').hidden = !has('plan');
  byId('ledger').hidden = study.ledger.length === 0;
  if (study.metrics.length > 0) showTable(study, store);
  await firstPaint();
  if (study.metrics.length > 0) await showChart(study, store);
  await allParsed();
  if (hasPictures) {
    const groups = listMaps(study);
    showFrameControls(study, store, groups);
    showPanes(study, store, groups);
    showWalk(study, store);
    prefetchPictures(study, store);
  }
  showLedger(study);
  if (has('plan')) showPlan(study, store);
  if (has('stages') || has('rays')) await showEffort(study, store);
  document.documentElement.dataset.ready = 'true';
}

start().catch(error => {
  byId('notice').hidden = false;
  fill(byId('notice'), error.message);
});
