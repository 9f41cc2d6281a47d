// Elements of the page.

/**
 * Makes an element. Properties that start with "on" are listeners; null and false leave a property out.
 * @param {...(Node|string|number|null)} children  text is never read as HTML
 */
export function make(tag, properties = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? '' : String(value));
  }
  node.append(...children.filter(child => child !== null && child !== undefined).map(child =>
    child instanceof Node ? child : String(child)));
  return node;
}

/**
 * Makes a table whose rows begin with a head.
 * @param {Array<[string, string?]>} heads  titles, and the classes of their columns
 * @param {Array<{cells: Array<Node|string|number>}>} rows  with properties of the row beside its cells
 */
export function makeTable(properties, heads, rows) {
  const body = rows.map(({ cells: [first, ...others], ...row }) => make('tr', row, make('th', { scope: 'row' }, first),
    ...others.map((cell, i) => make('td', { class: heads[i + 1][1] }, cell))));
  return make('table', properties,
    make('thead', {}, make('tr', {}, ...heads.map(([title, name]) => make('th', { scope: 'col', class: name }, title)))),
    make('tbody', {}, ...body));
}

export function byId(id) {
  return document.getElementById(id);
}

/** Replaces what an element holds. */
export function fill(node, ...children) {
  node.replaceChildren(...children.filter(child => child !== null && child !== undefined));
}

/** Tells screen readers of a change. */
export function announce(text) {
  byId('live').textContent = text;
}
