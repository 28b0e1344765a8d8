import { ApiError } from '@/api/errors';
import { trees, type NodeRange } from '@/api/trees';
import type { Diagnostic } from '@/api/types';
import type { Diagram } from '@/model/diagram';
import { become } from '@/model/edits';
import { parseDiagram, serializeDiagram } from '@/model/serialize';
import { useProjectStore } from '@/store/project';
import { forgetXml, keepXml, cachedXml } from './cache';

/** The relation between the text and the tree. */
export type XmlState =
  | { readonly kind: 'loading' }
  | { readonly kind: 'inStep'; readonly findings: readonly Diagnostic[] }
  /** The text was edited; the tree follows shortly. */
  | { readonly kind: 'reading' }
  /** The text cannot be read; the tree stays unchanged. */
  | { readonly kind: 'broken'; readonly findings: readonly Diagnostic[] }
  /** Text and tree were both changed: the user must choose. */
  | { readonly kind: 'parted' }
  | { readonly kind: 'failed'; readonly reason: string };

export interface XmlSnapshot {
  readonly text: string;
  /** The ranges of the nodes in the last synchronized text. */
  readonly ranges: readonly NodeRange[];
  readonly state: XmlState;
  /** Whether invalid text of an earlier visit was restored. */
  readonly isRestored: boolean;
}

interface Agreed {
  readonly text: string;
  readonly ids: readonly string[];
  readonly diagram: Diagram;
}

const READ_AFTER_MS = 350;
const WRITE_AFTER_MS = 120;
const RETRY_AFTER_MS = 4000;

/** Keeps the XML of one tree and the tree synchronized, whichever the user edits. */
export class XmlLink {
  private snapshot: XmlSnapshot = { text: '', ranges: [], state: { kind: 'loading' }, isRestored: false };
  private readonly listeners = new Set<() => void>();
  private agreed: Agreed | null = null;
  /** Whether the user has edited this text, so that it is stored in the browser. */
  private isOwn = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private request = 0;
  private isApplying = false;
  private unfollow: (() => void) | null = null;

  constructor(
    private readonly projectId: string,
    private readonly treeId: string,
  ) {}

  readonly subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };
  readonly get = (): XmlSnapshot => this.snapshot;

  /**
   * Starts to follow the tree, with the stored text of the last visit if there is one; returns a function
   * that stops it.
   */
  start(): () => void {
    let seen = this.diagram();
    this.unfollow = useProjectStore.subscribe(() => {
      const now = this.diagram();
      if (now === seen) return;
      seen = now;
      this.onTree();
    });
    this.restore();
    return () => {
      clearTimeout(this.timer);
      this.request += 1;
      this.unfollow?.();
    };
  }

  /** Handles an edit of the text; must be called after each edit by the user. */
  edited(text: string): void {
    this.isOwn = true;
    this.set({ text });
    this.keep();
    if (this.snapshot.state.kind === 'parted' || this.agreed === null) return;
    this.request += 1;
    if (text === this.agreed.text) {
      this.set({ state: { kind: 'inStep', findings: [] } });
      return this.onTree();
    }
    if (this.diagram() !== this.agreed.diagram) return this.part();
    this.set({ state: { kind: 'reading' } });
    this.soon(READ_AFTER_MS, () => void this.read());
  }

  /** Resolves a conflict in favour of the text: the tree is read from it. */
  keepText(): void {
    const diagram = this.diagram();
    if (!diagram || !this.agreed) return;
    this.agreed = { ...this.agreed, diagram };
    this.set({ state: { kind: 'reading' } });
    void this.read();
  }

  /** Resolves a conflict in favour of the tree: the text is written from it. */
  keepTree(): void {
    if (this.agreed) this.set({ text: this.agreed.text, state: { kind: 'inStep', findings: [] } });
    void this.write();
  }

  retry(): void {
    if (this.agreed && this.snapshot.text !== this.agreed.text) void this.read();
    else void this.write();
  }

  private diagram(): Diagram | undefined {
    return useProjectStore.getState().diagrams[this.treeId];
  }

  private set(change: Partial<XmlSnapshot>): void {
    this.snapshot = { ...this.snapshot, ...change };
    for (const listener of this.listeners) listener();
  }

  private soon(delay: number, task: () => void): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(task, delay);
  }

  private restore(): void {
    const kept = cachedXml(this.projectId, this.treeId);
    const now = this.diagram();
    if (!kept || !now) return void this.write();
    this.isOwn = true;
    const isSame = kept.agreed.diagram === serializeDiagram(now);
    const diagram = isSame ? now : safely(kept.agreed.diagram);
    if (!diagram) return void this.write();
    this.agreed = { ...kept.agreed, diagram };
    if (kept.text === kept.agreed.text) return void this.write();
    this.set({ text: kept.text, isRestored: true, state: { kind: isSame ? 'reading' : 'parted' } });
    if (isSame) void this.read();
  }

  private keep(): void {
    const { text } = this.snapshot;
    if (!this.isOwn || !this.agreed) return;
    const { diagram, ids, text: agreed } = this.agreed;
    keepXml(this.projectId, this.treeId, {
      text,
      agreed: { text: agreed, ids, diagram: serializeDiagram(diagram) },
    });
  }

  /** Updates the text after a change of the tree. */
  private onTree(): void {
    const now = this.diagram();
    if (!now || this.isApplying || now === this.agreed?.diagram) return;
    const isDraft = this.agreed !== null && this.snapshot.text !== this.agreed.text;
    if (isDraft) this.part();
    else this.soon(WRITE_AFTER_MS, () => void this.write());
  }

  /** Stops synchronizing until the user has chosen, since both sides have changed. */
  private part(): void {
    clearTimeout(this.timer);
    this.request += 1;
    this.set({ state: { kind: 'parted' } });
  }

  private async write(): Promise<void> {
    const diagram = this.diagram();
    if (!diagram) return;
    clearTimeout(this.timer);
    const mine = (this.request += 1);
    const before = this.snapshot.text;
    const base = this.agreed;
    try {
      const text = serializeDiagram(diagram);
      const found = await trees
        .write(text, base?.text, base?.ids)
        // If the server refuses the earlier text, the XML is written without it.
        .catch((error: unknown) => (base && isRefusal(error) ? trees.write(text) : Promise.reject(error)));
      if (mine !== this.request) return;
      if (this.diagram() !== diagram) return void this.write();
      if (this.snapshot.text !== before) return this.part();
      this.agree(found.xml, found.ranges, diagram);
      this.set({ text: found.xml, ranges: found.ranges, state: { kind: 'inStep', findings: [] } });
      this.keep();
    } catch (error) {
      if (mine === this.request) this.fail(error, () => void this.write());
    }
  }

  private async read(): Promise<void> {
    const { text } = this.snapshot;
    const from = this.agreed?.diagram;
    if (!from) return;
    clearTimeout(this.timer);
    const mine = (this.request += 1);
    try {
      const found = await trees.read(text, serializeDiagram(from));
      if (mine !== this.request) return;
      if (this.diagram() !== from) return this.part();
      if (found.diagram === null) {
        return this.set({ state: { kind: 'broken', findings: found.diagnostics } });
      }
      this.apply(parseDiagram(found.diagram));
      this.agree(text, found.ranges, this.diagram() ?? from);
      this.set({
        ranges: found.ranges,
        isRestored: false,
        state: { kind: 'inStep', findings: found.diagnostics },
      });
      this.keep();
    } catch (error) {
      if (mine === this.request) this.fail(error, () => void this.read());
    }
  }

  private apply(next: Diagram): void {
    this.isApplying = true;
    try {
      useProjectStore.getState().apply(this.treeId, 'xml', [become(next)], { mergeKey: 'xml' });
    } finally {
      this.isApplying = false;
    }
  }

  private agree(text: string, ranges: readonly NodeRange[], diagram: Diagram): void {
    this.agreed = { text, ids: ranges.map((range) => range.node), diagram };
    if (!this.isOwn) forgetXml(this.projectId, this.treeId);
  }

  private fail(error: unknown, again: () => void): void {
    this.set({ state: { kind: 'failed', reason: error instanceof Error ? error.message : String(error) } });
    if (error instanceof ApiError && (error.isOffline || error.status >= 500))
      this.soon(RETRY_AFTER_MS, again);
  }
}

function isRefusal(error: unknown): error is ApiError {
  return error instanceof ApiError && error.diagnostics.length > 0;
}

function safely(diagram: string): Diagram | null {
  try {
    return parseDiagram(diagram);
  } catch {
    return null;
  }
}
