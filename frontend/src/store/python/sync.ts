import { reasonOf } from '@/api/reason';
import { t } from '@/i18n';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { showFile } from '@/store/project/navigation';
import { listenToDap, type DapMessage } from '@/store/session/dap';
import { useSessionStore } from '@/store/session/store';
import type { SessionData } from '@/store/session/types';
import { dropRequests, request, takeAnswer } from './client';
import { isOfLaunchNode, useLines, type LineBreakpoint } from './lines';
import { usePython, type Frame } from './stop';

const isDriver = ({ connection, introspection }: SessionData) =>
  connection === 'open' && introspection?.role === 'driver';

/** Returns the breakpoints that can hold now, by file. */
function wantedLines(): Map<string, LineBreakpoint[]> {
  const files = new Map<string, LineBreakpoint[]>();
  if (!useBreakpoints.getState().areOn) return files;
  for (const each of useLines.getState().list)
    if (each.on && !isOfLaunchNode(each.path)) files.set(each.path, [...(files.get(each.path) ?? []), each]);
  return files;
}

const wantedExceptions = () => (useBreakpoints.getState().areOn ? useLines.getState().exceptions : []);
const isWanted = () => wantedLines().size + wantedExceptions().length > 0;

/** What the program has, as text, by file; exceptions are at the empty name. */
let given = new Map<string, string>();

/**
 * Debugs the Python code of each program of the session while this page drives it and something is set: sends
 * the breakpoints before its code is loaded, and after each change, and shows where it is stopped.
 */
export function followPython(): () => void {
  const stops = [
    listenToDap(receive),
    useSessionStore.subscribe((now, before) => {
      if (isDriver(now) !== isDriver(before)) begin();
    }),
    useLines.subscribe((now, before) => {
      if (now.list !== before.list || now.exceptions !== before.exceptions) change();
    }),
    useBreakpoints.subscribe((now, before) => {
      if (now.areOn !== before.areOn) change();
    }),
  ];
  begin();
  return () => {
    stops.forEach((stop) => stop());
    forget();
  };
}

function forget(): void {
  dropRequests();
  given = new Map();
  usePython.setState({ phase: 'off', stop: null, problems: {}, refusal: '' });
}

function begin(): void {
  forget();
  if (isDriver(useSessionStore.getState()) && isWanted()) start();
}

function start(): void {
  usePython.setState({ phase: 'ready' });
  quietly(request('initialize', { clientID: 'bt-studio', adapterID: 'debugpy' }));
}

/** A program stays connected without breakpoints; the next one is debugged only if one is set. */
function change(): void {
  const { phase } = usePython.getState();
  if (phase === 'on') quietly(give());
  else if (phase === 'ready' && !isWanted()) end();
  else if (phase === 'off' && isDriver(useSessionStore.getState()) && isWanted()) start();
}

function end(): void {
  quietly(request('disconnect'));
  forget();
}

/** Keeps why something was refused; what is lost with the connection is no refusal. */
function quietly(doing: Promise<unknown>): void {
  doing.catch((error: unknown) => {
    if (usePython.getState().phase === 'off') return;
    usePython.setState({ refusal: reasonOf(error) });
  });
}

async function give(): Promise<void> {
  const wanted = wantedLines();
  for (const path of new Set([...given.keys(), ...wanted.keys()])) {
    if (path !== '') await giveFile(path, wanted.get(path) ?? []);
  }
  const filters = wantedExceptions();
  if (isNews('', filters)) await request('setExceptionBreakpoints', { filters: [...filters] });
}

/** Notes what the program has of a file; returns whether it is something else than before. */
function isNews(path: string, has: readonly unknown[]): boolean {
  const text = JSON.stringify(has);
  if ((given.get(path) ?? '[]') === text) return false;
  given.set(path, text);
  return true;
}

interface Answered {
  readonly breakpoints: readonly {
    readonly verified: boolean;
    readonly message?: string;
    readonly line?: number;
  }[];
}

async function giveFile(path: string, list: readonly LineBreakpoint[]): Promise<void> {
  if (!isNews(path, list)) return;
  const breakpoints = list.map(({ line, condition, hits, log }) => ({
    line,
    ...(condition ? { condition } : {}),
    ...(hits > 1 ? { hitCondition: `>=${hits}` } : {}),
    ...(log ? { logMessage: log } : {}),
  }));
  const give = (some: readonly object[]) =>
    request<Answered>('setBreakpoints', { source: { path }, breakpoints: some });
  const answer = await give(breakpoints);
  // The debugger moves one without code up to the last line that has some, which may never run.
  const isMoved = (at: number) => (answer.breakpoints[at]?.line ?? list[at]?.line) !== list[at]?.line;
  if (list.some((_, at) => isMoved(at))) await give(breakpoints.filter((_, at) => !isMoved(at)));
  const others = Object.entries(usePython.getState().problems).filter(([at]) => !at.startsWith(`${path}:`));
  const found = answer.breakpoints.flatMap(({ verified, message }, at): [string, string][] => {
    if (verified && !isMoved(at)) return [];
    return [[`${path}:${list[at]?.line}`, isMoved(at) ? t('debug:python.noCode') : (message ?? '?')]];
  });
  usePython.setState({ problems: Object.fromEntries([...others, ...found]) });
}

interface Changed {
  readonly breakpoint: {
    readonly verified: boolean;
    readonly message?: string;
    readonly line?: number;
    readonly source?: { readonly path?: string };
  };
}

/** Takes what the program finds out about a breakpoint when it comes there. */
function changed({ breakpoint: { verified, message, line, source } }: Changed): void {
  if (verified || !message || !source?.path || line === undefined) return;
  const { problems } = usePython.getState();
  usePython.setState({ problems: { ...problems, [`${source.path}:${line}`]: message } });
}

async function configure(): Promise<void> {
  given = new Map();
  usePython.setState({ phase: 'on', problems: {}, refusal: '' });
  await give();
  await request('configurationDone');
}

interface Stopped {
  readonly threadId: number;
  readonly reason: string;
}
interface RawFrame {
  readonly id: number;
  readonly name: string;
  readonly line: number;
  readonly source?: { readonly path?: string };
}

const frameOf = ({ id, name, line, source }: RawFrame): Frame => ({
  id,
  name,
  line,
  path: source?.path?.startsWith('/') ? '' : (source?.path ?? ''),
});

async function stopped({ threadId, reason }: Stopped): Promise<void> {
  const { stackFrames } = await request<{ stackFrames: RawFrame[] }>('stackTrace', { threadId });
  const frames = stackFrames.map(frameOf);
  const info =
    reason === 'exception'
      ? await request<{ exceptionId?: string; description?: string }>('exceptionInfo', { threadId })
      : {};
  const text = [info.exceptionId, info.description].filter(Boolean).join(': ');
  const version = (usePython.getState().stop?.version ?? 0) + 1;
  usePython.setState({
    stop: { thread: threadId, reason, text, frames, frame: 0, version },
    refusal: '',
  });
  const [top] = frames;
  if (top?.path) showFile(top.path);
}

function receive(message: DapMessage): void {
  if (takeAnswer(message)) return;
  if (message.event === 'initialized') quietly(configure());
  if (message.event === 'stopped') quietly(stopped(message.body as Stopped));
  if (message.event === 'breakpoint') changed(message.body as Changed);
  if (message.event === 'continued') usePython.setState({ stop: null });
  if (message.event === 'terminated') {
    dropRequests();
    usePython.setState({ phase: 'ready', stop: null, problems: {} });
    if (!isWanted()) end();
  }
}
