import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { listenToDap } from '@/store/session/dap';
import { FakeDebugger } from '../../../harness/pythonDebugger';
import { openSession } from '../../../harness/testing';
import { takeAnswer } from './client';
import {
  chooseFrame,
  completionsOf,
  evaluate,
  goOn,
  isStopped,
  partsOf,
  scopesOf,
  setVariable,
  shownFrame,
  usePython,
} from './stop';

const frames = [
  { id: 7, name: 'update', path: 'actions/Turn.py', line: 12 },
  { id: 8, name: 'tick', path: '', line: 3 },
];
let python: FakeDebugger;

beforeEach(async () => {
  python = new FakeDebugger(await openSession());
  onTestFinished(listenToDap(takeAnswer));
  const stop = { thread: 1, reason: 'breakpoint', text: '', frames, frame: 0, version: 1 };
  usePython.setState({ phase: 'on', stop, refusal: '' });
  onTestFinished(() => usePython.setState(usePython.getInitialState()));
});

it('shows the innermost frame, or the one that is chosen', () => {
  expect(isStopped()).toBe(true);
  expect(shownFrame(usePython.getState())?.id).toBe(7);
  chooseFrame(1);
  expect(shownFrame(usePython.getState())?.id).toBe(8);
});

it('steps in the thread that is stopped, and says why it cannot', async () => {
  const step = goOn('stepIn');
  expect(await python.answer('stepIn', {}, 'not now')).toEqual({ threadId: 1 });
  await step;
  expect(usePython.getState().refusal).toBe('not now');
});

it('reads scopes and parts, without names of Python itself', async () => {
  const scopes = scopesOf(7);
  await python.answer('scopes', { scopes: [{ name: 'Locals', variablesReference: 3 }] });
  expect(await scopes).toEqual([{ name: 'Locals', value: '', type: '', reference: 3 }]);
  const parts = partsOf(3);
  await python.answer('variables', {
    variables: [
      { name: 'special variables', value: '', variablesReference: 4 },
      { name: 'n', value: '3', type: 'int', variablesReference: 0 },
    ],
  });
  expect(await parts).toEqual([{ name: 'n', value: '3', type: 'int', reference: 0 }]);
});

it('reads all values again after one was set', async () => {
  const set = setVariable(3, 'n', '4');
  expect(await python.answer('setVariable', { value: '4' })).toEqual({
    variablesReference: 3,
    name: 'n',
    value: '4',
  });
  await set;
  expect(usePython.getState().stop?.version).toBe(2);
});

it('evaluates in the frame that is shown', async () => {
  chooseFrame(1);
  const found = evaluate('n + 1', 'repl');
  expect(await python.answer('evaluate', { result: '4', type: 'int', variablesReference: 0 })).toEqual({
    expression: 'n + 1',
    context: 'repl',
    frameId: 8,
  });
  expect(await found).toEqual({ name: 'n + 1', value: '4', type: 'int', reference: 0 });
});

it('completes the last name of a text', async () => {
  const offered = completionsOf('1 + self.up');
  expect(await python.answer('completions', { targets: [{ label: 'update' }] })).toMatchObject({
    text: '1 + self.up',
    column: 12,
  });
  expect(await offered).toEqual(['1 + self.update']);
  usePython.setState({ stop: null });
  expect(await completionsOf('x')).toEqual([]);
});
