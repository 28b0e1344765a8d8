import { RangeSetBuilder, StateEffect, StateField, type Extension } from '@codemirror/state';
import {
  Decoration,
  EditorView,
  MatchDecorator,
  ViewPlugin,
  type DecorationSet,
  type ViewUpdate,
} from '@codemirror/view';
import type { NodeRange } from '@/api/trees';

/** The nodes in an editor's text. */
interface Nodes {
  readonly ranges: readonly NodeRange[];
  readonly selected: ReadonlySet<string>;
}

export const setRanges = StateEffect.define<readonly NodeRange[]>();
export const setSelected = StateEffect.define<ReadonlySet<string>>();

/** The ranges of the nodes, which move while the text is edited, and the selected nodes. */
const nodesField = StateField.define<Nodes>({
  create: () => ({ ranges: [], selected: new Set() }),
  update: (nodes, change) => {
    let { ranges, selected } = nodes;
    if (change.docChanged) {
      const { changes } = change;
      ranges = ranges.map(({ node, start, open_end, end }) => ({
        node,
        start: changes.mapPos(start, 1),
        open_end: changes.mapPos(open_end, -1),
        end: changes.mapPos(end, -1),
      }));
    }
    for (const effect of change.effects) {
      if (effect.is(setRanges)) ranges = effect.value;
      if (effect.is(setSelected)) selected = effect.value;
    }
    return ranges === nodes.ranges && selected === nodes.selected ? nodes : { ranges, selected };
  },
});

const chosen = Decoration.line({ class: 'cm-chosenNode' });

const chosenLines = EditorView.decorations.compute([nodesField, 'doc'], (state): DecorationSet => {
  const { ranges, selected } = state.field(nodesField);
  const lines = new Set<number>();
  for (const range of ranges) {
    if (!selected.has(range.node) || range.open_end > state.doc.length) continue;
    const last = state.doc.lineAt(Math.max(range.start, range.open_end - 1)).number;
    for (let line = state.doc.lineAt(range.start).number; line <= last; line += 1) lines.add(line);
  }
  const builder = new RangeSetBuilder<Decoration>();
  for (const line of [...lines].sort((a, b) => a - b)) {
    const { from } = state.doc.line(line);
    builder.add(from, from, chosen);
  }
  return builder.finish();
});

export const nodeRanges: Extension = [nodesField, chosenLines];

export const rangesOf = (view: EditorView): readonly NodeRange[] => view.state.field(nodesField).ranges;

/** Returns the innermost node at an offset in the text. */
export function nodeAt(ranges: readonly NodeRange[], at: number): string | null {
  let found: NodeRange | null = null;
  for (const range of ranges) {
    if (range.start <= at && at <= range.end && (found === null || range.start >= found.start)) found = range;
  }
  return found?.node ?? null;
}

const metadata = (decoration: Decoration) =>
  new MatchDecorator({ regexp: /\s_bts_\w+="[^"\n]*"/g, decoration: () => decoration });

function decorating(matcher: MatchDecorator, isAtomic: boolean): Extension {
  return ViewPlugin.fromClass(
    class {
      marks: DecorationSet;
      constructor(view: EditorView) {
        this.marks = matcher.createDeco(view);
      }
      update(update: ViewUpdate): void {
        this.marks = matcher.updateDeco(update, this.marks);
      }
    },
    {
      decorations: (plugin) => plugin.marks,
      provide: (plugin) =>
        isAtomic ? EditorView.atomicRanges.of((view) => view.plugin(plugin)?.marks ?? Decoration.none) : [],
    },
  );
}

/** Two ways to show ids and positions: hidden, or in a faint colour. */
export const hiddenMetadata = decorating(metadata(Decoration.replace({})), true);
export const dimMetadata = decorating(metadata(Decoration.mark({ class: 'cm-metadata' })), false);
