import { create } from 'zustand';
import type { LogLevel, LogSource } from '@/generated/messages';
import type { LogLine } from '@/store/session/types';
import { plainText } from './ansi';

export interface ConsoleFilter {
  /** `all`, a source, or one launch node by its id. */
  source: LogSource | 'all' | `launch:${string}`;
  /** The lowest level that is shown. */
  level: LogLevel;
  search: string;
}

export const LEVELS: LogLevel[] = ['debug', 'info', 'warning', 'error'];

/** The filter of the console. Other panels set it to show the lines that they link to. */
export const useConsoleFilter = create<ConsoleFilter>(() => ({ source: 'all', level: 'info', search: '' }));

const isOf = (line: LogLine, source: ConsoleFilter['source']) =>
  source === 'all' || line.source === source || source === `launch:${line.launch_node}`;

export function filterLines(lines: readonly LogLine[], filter: ConsoleFilter): LogLine[] {
  const lowest = LEVELS.indexOf(filter.level);
  const wanted = filter.search.trim().toLowerCase();
  const found = lines.filter(
    (line) =>
      line.run !== undefined ||
      (isOf(line, filter.source) &&
        LEVELS.indexOf(line.level) >= lowest &&
        (wanted === '' ||
          plainText(line.text).toLowerCase().includes(wanted) ||
          line.node_path.toLowerCase().includes(wanted))),
  );
  // A divider is kept only if there are lines on both of its sides.
  return found.filter((line, at) => line.run === undefined || isBetween(found, at));
}

function isBetween(lines: readonly LogLine[], at: number): boolean {
  const next = lines[at + 1];
  return at > 0 && next !== undefined && next.run === undefined;
}
