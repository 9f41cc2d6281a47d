// Light or dark: as the system says, or as chosen.
import { byId } from './dom.js';

const next = { system: 'light', light: 'dark', dark: 'system' };
const key = 'aleph report theme';

/** Makes the theme button work. The choice is kept where the browser allows it. */
export function enableTheme() {
  const button = byId('theme');
  const show = theme => {
    if (theme === 'system') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
    button.textContent = `Theme: ${theme}`;
    button.dataset.theme = theme;
  };
  show(next[read()] ? read() : 'system');
  button.addEventListener('click', () => {
    const theme = next[button.dataset.theme];
    show(theme);
    try {
      localStorage.setItem(key, theme);
    } catch { /* storage is blocked: the choice holds until the page is closed */ }
  });
}

function read() {
  try {
    return localStorage.getItem(key) ?? 'system';
  } catch {
    return 'system';
  }
}
