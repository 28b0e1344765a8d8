import { MapMode, RangeSet, StateEffect, StateField, type Extension, type Text } from '@codemirror/state';
import {
  Decoration,
  EditorView,
  gutter,
  GutterMarker,
  hoverTooltip,
  keymap,
  lineNumbers,
  ViewPlugin,
  type ViewUpdate,
} from '@codemirror/view';
import { t } from '@/i18n';
import { useBreakpoints } from '@/store/debug/breakpoints';
import {
  isOfLaunchNode,
  linesOf,
  moveLines,
  toggleLine,
  useLines,
  type LineBreakpoint,
} from '@/store/python/lines';
import { evaluate, shownFrame, usePython } from '@/store/python/stop';

/** What an editor shows of the debugger: its breakpoints, and the line at which the program is stopped. */
interface Shown {
  readonly lines: readonly LineBreakpoint[];
  readonly areOn: boolean;
  readonly problems: Readonly<Record<string, string>>;
  readonly stopped: number | null;
}

const show = StateEffect.define<Shown>();

type Look = 'on' | 'off' | 'plain' | 'log' | 'unsure';

function lookOf(each: LineBreakpoint, { areOn, problems }: Shown): Look {
  if (!areOn || !each.on) return 'off';
  if (problems[`${each.path}:${each.line}`]) return 'unsure';
  return each.log ? 'log' : each.condition || each.hits > 1 ? 'plain' : 'on';
}

class Dot extends GutterMarker {
  // It stays with its line when the one before is deleted, or another one is put there.
  override mapMode = MapMode.Simple;
  override startSide = 1;
  override endSide = 1;
  constructor(
    readonly line: number,
    readonly look: Look,
    readonly words: string,
  ) {
    super();
  }
  override eq(other: Dot): boolean {
    return other.line === this.line && other.look === this.look && other.words === this.words;
  }
  override toDOM(): Node {
    const dot = document.createElement('span');
    dot.className = 'cm-breakpoint';
    dot.dataset['look'] = this.look;
    dot.title = this.words;
    return dot;
  }
}

const stoppedLine = Decoration.line({ class: 'cm-stoppedLine' });

interface Marks {
  readonly dots: RangeSet<Dot>;
  readonly stopped: RangeSet<Decoration>;
}

function marksOf(doc: Text, shown: Shown): Marks {
  const dots = shown.lines
    .filter(({ line }) => line <= doc.lines)
    .map((each) => {
      const words = shown.problems[`${each.path}:${each.line}`] ?? t('debug:python.dot', { line: each.line });
      return new Dot(each.line, lookOf(each, shown), words).range(doc.line(each.line).from);
    });
  const at = shown.stopped !== null && shown.stopped <= doc.lines ? doc.line(shown.stopped).from : null;
  return {
    dots: RangeSet.of(dots, true),
    stopped: at === null ? RangeSet.empty : RangeSet.of(stoppedLine.range(at)),
  };
}

const marks = StateField.define<Marks>({
  create: () => ({ dots: RangeSet.empty, stopped: RangeSet.empty }),
  update(before, { changes, effects, newDoc }) {
    const moved = { dots: before.dots.map(changes), stopped: before.stopped.map(changes) };
    return effects.reduce((now, effect) => (effect.is(show) ? marksOf(newDoc, effect.value) : now), moved);
  },
  provide: (field) => EditorView.decorations.from(field, ({ stopped }) => stopped),
});

const shownIn = (path: string): Shown => {
  const python = usePython.getState();
  const frame = shownFrame(python);
  const lines = linesOf(useLines.getState().list, path);
  const unreached = () => lines.map(({ line }) => [`${path}:${line}`, t('debug:python.launchNode')]);
  return {
    lines,
    areOn: useBreakpoints.getState().areOn,
    problems: isOfLaunchNode(path) ? Object.fromEntries(unreached()) : python.problems,
    stopped: frame?.path === path ? frame.line : null,
  };
};

/** Scrolls to the line at which the program is stopped; cursor and focus stay. */
const seen = ({ state: { doc } }: EditorView, line: number | null) =>
  EditorView.scrollIntoView(doc.line(Math.min(line ?? 1, doc.lines)).from, { y: 'nearest', yMargin: 60 });

/** Keeps an editor as the stores say, and the stores as its text moves. */
const follow = (path: string) =>
  ViewPlugin.fromClass(
    class {
      private readonly stops: (() => void)[];
      constructor(view: EditorView) {
        let stopped: number | null = null;
        const update = () => {
          const shown = shownIn(path);
          const isNew = shown.stopped !== null && shown.stopped !== stopped;
          stopped = shown.stopped;
          view.dispatch({ effects: [show.of(shown), ...(isNew ? [seen(view, stopped)] : [])] });
        };
        queueMicrotask(() => view.dom.isConnected && update());
        this.stops = [useLines, useBreakpoints, usePython].map((store) => store.subscribe(update));
      }
      update({ docChanged, state }: ViewUpdate): void {
        if (!docChanged) return;
        const moved: [number, number][] = [];
        state.field(marks).dots.between(0, state.doc.length, (from, _, dot) => {
          moved.push([dot.line, state.doc.lineAt(from).number]);
        });
        // A store must not change an editor while it updates.
        queueMicrotask(() => moveLines(path, moved));
      }
      destroy(): void {
        this.stops.forEach((stop) => stop());
      }
    },
  );

/** The dots, and the numbers of the lines beside them: a press on either sets and removes a breakpoint. */
const dots = (path: string) => {
  const domEventHandlers = {
    mousedown(view: EditorView, { from }: { readonly from: number }, event: Event): boolean {
      if ((event as MouseEvent).button !== 0) return false;
      toggleLine(path, view.state.doc.lineAt(from).number);
      return true;
    },
  };
  return [
    gutter({
      class: 'cm-breakpoints',
      markers: (view) => view.state.field(marks).dots,
      initialSpacer: () => new Dot(0, 'off', ''),
      domEventHandlers,
    }),
    lineNumbers({ domEventHandlers }),
  ];
};

/** Returns the name, with its attributes, that a text has around a place. */
export function nameAround(text: string, at: number): { from: number; to: number; name: string } | null {
  for (const found of text.matchAll(/[\p{L}_][\p{L}\p{N}_]*(?:\.[\p{L}_][\p{L}\p{N}_]*)*/gu)) {
    const end = found.index + found[0].length;
    if (found.index > at || end < at) continue;
    const dot = found[0].indexOf('.', at - found.index);
    const name = dot < 0 ? found[0] : found[0].slice(0, dot);
    return { from: found.index, to: found.index + name.length, name };
  }
  return null;
}

/** Shows the value of the name under the pointer while the program is stopped in this file. */
const hovered = (path: string) =>
  hoverTooltip(async (view, position) => {
    if (shownFrame(usePython.getState())?.path !== path) return null;
    const line = view.state.doc.lineAt(position);
    const found = nameAround(line.text, position - line.from);
    if (!found) return null;
    const value = await evaluate(found.name, 'hover').catch(() => null);
    if (!value) return null;
    return {
      pos: line.from + found.from,
      end: line.from + found.to,
      create: () => {
        const dom = document.createElement('div');
        dom.className = 'cm-pythonValue';
        dom.textContent = `${found.name} = ${value.value}`;
        return { dom };
      },
    };
  });

/** Sets and removes breakpoints at the lines of a Python file, by a press and by F9, and shows stops. */
export function pythonBreakpoints(path: string): Extension {
  if (!path.endsWith('.py')) return [];
  return [
    marks,
    follow(path),
    dots(path),
    hovered(path),
    keymap.of([
      {
        key: 'F9',
        run: ({ state }) => {
          toggleLine(path, state.doc.lineAt(state.selection.main.head).number);
          return true;
        },
      },
    ]),
    EditorView.theme({
      '.cm-breakpoints': { width: '16px' },
      '.cm-breakpoints, .cm-lineNumbers': { cursor: 'pointer' },
      '.cm-breakpoint': {
        display: 'block',
        boxSizing: 'border-box',
        width: '10px',
        height: '10px',
        margin: '5px 0 0 3px',
        borderRadius: '50%',
        border: '2px solid var(--bts-failure)',
        backgroundColor: 'var(--bts-failure)',
      },
      '.cm-breakpoint[data-look=off]': { borderColor: 'var(--bts-muted)', backgroundColor: 'transparent' },
      '.cm-breakpoint[data-look=unsure]': { backgroundColor: 'transparent' },
      '.cm-breakpoint[data-look=log]': { borderRadius: '0', transform: 'rotate(45deg) scale(0.85)' },
      '.cm-breakpoint[data-look=plain]': { backgroundColor: 'transparent', borderWidth: '3px' },
      '.cm-stoppedLine.cm-line': {
        backgroundColor: 'var(--bts-running-soft)',
        boxShadow: 'inset 3px 0 var(--bts-running)',
      },
      '.cm-pythonValue': {
        maxWidth: '480px',
        padding: '4px 8px',
        fontFamily: 'var(--bts-font-mono)',
        overflowWrap: 'anywhere',
      },
    }),
  ];
}
