import { create } from 'zustand';
import { reasonOf } from '@/api/reason';
import { request } from './client';

/** A frame of the stack; `path` is a file of the project, or empty. */
export interface Frame {
  readonly id: number;
  readonly name: string;
  readonly path: string;
  readonly line: number;
}

/** A value, and where its parts are asked for: 0 if it has none. */
export interface Variable {
  readonly name: string;
  readonly value: string;
  readonly type: string;
  readonly reference: number;
}

/** A stop of the program at a line. */
export interface Stop {
  readonly thread: number;
  readonly reason: string;
  /** The text of the exception; empty at other stops. */
  readonly text: string;
  readonly frames: readonly Frame[];
  /** The frame whose variables are shown. */
  readonly frame: number;
  /** Grows with each change of a value, so that all are read again. */
  readonly version: number;
}

interface PythonData {
  /** Whether a debugger was asked for (`ready`), and whether it is connected with a program (`on`). */
  readonly phase: 'off' | 'ready' | 'on';
  readonly stop: Stop | null;
  /** Why a breakpoint cannot hold, by `path:line`. */
  readonly problems: Readonly<Record<string, string>>;
  /** Why the debugger refused what was asked last; empty if it did not. */
  readonly refusal: string;
}

/** The Python debugger of this page. */
export const usePython = create<PythonData>(() => ({ phase: 'off', stop: null, problems: {}, refusal: '' }));

/** Returns the frame that is shown. */
export const shownFrame = ({ stop }: PythonData): Frame | undefined => stop?.frames[stop.frame];

/** Shows another frame of the stack. */
export const chooseFrame = (frame: number) =>
  usePython.setState(({ stop }) => (stop ? { stop: { ...stop, frame } } : {}));

/** Whether the program is stopped at a line. */
export const isStopped = () => usePython.getState().stop !== null;

export type PythonStep = 'continue' | 'next' | 'stepIn' | 'stepOut';

/** Lets the stopped program continue, or make a step. */
export async function goOn(step: PythonStep): Promise<void> {
  const { stop } = usePython.getState();
  if (stop) await tried(() => request(step, { threadId: stop.thread }));
}

/** Keeps why a request was refused, and shows it; returns what it gave, or undefined. */
async function tried<Body>(doing: () => Promise<Body>): Promise<Body | undefined> {
  try {
    const done = await doing();
    usePython.setState({ refusal: '' });
    return done;
  } catch (error) {
    usePython.setState({ refusal: reasonOf(error) });
    return undefined;
  }
}

interface RawVariable {
  readonly name: string;
  readonly value: string;
  readonly type?: string;
  readonly variablesReference: number;
}

/** Groups of names that Python itself makes; they would hide the project's. */
const INTERNAL = ['special variables', 'function variables', 'class variables'];

const known = ({ name, value, type = '', variablesReference }: RawVariable): Variable => ({
  name,
  value,
  type,
  reference: variablesReference,
});

/** Returns the scopes of a frame. */
export async function scopesOf(frame: number): Promise<Variable[]> {
  const { scopes } = await request<{ scopes: { name: string; variablesReference: number }[] }>('scopes', {
    frameId: frame,
  });
  return scopes.map(({ name, variablesReference }) => known({ name, value: '', variablesReference }));
}

/** Returns the parts of a value. */
export async function partsOf(reference: number): Promise<Variable[]> {
  const { variables } = await request<{ variables: RawVariable[] }>('variables', {
    variablesReference: reference,
  });
  return variables.filter(({ name }) => !INTERNAL.includes(name)).map(known);
}

/** Gives a variable another value; the run is then marked as changed by hand. */
export async function setVariable(reference: number, name: string, value: string): Promise<void> {
  const done = await tried(() => request('setVariable', { variablesReference: reference, name, value }));
  if (done !== undefined) readAgain();
}

const readAgain = () =>
  usePython.setState(({ stop }) => (stop ? { stop: { ...stop, version: stop.version + 1 } } : {}));

type Context = 'repl' | 'watch' | 'hover';

/** Evaluates an expression in the frame that is shown; rejects with the text of its exception. */
export async function evaluate(expression: string, context: Context): Promise<Variable> {
  const frame = shownFrame(usePython.getState());
  const { result, type, variablesReference } = await request<{
    result: string;
    type?: string;
    variablesReference: number;
  }>('evaluate', { expression, context, ...(frame ? { frameId: frame.id } : {}) });
  if (context === 'repl') readAgain();
  return known({ name: expression, value: result, ...(type ? { type } : {}), variablesReference });
}

/** Returns what can follow a text in the frame that is shown. */
export async function completionsOf(text: string): Promise<string[]> {
  const frame = shownFrame(usePython.getState());
  if (!frame) return [];
  const column = text.length + 1;
  const { targets } = await request<{ targets: { label: string; start?: number }[] }>('completions', {
    frameId: frame.id,
    text,
    column,
  });
  const start = /[\w]*$/.exec(text)?.index ?? text.length;
  return targets.slice(0, 50).map(({ label }) => text.slice(0, start) + label);
}
