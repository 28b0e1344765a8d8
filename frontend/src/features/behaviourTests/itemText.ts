import type { TFunction } from 'i18next';

const PATTERNS = [
  [
    /^branch (\d+) (taken|not taken)$/,
    (t, [, n, way]) => t(way === 'taken' ? 'item.branchTaken' : 'item.branchNotTaken', { n }),
  ],
  [/^(_\w+) (true|false|run)$/, (t, [, name, how]) => t(`item.${how as 'true' | 'false' | 'run'}`, { name })],
] as const satisfies readonly (readonly [
  RegExp,
  (t: TFunction<'behaviourTests'>, found: RegExpExecArray) => string,
])[];

const STATUSES = ['SUCCESS', 'FAILURE', 'RUNNING', 'SKIPPED'];

/** Returns the description of an item of a block that no test reached, from the engine's name of the item. */
export function itemText(t: TFunction<'behaviourTests'>, item: string): string {
  if (item === 'ticked') return t('item.ticked');
  if (item === 'halted while RUNNING') return t('item.halted');
  if (STATUSES.includes(item)) return t('item.status', { status: item });
  for (const [pattern, text] of PATTERNS) {
    const found = pattern.exec(item);
    if (found) return text(t, found);
  }
  return item;
}
