import { create, useStore } from 'zustand';
import type { LogSource } from '@/generated/messages';
import {
  IN_PLACE,
  writerName,
  type Moment,
  type Overview,
  type RecordedFault,
  type RecordedLine,
} from '@/store/recording/types';
import { blackboardId, initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import type { BlackboardRow, LogLine, SessionData } from '@/store/session/types';
import { useMoment } from './store';
import type { TreeNode } from '@/generated/messages';

/** The session as it was at the shown moment. */
export const usePastSession = create<SessionData>(() => initialSession);

/** Returns tree, blackboard, console and faults of the shown moment, and everything else of the present. */
export function useShownSession<T>(selector: (state: SessionData) => T): T {
  const isBack = useMoment((state) => state.shown !== null);
  return useStore(isBack ? usePastSession : useSessionStore, selector);
}

const SOURCES: readonly string[] = ['action', 'world', 'manager', 'launch'] satisfies LogSource[];

/** Returns the console of a recording: lines and faults, in order, a row for each line of text. */
export function consoleOf({ lines, faults }: Pick<Overview, 'lines' | 'faults'>): LogLine[] {
  const all = [...lines, ...faults.map(lineOf)].sort((a, b) => a.t - b.t);
  let id = 1;
  return all.flatMap(({ t, source, level, text, path }) =>
    text
      .replace(/\n$/, '')
      .split('\n')
      .map((line) => ({
        time: t,
        source: (SOURCES.includes(source) ? source : 'manager') as LogSource,
        level,
        text: line,
        node_id: '',
        node_path: path,
        launch_node: '',
        id: id++,
      })),
  );
}

const lineOf = ({ t, uid, message, traceback, path }: RecordedFault): RecordedLine => ({
  t,
  source: uid > 0 ? 'action' : 'manager',
  level: 'error',
  text: traceback || message,
  path,
});

/** Returns the blackboard at a moment as rows. */
export function rowsOf({ entries }: Moment, tree: readonly TreeNode[]): Record<string, BlackboardRow> {
  const names = new Map(tree.map((node) => [node.uid, writerName(node)]));
  const by = (writer: number | null): string | null => {
    if (writer === null) return null;
    return writer === 0 || writer === IN_PLACE ? '' : (names.get(writer) ?? null);
  };
  return Object.fromEntries(
    entries.map(({ scope, key, type, value, isPreview, since, writer }) => [
      blackboardId({ scope, key }),
      {
        scope,
        key,
        type,
        value,
        preview: isPreview,
        removed: false,
        changedAt: since ?? -1,
        written: { t: since, by: by(writer) },
      },
    ]),
  );
}

/** Returns the lines up to a time; they are in order. */
export function linesUntil(lines: readonly LogLine[], t: number): LogLine[] {
  let low = 0;
  let high = lines.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((lines[middle]?.time ?? 0) > t) high = middle;
    else low = middle + 1;
  }
  return lines.slice(0, low);
}
