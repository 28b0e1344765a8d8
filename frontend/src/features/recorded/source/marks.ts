import { RangeSet, type Extension, type Text } from '@codemirror/state';
import { Decoration, EditorView, gutter, GutterMarker, WidgetType } from '@codemirror/view';
import type { SourceCall, SourceValue } from '@/generated/messages';

/** What is drawn at a line: how often it ran, and what had another value after it. */
export interface LineMark {
  readonly line: number;
  readonly times: number;
  readonly values: readonly SourceValue[];
}

/** Returns the marks of a file: of all calls the lines that ran, and of the chosen one the values. */
export function lineMarks(calls: readonly SourceCall[], chosen: SourceCall): readonly LineMark[] {
  const marks = new Map<number, LineMark>();
  for (const call of calls) {
    if (call.file !== chosen.file) continue;
    for (const { line, times, values } of call.lines) {
      const before = marks.get(line);
      marks.set(line, {
        line,
        times: (before?.times ?? 0) + times,
        values: call === chosen ? values : (before?.values ?? []),
      });
    }
  }
  return [...marks.values()].sort((one, other) => one.line - other.line);
}

/** Returns the values of a line in words. */
export const wordsOf = (values: readonly SourceValue[]): string =>
  values.map(({ name, text }) => `${name} = ${text}`).join('  ');

class Values extends WidgetType {
  constructor(readonly words: string) {
    super();
  }
  override eq(other: Values): boolean {
    return other.words === this.words;
  }
  override toDOM(): HTMLElement {
    const place = document.createElement('span');
    place.className = 'cm-ranValues';
    place.textContent = this.words;
    place.title = this.words;
    return place;
  }
}

class Times extends GutterMarker {
  constructor(readonly times: number) {
    super();
  }
  override eq(other: Times): boolean {
    return other.times === this.times;
  }
  override toDOM(): Node {
    return document.createTextNode(`${this.times}×`);
  }
}

const ran = Decoration.line({ class: 'cm-ran' });

function decorations(doc: Text, marks: readonly LineMark[]) {
  const found = marks.flatMap(({ line, times, values }) => {
    const { from, to } = doc.line(line);
    const widget = Decoration.widget({ widget: new Values(wordsOf(values)), side: 1 });
    return [...(times > 0 ? [ran.range(from)] : []), ...(values.length > 0 ? [widget.range(to)] : [])];
  });
  return Decoration.set(found, true);
}

/** Marks the lines of a text that ran. Lines that the text has not are left out: they are data of a run. */
export function ranLines(doc: Text, all: readonly LineMark[]): Extension {
  const marks = all.filter(({ line }) => line >= 1 && line <= doc.lines);
  const times = marks.filter((mark) => mark.times > 0);
  const numbers = RangeSet.of(times.map((mark) => new Times(mark.times).range(doc.line(mark.line).from)));
  return [
    gutter({ class: 'cm-ranTimes', markers: () => numbers }),
    EditorView.decorations.of(decorations(doc, marks)),
    EditorView.theme({
      '.cm-ranTimes': { minWidth: '4ch', textAlign: 'right', color: 'var(--bts-running)' },
      '.cm-ran.cm-line': {
        backgroundColor: 'var(--bts-running-soft)',
        boxShadow: 'inset 3px 0 var(--bts-running-bright)',
      },
      '.cm-ranValues': {
        display: 'inline-block',
        maxWidth: '60ch',
        marginLeft: '3ch',
        overflow: 'hidden',
        color: 'var(--bts-running)',
        fontStyle: 'italic',
        textOverflow: 'ellipsis',
        whiteSpace: 'pre',
        verticalAlign: 'bottom',
      },
    }),
  ];
}
