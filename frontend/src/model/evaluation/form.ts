import { isMap } from 'yaml';
import type { Op } from '@/model/document/ops';
import { rewrite } from '@/model/document/rewrite';
import { isObject, type Json, type JsonObject } from '@/model/document/values';
import { parsed } from '@/model/document/yaml';

/** What the form shows of an evaluation; what it does not show stays in the text. */
export interface EvaluationForm {
  readonly duration_s: number | null;
  /** null: the runs end by `until`. */
  readonly runs: number | null;
  readonly seed: number;
  readonly neverCollision: boolean;
  /** The distance that nothing may come closer than, in m; null without one. */
  readonly closer_than_m: number | null;
  readonly closerTo: string;
  readonly treeSucceeds: boolean;
  readonly measures: readonly string[];
  readonly vary: readonly Variation[];
  /** The number of items of the judge that only the text shows. */
  readonly otherItems: number;
  readonly faults: number;
}

/** One entry of `vary`. `from` and `to` are null for one that only the text shows. */
export interface Variation {
  readonly address: string;
  readonly from: number | null;
  readonly to: number | null;
}

export const MEASURES = [
  'time_to_success_s',
  'path_length_m',
  'smallest_clearance_m',
  'mean_speed_m_s',
  'energy_j',
] as const;

const numberOr = <T>(value: Json | undefined, other: T): number | T =>
  typeof value === 'number' && Number.isFinite(value) ? value : other;
const listOf = (value: Json | undefined): readonly Json[] => (Array.isArray(value) ? (value as Json[]) : []);

function itemsOf(raw: JsonObject): readonly Json[] {
  const judge = raw['judge'];
  return isObject(judge) ? listOf(judge['success']) : [];
}

const isCollision = (item: Json): boolean => isObject(item) && item['never'] === 'collision';
const closerOf = (item: Json): JsonObject | null => {
  const never = isObject(item) ? item['never'] : undefined;
  return isObject(never) && typeof never['closer_than_m'] === 'number' ? never : null;
};
const isTree = (item: Json): boolean =>
  isObject(item) && item['tree'] === 'SUCCESS' && Object.keys(item).length === 1;

/** Returns the form of an evaluation's text; null if the text is no evaluation that can be changed. */
export function readForm(text: string): EvaluationForm | null {
  const { document } = parsed(text);
  if (document.errors.length > 0 || !isMap(document.contents)) return null;
  const raw = document.toJS() as Json;
  if (!isObject(raw)) return null;
  const items = itemsOf(raw);
  const closer = items.map(closerOf).find((found) => found !== null) ?? null;
  const judge = isObject(raw['judge']) ? raw['judge'] : {};
  const vary = isObject(raw['vary']) ? raw['vary'] : {};
  return {
    duration_s: numberOr(raw['duration_s'], null),
    runs: numberOr(raw['runs'], null),
    seed: numberOr(raw['seed'], 0),
    neverCollision: items.some(isCollision),
    closer_than_m: closer ? numberOr(closer['closer_than_m'], null) : null,
    closerTo: typeof closer?.['to'] === 'string' ? closer['to'] : 'anything',
    treeSucceeds: items.some(isTree),
    measures: listOf(judge['measure']).filter((name): name is string => typeof name === 'string'),
    vary: Object.entries(vary).map(([address, value]) => variationOf(address, value)),
    otherItems: items.filter((item) => !isCollision(item) && !closerOf(item) && !isTree(item)).length,
    faults: listOf(raw['faults']).length,
  };
}

function variationOf(address: string, value: Json | undefined): Variation {
  const [from, to, ...more] = listOf(value);
  const isRange = more.length === 0 && typeof from === 'number' && typeof to === 'number';
  return isRange ? { address, from, to } : { address, from: null, to: null };
}

/** Returns the text with a number of its top level set, or left out. */
export const withNumber = (text: string, key: 'duration_s' | 'runs' | 'seed', value: number | null): string =>
  rewrite(text, [value === null ? { kind: 'unset', path: [key] } : { kind: 'set', path: [key], value }]);

type Item = 'collision' | 'closer' | 'tree';
const IS: Record<Item, (item: Json) => boolean> = {
  collision: isCollision,
  closer: (item) => closerOf(item) !== null,
  tree: isTree,
};

/** Returns the text with an item of the judge, in place of the one of its kind, or without it. */
export function withItem(text: string, kind: Item, value: Json | null): string {
  const raw = parsed(text).document.toJS() as JsonObject;
  const path = ['judge', 'success'];
  const items = itemsOf(raw);
  const found = items.findIndex(IS[kind]);
  if (items.length === 0) {
    if (value === null) return text;
    if (!isObject(raw['judge'])) {
      return rewrite(text, [{ kind: 'set', path: ['judge'], value: { success: [value] } }]);
    }
    return rewrite(text, [{ kind: 'set', path, value: [value] }]);
  }
  if (found < 0 && value === null) return text;
  const ops: Op[] = [];
  if (found >= 0) ops.push({ kind: 'remove', path, indexes: [found] });
  if (value !== null) {
    ops.push({ kind: 'insert', path, index: found < 0 ? items.length : found, values: [value] });
  }
  return rewrite(text, ops);
}

/** Returns the text with these measures. */
export const withMeasures = (text: string, measures: readonly string[]): string =>
  rewrite(text, [{ kind: 'set', path: ['judge', 'measure'], value: [...measures] }]);

/** Returns the text with an entry of `vary` in place of one of another address, or without it. */
export function withVariation(text: string, before: string | null, next: Variation | null): string {
  const ops: Op[] = [];
  if (before !== null && before !== next?.address) {
    ops.push(
      next === null
        ? { kind: 'unset', path: ['vary', before] }
        : { kind: 'rename', path: ['vary', before], to: next.address },
    );
  }
  if (next !== null && next.from !== null && next.to !== null) {
    const value = [next.from, next.to];
    const raw = parsed(text).document.toJS() as JsonObject;
    ops.push(
      isObject(raw['vary'])
        ? { kind: 'set', path: ['vary', next.address], value }
        : { kind: 'set', path: ['vary'], value: { [next.address]: value } },
    );
  }
  return ops.length === 0 ? text : rewrite(text, ops);
}
