import { act } from '@testing-library/react';
import { onTestFinished } from 'vitest';
import { useLines } from '@/store/python/lines';
import { takeAnswer } from '@/store/python/client';
import { usePython } from '@/store/python/stop';
import { listenToDap } from '@/store/session/dap';
import { FakeDebugger } from './pythonDebugger';
import { openSession } from './testing';

export const stop = {
  thread: 1,
  reason: 'breakpoint',
  text: '',
  frames: [
    { id: 7, name: 'update', path: 'actions/Turn.py', line: 12 },
    { id: 8, name: 'tick', path: '', line: 3 },
  ],
  frame: 0,
  version: 1,
};

/** Connects the page with a debugger whose program is stopped. */
export async function stopInPython(): Promise<FakeDebugger> {
  const python = new FakeDebugger(await openSession());
  onTestFinished(listenToDap(takeAnswer));
  act(() => {
    useLines.setState({ list: [], exceptions: [], watches: [] });
    usePython.setState({ phase: 'on', stop, problems: {}, refusal: '' });
  });
  onTestFinished(() => act(() => usePython.setState(usePython.getInitialState())));
  return python;
}
