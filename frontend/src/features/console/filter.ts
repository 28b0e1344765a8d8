import { create } from 'zustand';
import type { LogLevel, LogSource } from '@/generated/messages';
import type { LogLine } from '@/store/session/types';
import { plainText } from './ansi';

export interface ConsoleFilter {
  /** One of the extra nodes by its id, or a whole source. */
  source: LogSource | 'all' | `launch:${string}`;
  /** This level and those above it. */
  level: LogLevel;
  search: string;
}

export const LEVELS: LogLevel[] = ['debug', 'info', 'warning', 'error'];

/** The filter of the console; other panels set it when they lead the user there. */
export const useConsoleFilter = create<ConsoleFilter>(() => ({ source: 'all', level: 'info', search: '' }));

const isOf = (line: LogLine, source: ConsoleFilter['source']) =>
  source === 'all' || line.source === source || source === `launch:${line.launch_node}`;

export function filterLines(lines: readonly LogLine[], filter: ConsoleFilter): LogLine[] {
  const lowest = LEVELS.indexOf(filter.level);
  const wanted = filter.search.trim().toLowerCase();
  return lines.filter(
    (line) =>
      isOf(line, filter.source) &&
      LEVELS.indexOf(line.level) >= lowest &&
      (wanted === '' ||
        plainText(line.text).toLowerCase().includes(wanted) ||
        line.node_path.toLowerCase().includes(wanted)),
  );
}
