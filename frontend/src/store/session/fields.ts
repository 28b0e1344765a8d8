/** A value in a message, with its path: `pose.position.x`, `ranges[3]`. */
export interface Field {
  path: string;
  name: string;
  value: unknown;
  depth: number;
  /** Whether the value contains other values, which follow it. */
  isParent: boolean;
}

/** The number of elements that are shown of a list. */
const SHOWN_ELEMENTS = 64;

/** Returns the fields of a message as rows, in order, without those below a folded path. */
export function fieldsOf(message: unknown, isFolded: (path: string) => boolean): Field[] {
  const rows: Field[] = [];
  const visit = (value: unknown, path: string, name: string, depth: number) => {
    const isParent = typeof value === 'object' && value !== null;
    rows.push({ path, name, value, depth, isParent });
    if (isParent && !isFolded(path)) visitChildren(value, path, depth + 1);
  };
  const visitChildren = (value: object, path: string, depth: number) => {
    if (Array.isArray(value)) {
      value
        .slice(0, SHOWN_ELEMENTS)
        .forEach((item, index) => visit(item, `${path}[${index}]`, `[${index}]`, depth));
      return;
    }
    for (const [name, item] of Object.entries(value))
      visit(item, path ? `${path}.${name}` : name, name, depth);
  };
  if (typeof message === 'object' && message !== null) visitChildren(message, '', 0);
  return rows;
}

/** Returns the number at a path, with a boolean as 0 or 1; null for any other value. */
export function numberAt(message: unknown, path: string): number | null {
  let value: unknown = message;
  for (const [, name, index] of path.matchAll(/([^.[\]]+)|\[(\d+)\]/g)) {
    if (typeof value !== 'object' || value === null) return null;
    value = (value as Record<string, unknown>)[name ?? index ?? ''];
  }
  if (typeof value === 'boolean') return value ? 1 : 0;
  return typeof value === 'number' ? value : null;
}
