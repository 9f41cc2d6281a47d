// The controls above the pictures.
import { button, choice, menu, refill, slider } from './controls.js';
import { byId, make } from './dom.js';
import { number } from './format.js';
import { reference } from './panes.js';
import { paneTitle } from './pane_text.js';
import { fitted, zoomAbout } from './viewport.js';

/** @param {object} study @param {object} store @param {Array<{group: string, maps: object[]}>} groups */
export function showFrameControls(study, store, groups) {
  const { values } = store;
  const draw = () => {
    const frames = study.frames.map(frame => [String(frame), String(frame)]);
    const shows = [['picture', 'Picture'], ...groups.map(({ group, maps }) => ({ group, options: maps.map(map => [map.key, map.title]) }))];
    const pictures = [reference, ...study.variants.map(variant => variant.id)].map(id => [id, paneTitle(study, id)]);
    const two = values.layout !== 'side';
    refill(byId('frame-controls'),
      menu('Frame', frames, String(values.frame), frame => store.set({ frame: Number(frame) })),
      choice('Layout', [['side', 'Side by side'], ['swipe', 'Swipe'], ['blink', 'Blink']], values.layout, layout => store.set({ layout })),
      two ? menu('A', pictures, values.a, a => store.set({ a })) : null,
      two ? menu('B', pictures, values.b, b => store.set({ b })) : null,
      values.layout === 'blink' ? slider('Rate', {
        min: 0, max: 4, step: 0.5, value: values.rate, show: rate => rate > 0 ? `${rate} Hz` : 'stopped (key B)',
      }, rate => store.set({ rate })) : null,
      menu('Show', shows, values.show, show => store.set({ show })),
      values.show === 'picture' ? null : slider('Map over picture', {
        min: 0, max: 1, step: 0.05, value: values.opacity, show: value => `${Math.round(100 * value)} %`,
      }, opacity => store.set({ opacity })),
      slider('Exposure', {
        min: -6, max: 6, step: 0.25, value: values.stops, show: stops => `${stops > 0 ? '+' : ''}${number(stops)} stops`,
      }, stops => store.set({ stops })),
      zoomButtons(store));
  };
  store.on(['layout', 'show', 'selected', 'frame', 'a', 'b'], draw);
  draw();
}

function zoomButtons(store) {
  const zoom = factor => store.set({ view: zoomAbout(store.values.view, factor) });
  return make('span', { class: 'buttons' }, button('−', () => zoom(1 / 1.5), 'Zoom out'),
    button('Fit', () => store.set({ view: fitted }), 'Fit the pictures'), button('+', () => zoom(1.5), 'Zoom in'));
}
