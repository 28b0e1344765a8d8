import type { LogLevel, LogSource } from '@/generated/messages';
import type { LogLine } from '@/store/session/types';
import { plainText } from './ansi';

export interface ConsoleFilter {
  source: LogSource | 'all';
  /** This level and those above it. */
  level: LogLevel;
  search: string;
}

export const LEVELS: LogLevel[] = ['debug', 'info', 'warning', 'error'];

export function filterLines(lines: readonly LogLine[], filter: ConsoleFilter): LogLine[] {
  const lowest = LEVELS.indexOf(filter.level);
  const wanted = filter.search.trim().toLowerCase();
  return lines.filter(
    (line) =>
      (filter.source === 'all' || line.source === filter.source) &&
      LEVELS.indexOf(line.level) >= lowest &&
      (wanted === '' ||
        plainText(line.text).toLowerCase().includes(wanted) ||
        line.node_path.toLowerCase().includes(wanted)),
  );
}
