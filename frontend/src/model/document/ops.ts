import { isObject, type Json, type JsonObject, type Path } from './values';

/** A small change of a document. Indexes of `remove` refer to the list before the change. */
export type Op =
  | { readonly kind: 'set'; readonly path: Path; readonly value: Json }
  | { readonly kind: 'unset'; readonly path: Path }
  /** Renames the last key of the path; its place in the mapping stays. */
  | { readonly kind: 'rename'; readonly path: Path; readonly to: string }
  | { readonly kind: 'insert'; readonly path: Path; readonly index: number; readonly values: readonly Json[] }
  | { readonly kind: 'remove'; readonly path: Path; readonly indexes: readonly number[] };

/** Applies the changes to a document's value, in order. */
export function applyOps(raw: JsonObject, ops: readonly Op[]): JsonObject {
  return ops.reduce<JsonObject>((value, op) => applied(value, op.path, op) as JsonObject, raw);
}

function applied(value: Json | undefined, path: Path, op: Op): Json {
  const [step, ...rest] = path;
  if (step === undefined) return changed(value, op);
  if (Array.isArray(value)) {
    return (value as Json[]).map((part, index) => (index === step ? applied(part, rest, op) : part));
  }
  const map = isObject(value) ? value : {};
  if (rest.length === 0 && op.kind === 'unset') {
    const { [step]: _gone, ...others } = map;
    return others;
  }
  if (rest.length === 0 && op.kind === 'rename') {
    const renamed = Object.entries(map).map(([key, part]) => [key === step ? op.to : key, part]);
    return Object.fromEntries(renamed) as JsonObject;
  }
  return { ...map, [step]: applied(map[step], rest, op) };
}

function changed(value: Json | undefined, op: Op): Json {
  if (op.kind === 'set') return op.value;
  const list = Array.isArray(value) ? (value as Json[]) : [];
  if (op.kind === 'insert') return [...list.slice(0, op.index), ...op.values, ...list.slice(op.index)];
  if (op.kind === 'remove') return list.filter((_, index) => !op.indexes.includes(index));
  return value ?? null;
}

/** Returns whether two values are equal; the order of keys does not matter. */
export function sameValue(a: Json | undefined, b: Json | undefined): boolean {
  if (Array.isArray(a) || Array.isArray(b)) {
    if (!Array.isArray(a) || !Array.isArray(b) || a.length !== b.length) return false;
    return (a as Json[]).every((part, index) => sameValue(part, (b as Json[])[index]));
  }
  if (!isObject(a) || !isObject(b)) return a === b;
  const keys = Object.keys(a);
  return (
    keys.length === Object.keys(b).length &&
    keys.every((key) => Object.hasOwn(b, key) && sameValue(a[key], b[key]))
  );
}
