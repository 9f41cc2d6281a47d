// The pictures of the selected variants and the reference: side by side, under a swipe, or blinking.
import { announce, byId, fill, make } from './dom.js';
import { mapImage, pictureImage } from './color.js';
import { readLayer } from './layers.js';
import { showLegend } from './legend.js';
import { makeMap, scaleOf } from './shown_maps.js';
import { paneCaption, paneTitle } from './pane_text.js';
import { drawView, makeStage } from './stage.js';
import { makeHandle, startBlinking } from './two_pictures.js';
import { sharedFrame, variantFrame } from './study.js';

export const reference = 'reference';
const mostPanes = 9;

function canvasOf(imageData) {
  const canvas = make('canvas', { width: imageData.width, height: imageData.height });
  canvas.getContext('2d').putImageData(imageData, 0, 0);
  return canvas;
}

/** Shows the panes, and keeps them as the store says. @param {Array<{group: string, maps: object[]}>} groups  of listMaps */
export function showPanes(study, store, groups) {
  const size = { width: study.width, height: study.height };
  const maps = groups.flatMap(entry => entry.maps);
  const holder = byId('panes');
  let views = []; // {node, stage, items: [{id, canvas, images}]}
  let turn = 0;
  let stopBlinking = () => {};
  let showAll = false;

  const pictureLayer = id => id === reference ? sharedFrame(study, store.values.frame)?.reference
    : variantFrame(study, id, store.values.frame)?.picture;

  const choosePixel = (x, y) => {
    store.set({ cursor: { x, y }, pixel: { x, y } });
    announce(`Values of the pixel at column ${x}, row ${y} are listed under One pixel, step by step`);
  };

  /** Ids that have a picture of the frame, in the order of display. */
  function idsToShow() {
    const { layout, a, b, selected } = store.values;
    return layout === 'side' ? [reference, ...selected].filter(pictureLayer) : [a, b];
  }

  function makeView(ids) {
    const stage = makeStage(store, size, ids.map(id => paneTitle(study, id)).join(' and '), choosePixel);
    const items = ids.map(id => ({ id, canvas: make('canvas', { 'data-pane': id }), images: [] }));
    stage.append(...items.map(item => item.canvas));
    const caption = make('figcaption', {});
    return { key: ids.join('\n'), ids, items, stage, caption, node: make('figure', { class: 'pane' }, stage, caption) };
  }

  function arrange() {
    const { layout } = store.values;
    const wishes = idsToShow();
    const ids = showAll ? wishes : wishes.slice(0, mostPanes);
    const wanted = layout === 'side' ? ids.map(id => [id]) : [ids];
    const old = new Map(holder.dataset.layout === layout ? views.map(view => [view.key, view]) : []);
    const known = views;
    views = wanted.map(list => old.get(list.join('\n')) ?? makeView(list));
    if (views.length !== known.length || views.some((view, i) => view !== known[i])) fill(holder, ...views.map(view => view.node));
    for (const view of known) if (!views.includes(view)) observer.unobserve(view.stage);
    for (const view of views) observer.observe(view.stage);
    holder.dataset.layout = layout;
    stopBlinking();
    stopBlinking = () => {};
    if (layout === 'swipe' && !views[0].handle) views[0].handle = makeHandle(views[0], store);
    if (layout === 'blink') stopBlinking = startBlinking(views[0], store, id => paneTitle(study, id));
    if (layout === 'side') showCount(wishes, wishes.length - ids.length);
    else fill(byId('panes-note'));
    return ids;
  }

  function showCount(wishes, hidden) {
    const { selected, frame } = store.values;
    const absent = selected.filter(id => !wishes.includes(id)).length;
    const showRest = make('button', {
      type: 'button', onclick: () => {
        showAll = true;
        report();
      },
    }, 'Show all');
    fill(byId('panes-note'),
      selected.length === 0 ? 'Select variants in the chart or the table to see their frames.' : null,
      absent > 0 ? `${absent} of the selected variants ${absent === 1 ? 'has' : 'have'} no picture of frame ${frame}. ` : null,
      hidden > 0 ? `${hidden} more selected. ` : null, hidden > 0 ? showRest : null);
  }

  /** Decodes what an item shows and makes its images, a map in the colours of `scale`. */
  async function prepare(item, map, made, scale) {
    const { stops, opacity } = store.values;
    const images = [];
    const layer = pictureLayer(item.id);
    if (layer && (!map || !made || opacity < 1)) {
      images.push({ image: canvasOf(pictureImage(await readLayer(layer), stops)), alpha: 1 });
    }
    if (made) {
      const colors = made.channels === 3 ? pictureImage(made, stops) : mapImage(made, scale);
      images.push({ image: canvasOf(colors), alpha: opacity });
    }
    item.images = images;
    item.made = made;
  }

  const mapOf = (item, map) => map ? makeMap(study, map, item.id === reference ? null : item.id, store.values.frame) : null;

  async function update() {
    const mine = ++turn;
    const ids = arrange();
    const map = maps.find(entry => entry.key === store.values.show) ?? null;
    const chosen = map ? store.values.ranges[map.key] : undefined;
    const all = views.flatMap(view => view.items.map(item => ({ view, item })));
    let scale = map ? scaleOf(map, chosen, []) : null;
    const fromValues = map && map.scale !== 'category' && [map.low ?? chosen?.low, map.high ?? chosen?.high].includes(undefined);
    let made = [];
    if (fromValues) {
      made = await Promise.all(all.map(({ item }) => mapOf(item, map)));
      scale = scaleOf(map, chosen, made.filter(entry => entry && entry.channels !== 3));
    }
    await Promise.all(all.map(async ({ view, item }, i) => {
      const values = fromValues ? made[i] : await mapOf(item, map);
      if (mine !== turn) return;
      await prepare(item, map, values, scale);
      if (mine === turn) draw(view);
    }));
    if (mine !== turn) return;
    showLegend(map, scale, all.map(({ item }) => item.made).filter(Boolean), store);
    holder.dataset.drawn = `${store.values.frame}|${ids.join('|')}`;
    if (performance.getEntriesByName('selection').length > 0) {
      performance.measure('selection to frames', 'selection');
      performance.clearMarks('selection');
    }
  }

  function draw(view) {
    view.stage.style.touchAction = store.values.view.zoom > 1 ? 'none' : 'pan-y';
    for (const item of view.items) drawView(item.canvas, item.images, store.values.view, store.values.cursor, size);
    paneCaption(study, store, view);
  }

  const drawAll = () => views.forEach(draw);
  const observer = new ResizeObserver(entries => {
    for (const entry of entries) views.filter(view => view.stage === entry.target).forEach(draw);
  });
  const report = () => update().catch(error => fill(byId('panes-note'), `The pictures cannot be shown: ${error.message}.`));
  store.on(['selected', 'frame', 'layout', 'a', 'b', 'show', 'opacity', 'stops', 'ranges', 'rate', 'x', 'y'], report);
  store.on(['view', 'cursor'], drawAll);
  report();
}
