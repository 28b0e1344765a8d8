/**
 * Checks whether a literal matches a port's type, like `translator/values.py`; both are tested on the same
 * cases.
 */

/**
 * The result of a check. `loose`: accepted but read differently (`12abc` as 12); `range`: a number that the
 * type cannot hold.
 */
export type Fit = 'good' | 'loose' | 'range' | 'bad';

const INTEGER = /^-?[0-9]+/;
const UNSIGNED = /^[0-9]+/;
const REAL = /^-?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:e[+-]?[0-9]+)?|inf(?:inity)?|nan(?:\(\w*\))?)/i;
const BOOLEANS = new Set(['0', '1', 'true', 'TRUE', 'True', 'false', 'FALSE', 'False']);
const RANGES = { int: [-(2 ** 31), 2 ** 31 - 1], uint: [0, 2 ** 32 - 1] } as const;
const WORST: readonly Fit[] = ['bad', 'range', 'loose'];

export const STATUSES = ['SUCCESS', 'FAILURE', 'RUNNING', 'SKIPPED'] as const;

/** Returns the names of an enumeration's type (`Color[RED;GREEN]`); null for another type. */
export function namesOf(type: string): readonly string[] | null {
  if (!type.endsWith(']') || type.startsWith('list[')) return null;
  return type.slice(type.indexOf('[') + 1, -1).split(';');
}

/** Returns the name of a type, without the names of an enumeration. */
export const typeLabel = (type: string): string =>
  namesOf(type) === null ? type : (type.split('[')[0] ?? type);

/** Returns the number at the beginning of a literal; null if there is none. */
function numberIn(type: string, text: string): string | undefined {
  if (type === 'double') return REAL.exec(text)?.[0];
  return (type === 'uint' ? UNSIGNED : INTEGER).exec(text)?.[0];
}

/** Returns the parts of a list; a separator at its end adds none. */
const splitList = (text: string): string[] => (text === '' ? [] : text.replace(/;$/, '').split(';'));

export interface Outside {
  readonly number: string;
  readonly low: string;
  readonly high: string;
}

function outsideDouble(number: string): Outside | null {
  const [digits = ''] = number.toLowerCase().split('e');
  if (digits.includes('nan')) return null;
  if (!/[0-9.]$/.test(digits)) return null;
  if (!Number.isFinite(Number(number))) return { number, low: '-1.8e308', high: '1.8e308' };
  const isLost = Number(number) === 0 && /[1-9]/.test(digits);
  return isLost ? { number, low: '4.9e-324', high: '1.8e308' } : null;
}

/**
 * Returns the number in a literal that the type cannot hold, with the limits of the type; null if there is
 * none.
 */
export function outside(type: string, text: string): Outside | null {
  if (type.startsWith('list[')) {
    const found = splitList(text).map((part) => outside(type.slice(5, -1), part));
    return found.find((each) => each !== null) ?? null;
  }
  if (namesOf(type) !== null) return outside('int', text);
  if (type !== 'int' && type !== 'uint' && type !== 'double') return null;
  const number = numberIn(type, text);
  if (number === undefined) return null;
  if (type === 'double') return outsideDouble(number);
  const [low, high] = RANGES[type];
  const isWithin = number.length <= 20 && Number(number) >= low && Number(number) <= high;
  return isWithin ? null : { number, low: String(low), high: String(high) };
}

/** Returns the part of a literal that is read as the value; null if no part is. */
export function partRead(type: string, text: string): string | null {
  if (namesOf(type) !== null) return partRead('int', text);
  if (type !== 'int' && type !== 'uint' && type !== 'double') return null;
  return outside(type, text) ? null : (numberIn(type, text) ?? null);
}

function isJsonList(text: string): boolean {
  try {
    return Array.isArray(JSON.parse(text));
  } catch {
    return false;
  }
}

function fitList(item: string, text: string): Fit {
  if (text === '') return 'good';
  if (text.startsWith('json:')) return isJsonList(text.slice(5)) ? 'good' : 'bad';
  const fits = new Set(splitList(text).map((part) => fit(item, part)));
  return WORST.find((each) => fits.has(each)) ?? 'good';
}

/** Returns how well a literal matches a type of the catalogue; a type without a check matches everything. */
export function fit(type: string, text: string): Fit {
  if (type.startsWith('list[')) return fitList(type.slice(5, -1), text);
  const names = namesOf(type);
  if (names !== null) return names.includes(text) ? 'good' : fit('int', text);
  switch (type) {
    case 'int':
    case 'uint':
    case 'double': {
      if (outside(type, text)) return 'range';
      const read = partRead(type, text);
      if (read === null) return 'bad';
      return read.length === text.length ? 'good' : 'loose';
    }
    case 'bool':
      return BOOLEANS.has(text) ? 'good' : 'bad';
    case 'status':
      return STATUSES.some((each) => each === text) ? 'good' : 'bad';
    default:
      return 'good';
  }
}
