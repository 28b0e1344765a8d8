import { create } from 'zustand';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { useProjectStore } from '@/store/project';

/** A breakpoint at a line of a file of the project; lines count from 1. */
export interface LineBreakpoint {
  readonly path: string;
  readonly line: number;
  /** A Python expression that must be true; empty: always. */
  readonly condition: string;
  /** The first hit that counts. */
  readonly hits: number;
  /** A line for the console in place of a stop; empty: stop. */
  readonly log: string;
  readonly on: boolean;
}

/** The exceptions that stop a program: where one is raised, or where it leaves the project's code. */
export const EXCEPTIONS = ['raised', 'userUnhandled'] as const;
export type ExceptionFilter = (typeof EXCEPTIONS)[number];

interface LinesData {
  readonly list: readonly LineBreakpoint[];
  readonly exceptions: readonly ExceptionFilter[];
  /** Expressions that are shown at each stop. */
  readonly watches: readonly string[];
}

const NONE: LinesData = { list: [], exceptions: [], watches: [] };
const MOST = 500;
const LONGEST = 1000;

/** What this user has set in the Python code of the open project. */
export const useLines = create<LinesData>(() => NONE);

const isAt = (each: LineBreakpoint, path: string, line: number) => each.path === path && each.line === line;

/** Returns the breakpoints of a file. */
export const linesOf = (list: readonly LineBreakpoint[], path: string) =>
  list.filter((each) => each.path === path);

/** Whether a file belongs to the launch nodes: they are processes of their own, which the debugger does not reach. */
export const isOfLaunchNode = (path: string): boolean => path.startsWith('launch/');

/** Sets a breakpoint at a line, or removes it; one that is set switches all on. */
export function toggleLine(path: string, line: number): void {
  const { list } = useLines.getState();
  const others = list.filter((each) => !isAt(each, path, line));
  if (others.length < list.length) return useLines.setState({ list: others });
  if (list.length >= MOST) return;
  const plain: LineBreakpoint = { path, line, condition: '', hits: 1, log: '', on: true };
  useLines.setState({ list: sorted([...list, plain]) });
  useBreakpoints.setState({ areOn: true });
}

/** Changes the breakpoint of a line. */
export const changeLine = (path: string, line: number, change: Partial<LineBreakpoint>) =>
  useLines.setState(({ list }) => ({
    list: list.map((each) => (isAt(each, path, line) ? { ...each, ...change } : each)),
  }));

/** Moves the breakpoints of a file with its text: `moved` has the new line of each old one, in order. */
export function moveLines(path: string, moved: readonly (readonly [from: number, to: number])[]): void {
  const targets = new Map(moved);
  const { list } = useLines.getState();
  const next = list.map((each) =>
    each.path === path ? { ...each, line: targets.get(each.line) ?? each.line } : each,
  );
  const isSame = next.every((each, at) => each.line === list[at]?.line);
  const isFirst = (each: LineBreakpoint, at: number) =>
    next.findIndex((other) => isAt(other, each.path, each.line)) === at;
  if (!isSame) useLines.setState({ list: next.filter(isFirst) });
}

/** Lets the breakpoints of a file follow its new name. */
export function renameLines(from: string, to: string): void {
  const { list } = useLines.getState();
  if (linesOf(list, from).length === 0) return;
  useLines.setState({ list: list.map((each) => (each.path === from ? { ...each, path: to } : each)) });
}

export const removeAllLines = () => useLines.setState({ list: [] });

/** Stops at exceptions, or not any more. */
export const toggleException = (filter: ExceptionFilter) =>
  useLines.setState(({ exceptions }) => ({
    exceptions: exceptions.includes(filter)
      ? exceptions.filter((each) => each !== filter)
      : [...exceptions, filter],
  }));

/** Shows an expression at each stop, or not any more. */
export const toggleWatch = (expression: string) =>
  useLines.setState(({ watches }) => ({
    watches: watches.includes(expression)
      ? watches.filter((each) => each !== expression)
      : [...watches, expression],
  }));

const sorted = (list: readonly LineBreakpoint[]) =>
  [...list].sort((a, b) => a.path.localeCompare(b.path) || a.line - b.line);

const keyOf = (user: string, projectId: string) => `bts.lines.${user}.${projectId}`;

/** Loads and keeps what a user has set in the open project. */
export function followLines(user: string): () => void {
  load(user, useProjectStore.getState().projectId);
  const stops = [
    useProjectStore.subscribe((now, before) => {
      if (now.projectId !== before.projectId) load(user, now.projectId);
    }),
    useLines.subscribe((now) => {
      const { projectId } = useProjectStore.getState();
      if (projectId !== null) localStorage.setItem(keyOf(user, projectId), JSON.stringify(now));
    }),
  ];
  return () => stops.forEach((stop) => stop());
}

function load(user: string, projectId: string | null): void {
  useLines.setState(projectId === null ? NONE : kept(keyOf(user, projectId)));
}

function kept(key: string): LinesData {
  try {
    const stored = JSON.parse(localStorage.getItem(key) ?? '{}') as Partial<Record<keyof LinesData, unknown>>;
    const { list, exceptions, watches } = stored;
    return {
      list: Array.isArray(list) ? list.flatMap(readLine).slice(0, MOST) : [],
      exceptions: EXCEPTIONS.filter((each) => Array.isArray(exceptions) && exceptions.includes(each)),
      watches: Array.isArray(watches) ? watches.filter((each) => typeof each === 'string').slice(0, 50) : [],
    };
  } catch {
    return NONE; // The stored text is not readable: begin without.
  }
}

const text = (value: unknown): string => (typeof value === 'string' ? value.slice(0, LONGEST) : '');
const isCount = (value: unknown): value is number => Number.isInteger(value) && Number(value) >= 1;

function readLine(stored: unknown): LineBreakpoint[] {
  if (typeof stored !== 'object' || stored === null) return [];
  const { path, line, condition, hits, log, on } = stored as Record<string, unknown>;
  if (typeof path !== 'string' || !path || !isCount(line)) return [];
  return [
    {
      path,
      line,
      condition: text(condition),
      hits: isCount(hits) ? hits : 1,
      log: text(log),
      on: on !== false,
    },
  ];
}
