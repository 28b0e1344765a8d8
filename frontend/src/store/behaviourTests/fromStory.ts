import type { NodeStatus, TreeNode } from '@/generated/messages';
import type { Diagram } from '@/model/diagram';
import { findEntry, keyIn } from '@/model/keys/entry';
import type { Vocabulary } from '@/model/vocabulary';
import { entryId } from '@/store/recording/segmentIndex';
import type { Story, StoryTick } from '@/store/recording/story';
import type { Write } from '@/store/recording/steps';
import type { Entry } from '@/store/recording/types';
import { enclosing } from '@/store/session/values/live';

/** Parts of the run that the test cannot repeat, or might not. */
export type Note =
  | { readonly kind: 'gap'; readonly tick: number }
  | { readonly kind: 'midway' | 'irregular' | 'changed' }
  | { readonly kind: 'raised'; readonly tick: number }
  | { readonly kind: 'outside'; readonly key: string }
  | { readonly kind: 'value' | 'notPort'; readonly key: string; readonly node: string }
  | { readonly kind: 'python' | 'ambiguous'; readonly node: string };

export interface Result {
  /** The tick of the test from which on the leaf returned it. */
  readonly at: number;
  readonly status: NodeStatus;
  readonly outputs: Readonly<Record<string, unknown>>;
}

/** A behaviour test that repeats a run of a tree, with all expectations that hold at its end. */
export interface Draft {
  readonly tree: string;
  readonly tickHz: number;
  readonly ticks: number;
  readonly repeat: boolean;
  readonly blackboard: Readonly<Record<string, unknown>>;
  readonly doubles: readonly (readonly [node: string, results: readonly Result[] | 'real'])[];
  readonly root: NodeStatus | null;
  readonly statuses: readonly (readonly [node: string, status: NodeStatus])[];
  /** What nodes returned in the last tick that are idle after it. */
  readonly results: readonly (readonly [node: string, status: NodeStatus])[];
  readonly idle: readonly string[];
  readonly values: Readonly<Record<string, unknown>>;
  readonly notes: readonly Note[];
}

export interface ProjectOfStory {
  readonly diagrams: Readonly<Record<string, Diagram>>;
  readonly vocabulary: Vocabulary;
  readonly tickHz: number;
}

const MOST_ITEMS = 1000;
/** The deviation from the rate, as a part of it, that is still the same rate. */
const SAME_RATE = 0.02;

type Plain = string | number | boolean;
const isScalar = (value: unknown): value is Plain => ['string', 'number', 'boolean'].includes(typeof value);
const isPlain = ({ value, isPreview }: Entry): boolean =>
  !isPreview &&
  (isScalar(value) || (Array.isArray(value) && value.length <= MOST_ITEMS && value.every(isScalar)));

/**
 * Makes a test of a story.
 *
 * @param last the number of ticks from the end; null: all of them.
 */
export function draftOf(story: Story, project: ProjectOfStory, last: number | null = null): Draft {
  return new Maker(story, project, last).draft();
}

class Maker {
  private readonly notes = new Map<string, Note>();
  private readonly ticks: readonly StoryTick[];
  private readonly byUid: ReadonlyMap<number, TreeNode>;
  private readonly statuses: Map<number, NodeStatus>;
  private readonly entries: Map<string, Entry>;
  private readonly leaves: readonly TreeNode[];
  private readonly results = new Map<number, Result[]>();
  private readonly names = new Map<string, number>();

  constructor(
    private readonly story: Story,
    private readonly project: ProjectOfStory,
    last: number | null,
  ) {
    const skipped = last === null ? 0 : Math.max(0, story.ticks.length - last);
    this.ticks = story.ticks.slice(skipped);
    this.byUid = new Map(story.nodes.map((node) => [node.uid, node]));
    this.statuses = new Map(story.statuses);
    this.entries = new Map(story.entries.map((entry) => [entryId(entry), entry]));
    for (const { name, type, path, node_id: id } of story.nodes)
      for (const key of new Set([name, type, path, id])) this.names.set(key, (this.names.get(key) ?? 0) + 1);
    this.leaves = story.nodes.filter((node) => this.isDoubled(node));
    for (const tick of story.ticks.slice(0, skipped)) this.follow(tick);
    if (skipped === 0 && !story.isWhole) this.note({ kind: 'gap', tick: this.ticks[0]?.number ?? 0 });
    if ((skipped > 0 || !story.isWhole) && this.statuses.size > 0) this.note({ kind: 'midway' });
  }

  draft(): Draft {
    const root = this.story.nodes[0];
    const blackboard = this.begin();
    let result: NodeStatus | null = null;
    let repeat = false;
    this.ticks.forEach((tick, index) => {
      repeat ||= result !== null && result !== 'RUNNING';
      if (index > 0) this.noteOutside(tick.writes);
      this.follow(tick);
      this.take(tick, index + 1);
      result = this.returned(tick, root?.uid ?? 0);
      if (result === null) this.note({ kind: 'raised', tick: tick.number });
    });
    const doubles = this.doubles();
    return {
      tree: root?.tree_id ?? '',
      tickHz: this.rate(),
      ticks: this.ticks.length,
      repeat,
      blackboard,
      doubles,
      root: result,
      ...this.end(),
      values: this.valuesNow(),
      notes: [...this.notes.values()],
    };
  }

  /** Returns the entries that the tree found at its begin. */
  private begin(): Record<string, unknown> {
    const first = this.ticks[0]?.writes.filter(({ writer, isRemoved }) => writer === 0 && !isRemoved) ?? [];
    const found = [...this.entries.values(), ...first].filter((entry) => entry.scope === '');
    for (const entry of found)
      if (!isPlain(entry) && entry.value !== null) this.note({ kind: 'outside', key: entry.key });
    return Object.fromEntries(found.filter(isPlain).map(({ key, value }) => [key, value]));
  }

  private follow({ changed, writes }: StoryTick): void {
    for (const [uid, status] of changed) this.statuses.set(uid, status);
    for (const write of writes) {
      if (write.isRemoved) this.entries.delete(entryId(write));
      else this.entries.set(entryId(write), write);
    }
  }

  /** Adds the results of the leaves in a tick: first those that did not stay, in their order, then those that stayed. */
  private take(tick: StoryTick, at: number): void {
    for (const leaf of this.leaves) {
      const results = tick.flashed.filter(([uid]) => uid === leaf.uid).map(([, status]) => status);
      const now = this.statuses.get(leaf.uid) ?? 'IDLE';
      if (now !== 'IDLE') results.push(now);
      if (results.length === 0) continue;
      const written = this.outputs(leaf, tick.writes);
      const known = this.results.get(leaf.uid) ?? [];
      this.results.set(leaf.uid, known);
      results.forEach((status, index) => {
        const outputs = index === results.length - 1 ? written : {};
        const before = known.at(-1);
        const isSame =
          before?.status === status && JSON.stringify(before.outputs) === JSON.stringify(outputs);
        if (results.length > 1 || !isSame) known.push({ at, status, outputs });
      });
    }
  }

  /** Returns the values that a leaf wrote to its output ports. */
  private outputs(leaf: TreeNode, writes: readonly Write[]): Record<string, unknown> {
    const found: Record<string, unknown> = {};
    for (const write of writes) {
      if (write.writer !== leaf.uid || write.isRemoved) continue;
      const port = this.portOf(leaf, write);
      if (port === null) this.note({ kind: 'notPort', key: write.key, node: leaf.name });
      else if (isPlain(write)) found[port] = write.value;
      else this.note({ kind: 'value', key: write.key, node: leaf.name });
    }
    return found;
  }

  private portOf(leaf: TreeNode, write: Write): string | null {
    const { diagrams, vocabulary } = this.project;
    const node = diagrams[leaf.tree_id]?.nodes[leaf.node_id];
    const spec = vocabulary.specs.get(leaf.type);
    const declared = spec?.ports.filter(({ direction }) => direction !== 'input') ?? [];
    const open = spec === undefined || spec.open ? Object.keys(node?.ports ?? {}) : [];
    const callers = enclosing(leaf, this.byUid);
    const has = (entry: { scope: string; key: string }) => entryId(entry) === entryId(write);
    const texts = new Map(declared.map(({ name, default: text }) => [name, text ?? '']));
    const names = new Set([...texts.keys(), ...open]);
    for (const name of names) {
      const key = keyIn(node?.ports?.[name] ?? texts.get(name) ?? '', name);
      if (key !== null && findEntry(key, callers, { diagrams, has })) return name;
    }
    return null;
  }

  private doubles(): Draft['doubles'] {
    const doubled = this.leaves.flatMap((leaf): Draft['doubles'][number][] => {
      const results = this.results.get(leaf.uid);
      return results ? [[this.keyOf(leaf), results]] : [];
    });
    const own = this.story.nodes.filter((node) => this.isOwnControl(node));
    for (const node of own) this.note({ kind: 'python', node: node.name });
    return [...doubled, ...own.map((node) => [this.keyOf(node), 'real'] as const)];
  }

  private end(): Pick<Draft, 'statuses' | 'results' | 'idle'> {
    const statuses: [string, NodeStatus][] = [];
    const results: [string, NodeStatus][] = [];
    const idle: string[] = [];
    const flashed = new Map(this.ticks.at(-1)?.flashed);
    for (const node of this.story.nodes.slice(1)) {
      const key = this.keyOf(node);
      const status = this.statuses.get(node.uid) ?? 'IDLE';
      const result = flashed.get(node.uid);
      if (status !== 'IDLE') statuses.push([key, status]);
      else if (result !== undefined) results.push([key, result]);
      else idle.push(key);
    }
    return { statuses, results, idle };
  }

  private valuesNow(): Record<string, unknown> {
    const own = [...this.entries.values()].filter((entry) => entry.scope === '' && isPlain(entry));
    return Object.fromEntries(own.map(({ key, value }) => [key, value]));
  }

  private returned({ flashed }: StoryTick, uid: number): NodeStatus | null {
    const stayed = this.statuses.get(uid) ?? 'IDLE';
    if (stayed !== 'IDLE') return stayed;
    return flashed.findLast(([each]) => each === uid)?.[1] ?? null;
  }

  /** Returns the rate of the ticks: that of the project, unless they came at another one. */
  private rate(): number {
    const { tickHz } = this.project;
    const gaps = this.ticks.slice(1).map(({ t }, at) => t - (this.ticks[at]?.t ?? t));
    const middle = [...gaps].sort((a, b) => a - b)[Math.floor(gaps.length / 2)] ?? 0;
    if (middle <= 0) return tickHz;
    if (gaps.some((gap) => Math.abs(gap - middle) > middle / 2)) this.note({ kind: 'irregular' });
    return Math.abs(1 / middle / tickHz - 1) <= SAME_RATE ? tickHz : Number((1 / middle).toPrecision(6));
  }

  /** Returns the shortest name that means a node alone: its own, or else its path. */
  private keyOf(node: TreeNode): string {
    for (const key of [node.name, node.path]) if (this.names.get(key) === 1) return key;
    this.note({ kind: 'ambiguous', node: node.path });
    return node.path;
  }

  /** Returns whether a node runs Python of the project or of ROS, which a test replaces. */
  private isDoubled({ type, kind, tree_id: tree, node_id: id }: TreeNode): boolean {
    if (kind !== 'Action' && kind !== 'Condition') return false;
    if (!this.project.diagrams[tree]?.nodes[id]) this.note({ kind: 'changed' });
    const spec = this.project.vocabulary.specs.get(type);
    return spec === undefined || spec.source === 'action' || spec.group === 'ros';
  }

  private isOwnControl({ type, kind }: TreeNode): boolean {
    const spec = this.project.vocabulary.specs.get(type);
    return spec?.source === 'action' && (kind === 'Control' || kind === 'Decorator');
  }

  private noteOutside(writes: readonly Write[]): void {
    for (const { writer, key } of writes) if (!this.byUid.has(writer)) this.note({ kind: 'outside', key });
  }

  private note(note: Note): void {
    const { kind } = note;
    const place = 'key' in note ? note.key : 'node' in note ? note.node : '';
    const id = `${kind} ${place}`;
    if (!this.notes.has(id)) this.notes.set(id, note);
  }
}
