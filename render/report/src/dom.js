// Elements of the page.

/**
 * Makes an element. Properties that start with "on" are listeners; null and false leave a property out.
 * Children are nodes or text; text is never read as HTML.
 * @param {string} tag
 * @param {Object<string, any>} [properties]
 * @param {...(Node|string|number|null)} children
 * @returns {HTMLElement}
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

/** @param {string} id */
export function byId(id) {
  return document.getElementById(id);
}

/** Replaces what an element holds. @param {Element} node @param {...(Node|string|null)} children */
export function fill(node, ...children) {
  node.replaceChildren(...children.filter(child => child !== null && child !== undefined));
}

/** Tells screen readers of a change. @param {string} text */
export function announce(text) {
  byId('live').textContent = text;
}
