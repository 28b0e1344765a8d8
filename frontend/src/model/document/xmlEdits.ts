import type { Splice } from './splice';
import { escaped, type XmlElement } from './xml';

const cut = (text: string, start: number, end: number, inserted = ''): Splice => ({
  at: start,
  removed: text.slice(start, end),
  inserted,
});

/** Sets the value of an attribute; its quotes, its place and all other attributes stay. */
export function setAttribute(text: string, element: XmlElement, name: string, value: string): Splice {
  const own = element.attributes.get(name);
  if (!own) return cut(text, element.headEnd, element.headEnd, ` ${name}="${escaped(value)}"`);
  const quote = text[own.start - 1];
  return cut(
    text,
    own.start,
    own.end,
    quote === "'" ? escaped(value).replace(/'/g, '&apos;') : escaped(value),
  );
}

/** Appends an element to another one, on a line of its own if the other children have their own lines. */
export function append(text: string, parent: XmlElement, written: string): Splice {
  if (parent.close === null) {
    return cut(text, parent.headEnd, parent.end, `>${written}</${parent.tag}>`);
  }
  const last = parent.children.at(-1);
  const lineStart = text.lastIndexOf('\n', parent.close - 1) + 1;
  const before = text.slice(lineStart, parent.close);
  if (before.trim() !== '') return cut(text, parent.close, parent.close, written);
  const lastStart = last ? text.lastIndexOf('\n', last.start - 1) + 1 : 0;
  const indent = last ? text.slice(lastStart, last.start) : `${before}  `;
  const margin = indent.trim() === '' ? indent : `${before}  `;
  const lines = written.split('\n').map((line) => `${margin}${line}\n`);
  return cut(text, lineStart, lineStart, lines.join(''));
}

/** Inserts an element as the first child of another one. */
export function prepend(text: string, parent: XmlElement, written: string): Splice {
  const [first] = parent.children;
  if (!first) return append(text, parent, written);
  const lineStart = text.lastIndexOf('\n', first.start - 1) + 1;
  const indent = text.slice(lineStart, first.start);
  const isOwnLine = indent.trim() === '';
  return cut(text, first.start, first.start, isOwnLine ? `${written}\n${indent}` : written);
}

/** Removes an element, and its line if nothing else is on it. */
export function removed(text: string, { start, end }: XmlElement): Splice {
  const lineStart = text.lastIndexOf('\n', start - 1) + 1;
  const next = text.indexOf('\n', end);
  const lineEnd = next < 0 ? text.length : next;
  const isAlone = text.slice(lineStart, start).trim() === '' && text.slice(end, lineEnd).trim() === '';
  return isAlone && lineEnd < text.length ? cut(text, lineStart, lineEnd + 1) : cut(text, start, end);
}

export const replaced = (text: string, { start, end }: XmlElement, written: string): Splice =>
  cut(text, start, end, written);
