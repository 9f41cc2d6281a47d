// Draws Vega-Lite charts in the colours of the page.
import { compile } from 'vega-lite';
import { Handler } from 'vega-tooltip';
import { parse, View, Warn } from 'vega';

// Colours are names of the style sheet, so charts follow the theme and the printer without being drawn anew.
const config = {
  background: 'transparent',
  font: 'system-ui, sans-serif',
  axis: {
    labelColor: 'var(--ink-2)', titleColor: 'var(--ink)', gridColor: 'var(--line)', domainColor: 'var(--line-2)',
    tickColor: 'var(--line-2)', labelFontSize: 12, titleFontSize: 13, titleFontWeight: 500,
  },
  legend: { labelColor: 'var(--ink-2)', titleColor: 'var(--ink)', labelFontSize: 12, titleFontSize: 12, symbolBaseFillColor: 'var(--ink-2)', symbolOpacity: 1 },
  title: { color: 'var(--ink)', fontSize: 13, fontWeight: 500, anchor: 'start', frame: 'group' },
  view: { stroke: 'var(--line)' },
};

const views = new WeakMap();
const tooltip = new Handler({ disableDefaultStyle: true });

/** Draws a chart into an element, in place of the one there. @param {object} spec  a Vega-Lite specification */
export async function drawChart(node, spec) {
  views.get(node)?.finalize();
  const compiled = compile({ ...spec, config }).spec;
  const view = new View(parse(compiled), { renderer: 'svg', logLevel: Warn }).tooltip(tooltip.call);
  views.set(node, view);
  node.replaceChildren();
  await view.initialize(node).runAsync();
  // The element is an image with a label, and a table holds the same values: screen readers skip the marks.
  node.querySelector('svg').setAttribute('aria-hidden', 'true');
  return view;
}

/** Calls draw when the width of an element has changed and stays for a moment. */
export function onResize(node, draw) {
  let width = node.clientWidth;
  let timer = 0;
  new ResizeObserver(() => {
    if (Math.abs(node.clientWidth - width) < 2) return;
    width = node.clientWidth;
    clearTimeout(timer);
    timer = setTimeout(draw, 80);
  }).observe(node);
}

/** Colours of numbers in order. @param {number} place  0 to 1 */
export function rampColor(place) {
  return `color-mix(in oklch, var(--ramp-low), var(--ramp-high) ${Math.round(100 * place)}%)`;
}

/** Colours of named categories, the same in light and dark. */
export const seriesColors = [1, 2, 3, 4, 5, 6, 7, 8].map(number => `var(--series-${number})`);
