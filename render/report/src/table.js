// The table of all variants, with the same selection as the chart, and its CSV file.
import { chartPoints } from './chart_points.js';
import { button } from './controls.js';
import { byId, fill, make } from './dom.js';
import { settingText, withError, withUnit } from './format.js';
import { select, selectionText, toggleSelected } from './selection.js';
import { metricOf } from './study.js';

const variantColumn = { key: 'variant', title: 'variant', of: variant => variant.label, text: variant => variant.label };

/**
 * Columns: the variant where it has a name of its own, then settings, then metrics. `of` gives what is compared when
 * sorting.
 */
function columnsOf(study) {
  return [
    ...study.variants.some(variant => !variant.swept) ? [variantColumn] : [],
    ...study.axes.map(axis => ({
      key: `setting:${axis.setting}`, title: axis.setting, of: variant => variant.settings[axis.setting],
      text: variant => settingText(variant.settings[axis.setting]),
    })),
    ...study.metrics.map(metric => ({
      key: `metric:${metric.name}`, title: withUnit(metric), numeric: true, name: metric.name,
      of: (variant, over) => metricOf(variant, metric.name, over)?.value,
      text: (variant, over) => withError(metricOf(variant, metric.name, over)),
    })),
  ];
}

function compare(a, b) {
  if (a === undefined || b === undefined) return (a === undefined) - (b === undefined);
  if (typeof a === 'number' && typeof b === 'number') return a - b;
  return String(a).localeCompare(String(b), 'en', { numeric: true });
}

export function showTable(study, store) {
  const { values } = store;
  const columns = columnsOf(study);
  const holder = byId('table');
  let sort = { key: null, down: false };
  let focused = study.variants[0]?.id; // the row that Tab reaches

  const rowsInOrder = () => {
    const column = columns.find(entry => entry.key === sort.key);
    if (!column) return study.variants;
    const order = [...study.variants].sort((a, b) => compare(column.of(a, values.over), column.of(b, values.over)));
    return sort.down ? order.reverse() : order;
  };

  const header = column => {
    const sorted = sort.key === column.key;
    return make('th', { scope: 'col', class: column.numeric ? 'numeric' : null, 'aria-sort': sorted ? (sort.down ? 'descending' : 'ascending') : 'none' },
      make('button', {
        type: 'button', 'data-sort': column.key, onclick: () => {
          sort = { key: column.key, down: sorted && !sort.down };
          draw();
          holder.querySelector(`[data-sort="${CSS.escape(column.key)}"]`).focus();
        },
      }, column.title, make('span', { 'aria-hidden': 'true', class: 'arrow' }, sorted ? (sort.down ? ' ↓' : ' ↑') : '')));
  };

  const row = variant => make('tr', {
    'data-variant': variant.id, tabindex: variant.id === focused ? 0 : -1,
    'aria-selected': String(values.selected.includes(variant.id)),
    onclick: event => {
      focus(variant.id);
      if (event.shiftKey || event.ctrlKey || event.metaKey || event.target.closest('.mark')) toggleSelected(study, store, variant.id);
      else select(study, store, [variant.id]);
    },
    onkeydown: event => {
      if (event.target === event.currentTarget) onKey(event, variant.id);
    },
  }, make('td', { class: 'mark' }, make('span', { class: 'box', 'aria-hidden': 'true' })),
  ...columns.map(column => make('td', {
    class: column.numeric ? 'numeric' : null, 'data-column': column.key, 'data-value': column.of(variant, values.over),
  }, column.text(variant, values.over), column === columns[0] && variant.pareto
    ? make('span', { class: 'badge', title: 'on the Pareto front of the default metrics' }, 'front') : null)));

  const focus = id => {
    focused = id;
    for (const node of holder.querySelectorAll('tr[data-variant]')) node.tabIndex = node.dataset.variant === id ? 0 : -1;
    holder.querySelector(`tr[data-variant="${CSS.escape(id)}"]`).focus();
  };

  const onKey = (event, id) => {
    const order = rowsInOrder().map(variant => variant.id);
    const at = order.indexOf(id);
    const target = { ArrowUp: at - 1, ArrowDown: at + 1, Home: 0, End: order.length - 1 }[event.key];
    if (target !== undefined) {
      if (order[target]) focus(order[target]);
      if (event.shiftKey && order[target]) select(study, store, [...values.selected, order[target]]);
    } else if (event.key === ' ') toggleSelected(study, store, id);
    else if (event.key === 'Enter') select(study, store, [id]);
    else return;
    event.preventDefault();
  };

  const draw = () => {
    fill(holder, make('table', { role: 'grid', 'aria-multiselectable': 'true', 'aria-label': 'Variants' },
      make('thead', {}, make('tr', {}, make('th', { scope: 'col' }, make('span', { class: 'visually-hidden' }, 'Selected')), ...columns.map(header))),
      make('tbody', {}, ...rowsInOrder().map(row))));
  };
  const mark = () => {
    for (const node of holder.querySelectorAll('tr[data-variant]')) {
      node.setAttribute('aria-selected', String(values.selected.includes(node.dataset.variant)));
    }
    byId('selection').textContent = selectionText(study, values.selected);
  };
  store.on(['over'], draw);
  store.on(['selected'], mark);
  draw();
  mark();
  fill(byId('table-buttons'),
    button('Select all', () => select(study, store, study.variants.map(variant => variant.id))),
    button('Select the front', () => select(study, store, chartPoints(study, values).front.map(point => point.id))),
    button('Download as CSV', () => download('study.csv', tableText(study, columns, values.over))));
}

/** The table as CSV (RFC 4180): settings, then each metric and its standard error, in full precision. */
function tableText(study, shown, over) {
  const columns = shown.filter(column => column !== variantColumn);
  const quote = value => /[",\n\r]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value;
  const plain = value => value === undefined || value === null ? '' : settingText(value);
  const names = ['id', ...columns.flatMap(column => column.name ? [column.title, `${column.title}: standard error`] : [column.title])];
  const lines = study.variants.map(variant => [variant.id, ...columns.flatMap(column => column.name
    ? [plain(column.of(variant, over)), plain(metricOf(variant, column.name, over)?.error)] : [plain(column.of(variant, over))])]);
  return [names, ...lines].map(line => line.map(quote).join(',')).join('\r\n') + '\r\n';
}

function download(name, text) {
  const address = URL.createObjectURL(new Blob([text], { type: 'text/csv' }));
  make('a', { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
