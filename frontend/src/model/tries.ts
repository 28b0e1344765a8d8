/** The values that *Try many* tries. */

import { choicesOf, widgetOf, type PortSpec } from './ports';
import { fit, type Fit } from './values';

/** So many values at most are tried at once, as the session takes them. */
export const MOST_VALUES = 50;
export const LONGEST_S = 120;

export interface Range {
  readonly from: string;
  readonly to: string;
  readonly count: string;
}

/** Why values cannot be tried. */
export type TriesProblem = 'none' | 'tooMany' | 'noNumber' | 'badCount' | 'badSeed' | 'bad';

const isNumeric = (type: string) => ['number', 'integer'].includes(widgetOf(type));

/** Whether a range of values makes sense for a port. */
export const takesRange = (port: PortSpec): boolean => isNumeric(port.type);

/** Returns the range that is offered first: around the present value, or from 0 to 1. */
export function rangeAround(port: PortSpec, value: string | null): Range {
  const now = Number(value ?? port.default ?? '');
  const middle = Number.isFinite(now) && now !== 0 ? now : 1;
  const [from, to] = [shown(middle * 0.5, port.type), shown(middle * 1.5, port.type)];
  return { from, to, count: '5' };
}

/** Returns the list that is offered first: all choices, or nothing. */
export const listFor = (port: PortSpec): string =>
  (widgetOf(port.type) === 'boolean' ? ['true', 'false'] : choicesOf(port.type)).join('\n');

/** The largest seed, as the session takes them. */
export const LARGEST_SEED = 2 ** 32 - 1;

/** Returns so many seeds, one after the other. */
export function seedsFrom(first: string, count: string): readonly string[] | TriesProblem {
  const [from, most] = [first, count].map((part) => (part.trim() === '' ? Number.NaN : Number(part))) as [
    number,
    number,
  ];
  if (!Number.isInteger(most) || most < 1) return 'badCount';
  if (most > MOST_VALUES) return 'tooMany';
  if (!Number.isInteger(from) || from < 0 || from + most - 1 > LARGEST_SEED) return 'badSeed';
  return Array.from({ length: most }, (_, at) => String(from + at));
}

function shown(value: number, type: string): string {
  return String(widgetOf(type) === 'integer' ? Math.round(value) : Number(value.toPrecision(6)));
}

/** Returns the values of a range, the ends among them, without repetitions. */
export function valuesOfRange(range: Range, type: string): readonly string[] | TriesProblem {
  const [from, to, count] = [range.from, range.to, range.count].map((text) =>
    text.trim() === '' ? Number.NaN : Number(text),
  ) as [number, number, number];
  if (!Number.isFinite(from) || !Number.isFinite(to)) return 'noNumber';
  if (!Number.isInteger(count) || count < 1) return 'badCount';
  if (count > MOST_VALUES) return 'tooMany';
  const step = count === 1 ? 0 : (to - from) / (count - 1);
  return [...new Set(Array.from({ length: count }, (_, at) => shown(from + at * step, type)))];
}

/** Returns the values of a list: one a line, numbers also between commas; without repetitions. */
export function valuesOfList(text: string, type: string): readonly string[] | TriesProblem {
  const parts = text.split(isNumeric(type) ? /[\n,]/ : /\n/).map((part) => part.trim());
  const values = [...new Set(parts.filter((part) => part !== ''))];
  if (values.length === 0) return 'none';
  return values.length > MOST_VALUES ? 'tooMany' : values;
}

/** Returns how a value fits the port; a key in braces is checked by the session. */
export const fitOf = (port: PortSpec, value: string): Fit =>
  value.startsWith('{') ? 'good' : fit(port.type, value);
