import type { NodeStatus } from '@/generated/messages';
import type { Fields } from './cdr';
import { STATUSES, type Entry, type RecordedNode, type StatusOf } from './types';

export interface TreeStep {
  readonly kind: 'tree';
  readonly t: number;
  readonly generation: number;
  readonly nodes: readonly RecordedNode[];
  /** The diagrams that were attached up to here, by their names in the recording. */
  readonly files: Readonly<Record<string, string>>;
}

export interface KeyframeStep {
  readonly kind: 'keyframe';
  readonly t: number;
  readonly tick: number;
  /** By the place of each node in the tree. */
  readonly status: ArrayLike<number>;
  readonly entries: readonly Entry[];
}

export interface TickStep {
  readonly kind: 'tick';
  readonly t: number;
  readonly number: number;
  readonly durationMs: number;
  readonly changed: readonly StatusOf[];
  readonly flashed: readonly StatusOf[];
  /** The uids of the nodes whose result was forced. */
  readonly forced?: readonly number[];
}

export interface Write extends Entry {
  readonly isRemoved: boolean;
  readonly writer: number;
}

export interface WritesStep {
  readonly kind: 'writes';
  readonly t: number;
  readonly writes: readonly Write[];
}

/** What changes the state of a tree, in the order of the recording. */
export type Step = TreeStep | KeyframeStep | TickStep | WritesStep;

type List = readonly unknown[];
const numbers = (value: unknown): ArrayLike<number> => (value ?? []) as ArrayLike<number>;
const texts = (value: unknown): readonly string[] => (value ?? []) as readonly string[];
const statusOf = (code: number | undefined): NodeStatus => STATUSES[code ?? 0] ?? 'IDLE';

export function treeStep(t: number, fields: Fields, files: TreeStep['files'] = {}): TreeStep {
  const of = (name: string) => texts(fields[name]);
  const [type, kind, name, path, node, tree] = ['type', 'kind', 'name', 'path', 'node_id', 'tree_id'].map(of);
  const ports = of('ports_json');
  const parents = numbers(fields['parent']);
  const nodes = Array.from(numbers(fields['uid']), (uid, at): RecordedNode => ({
    uid,
    parent: parents[at] ?? 0,
    type: type?.[at] ?? '',
    kind: kind?.[at] ?? '',
    name: name?.[at] ?? '',
    path: path?.[at] ?? '',
    node_id: node?.[at] ?? '',
    tree_id: tree?.[at] ?? '',
    ports: portsOf(ports[at] ?? '{}'),
  }));
  return { kind: 'tree', t, generation: Number(fields['generation']), nodes, files };
}

function portsOf(text: string): RecordedNode['ports'] {
  const ports = parsed(text);
  if (typeof ports !== 'object' || ports === null || Array.isArray(ports)) return {};
  return Object.fromEntries(
    Object.entries(ports).map(([port, value]) => [
      port,
      typeof value === 'string' ? value : JSON.stringify(value),
    ]),
  );
}

export function keyframeStep(t: number, fields: Fields): KeyframeStep {
  const list = parsed(String(fields['blackboard_json'] || '[]'));
  const entries = (Array.isArray(list) ? (list as List) : []).flatMap((row): Entry[] => {
    if (!Array.isArray(row) || row.length < 4) return [];
    const [scope, key, type, value] = row as List;
    return [{ scope: String(scope), key: String(key), type: String(type), ...shownValue(value) }];
  });
  return { kind: 'keyframe', t, tick: Number(fields['tick']), status: numbers(fields['status']), entries };
}

/** @param forced the uids that the message of forced results before it has. */
export function tickStep(t: number, fields: Fields, forced: readonly number[] = []): TickStep {
  return {
    kind: 'tick',
    t,
    number: Number(fields['number']),
    durationMs: Number(fields['duration_ms']),
    changed: pairs(fields['changed_uid'], fields['changed_status']),
    flashed: pairs(fields['flashed_uid'], fields['flashed_status']),
    ...(forced.length > 0 ? { forced } : {}),
  };
}

export function writesStep(t: number, fields: Fields): WritesStep {
  const [scopes, types, values] = ['scope', 'type', 'value_json'].map((name) => texts(fields[name]));
  const removed = numbers(fields['removed']);
  const writers = numbers(fields['writer_uid']);
  const writes = texts(fields['key']).map((key, at): Write => {
    const isRemoved = (removed[at] ?? 0) !== 0;
    return {
      scope: scopes?.[at] ?? '',
      key,
      type: types?.[at] ?? '',
      ...shownValue(isRemoved ? null : parsed(values?.[at] ?? 'null')),
      isRemoved,
      writer: writers[at] ?? 0,
    };
  });
  return { kind: 'writes', t, writes };
}

function pairs(uids: unknown, codes: unknown): StatusOf[] {
  const of = numbers(codes);
  return Array.from(numbers(uids), (uid, at) => [uid, statusOf(of[at])] as const);
}

/** Returns a value of a recording; one that was too long is an object of its preview, length and hash. */
function shownValue(value: unknown): Pick<Entry, 'value' | 'isPreview'> {
  const isPreview =
    typeof value === 'object' &&
    value !== null &&
    typeof (value as { preview?: unknown }).preview === 'string' &&
    Object.keys(value).every((name) => ['preview', 'bytes', 'hash'].includes(name));
  return isPreview
    ? { value: (value as { preview: string }).preview, isPreview: true }
    : { value, isPreview: false };
}

/** Parses JSON; other text is the value itself. */
function parsed(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return text;
  }
}
