/** Whether a literal suits the type of a port: `translator/values.py` in TypeScript, by the same cases. */

/** `loose` is taken, but not as it reads (`12abc` as 12). */
export type Fit = 'good' | 'loose' | 'bad';

const INTEGER = /^-?[0-9]+/;
const UNSIGNED = /^[0-9]+/;
const REAL = /^-?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:e[+-]?[0-9]+)?|inf(?:inity)?|nan)/i;
const BOOLEANS = new Set(['0', '1', 'true', 'TRUE', 'True', 'false', 'FALSE', 'False']);
const RANGES = { int: [-(2 ** 31), 2 ** 31 - 1], uint: [0, 2 ** 32 - 1] } as const;
const WORST: readonly Fit[] = ['bad', 'loose'];

export const STATUSES = ['SUCCESS', 'FAILURE', 'RUNNING', 'SKIPPED'] as const;

/** The part of a literal that is read as a value of the type; null where none is. */
export function partRead(type: string, text: string): string | null {
  if (type === 'double') return REAL.exec(text)?.[0] ?? null;
  if (type !== 'int' && type !== 'uint') return null;
  const read = (type === 'uint' ? UNSIGNED : INTEGER).exec(text)?.[0];
  const [low, high] = RANGES[type];
  const isWithin = read !== undefined && read.length <= 20 && Number(read) >= low && Number(read) <= high;
  return isWithin ? read : null;
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
  const fits = new Set(text.split(';').map((part) => fit(item, part)));
  return WORST.find((each) => fits.has(each)) ?? 'good';
}

/** How a literal suits a type of the catalogue; types without a check suit everything. */
export function fit(type: string, text: string): Fit {
  if (type.startsWith('list[')) return fitList(type.slice(5, -1), text);
  switch (type) {
    case 'int':
    case 'uint':
    case 'double': {
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
