// The head of the page: what was asked, of what, and how.
import { byId, fill, make } from './dom.js';
import { number, settingText } from './format.js';

const line = parts => parts.filter(part => part !== undefined && part !== null && part !== '').join(', ');

const counted = (count, one, many = `${one}s`) => `${count} ${count === 1 ? one : many}`;

export function showHead(study) {
  document.title = study.title ?? 'Study';
  fill(byId('title'), study.title ?? 'Study');
  fill(byId('description'), study.description ?? '');
  const host = study.host ?? {};
  const build = study.build ?? {};
  const facts = [
    ['Scene', line([study.scene, study.frames.length > 0 && `${study.frames.length === 1 ? 'frame' : 'frames'} ${study.frames.join(', ')}`, `${study.width} × ${study.height} pixels`])],
    ['Reference', study.reference && line([study.reference.kind, study.reference.passes && counted(study.reference.passes, 'pass', 'passes')])],
    ['Machine', line([host.processor ?? host.name, host.threads && counted(host.threads, 'thread')])],
    ['Build', build.version],
    ['Made', study.date && dateText(study.date)],
  ].filter(([, text]) => text);
  fill(byId('facts'), ...facts.map(fact));

  const details = [
    ['Command', study.command && make('code', {}, study.command)],
    ['Noise of the reference', study.reference?.note],
    ['Display', study.display_white && `white is ${number(study.display_white)} cd/m²`],
    ['Settings varied', study.axes.map(axis => `${axis.setting}: ${axis.values.map(settingText).join(', ')}`).join('; ')],
    ['Host', line([host.name, host.processor, host.threads && counted(host.threads, 'thread'), host.memory_mib && `${number(host.memory_mib)} MiB`])],
    ['Compiler', build.compiler],
  ].filter(([, value]) => value);
  fill(byId('details-body'), make('dl', { class: 'facts details' }, ...details.map(fact)));
}

function fact([title, value]) {
  return make('div', {}, make('dt', {}, title), make('dd', {}, value));
}

function dateText(date) {
  const time = new Date(date);
  return Number.isNaN(time.getTime()) ? date : time.toLocaleString('en-GB', { dateStyle: 'long', timeStyle: 'short' });
}
