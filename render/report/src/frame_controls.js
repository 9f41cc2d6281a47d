// The controls above the pictures.
import { button, choice, menu, slider } from './controls.js';
import { byId, fill } from './dom.js';
import { number } from './format.js';
import { reference } from './panes.js';
import { paneTitle } from './pane_text.js';
import { fitted, zoomAbout } from './viewport.js';

/** @param {object} study @param {object} store @param {Array<{group: string, maps: object[]}>} groups */
export function showFrameControls(study, store, groups) {
  const { values } = store;
  const holder = byId('frame-controls');

  const draw = () => {
    const focused = holder.contains(document.activeElement) ? document.activeElement : null;
    const name = focused?.name;
    const picked = focused?.value;
    const frames = study.frames.map(frame => [String(frame), String(frame)]);
    const shows = [['picture', 'Picture'], ...groups.map(({ group, maps }) => ({ group, options: maps.map(map => [map.key, map.title]) }))];
    const pictures = [reference, ...study.variants.map(variant => variant.id)].map(id => [id, paneTitle(study, id)]);
    const two = values.layout !== 'side';
    fill(holder,
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
    // The controls are made anew; the focus stays where it was.
    const same = name && [...holder.querySelectorAll('[name]')].find(node =>
      node.type === 'radio' ? node.value === picked && focused.type === 'radio' : node.name === name);
    same?.focus();
  };
  store.on(['layout', 'show', 'selected', 'frame', 'a', 'b'], draw);
  draw();
}

function zoomButtons(store) {
  const group = document.createElement('span');
  group.className = 'buttons';
  const zoom = factor => store.set({ view: zoomAbout(store.values.view, factor) });
  group.append(button('−', () => zoom(1 / 1.5), 'Zoom out'), button('Fit', () => store.set({ view: fitted }), 'Fit the pictures'),
    button('+', () => zoom(1.5), 'Zoom in'));
  return group;
}
