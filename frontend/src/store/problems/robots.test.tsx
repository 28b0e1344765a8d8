import { act, renderHook } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { Diagnostic } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { useSavingStore } from '@/store/saving/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { fakeServer, openProject } from '../../../harness/testing';
import { followRobots, useRobotFindings } from './robots';
import { useProblems } from './useProblems';

const CHECK = 'POST /projects/p1/check';
const FILE = 'robots/own/robot.xacro';
const note: Diagnostic = { code: 'BT0915', severity: 'note', message: 'not looked at', file: FILE };
const broken: Diagnostic = { code: 'BT0916', severity: 'error', message: 'no', file: FILE, line: 3 };
const other: Diagnostic = { code: 'BT0623', severity: 'warning', message: 'nobody', file: 'actions/Go.py' };

let answers: Record<string, unknown>;
let requests: ReturnType<typeof fakeServer>['requests'];
const answer = (...diagnostics: Diagnostic[]) => ({ diagnostics, actions: [], checked: true });
const idle = () => act(() => vi.advanceTimersByTimeAsync(1500));

function open(diagnostics: readonly Diagnostic[] = [note, other]) {
  openProject({ texts: { [FILE]: '<robot/>', 'notes.md': '' }, diagnostics });
  onTestFinished(followRobots());
  const { result } = renderHook(useProblems);
  return () => result.current.map(({ code }) => code);
}

beforeEach(() => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
  answers = { [CHECK]: answer(broken, other, other) };
  ({ requests } = fakeServer(answers));
  onTestFinished(() => {
    vi.useRealTimers();
    useRobotFindings.setState(useRobotFindings.getInitialState(), true);
    useSavingStore.setState(useSavingStore.getInitialState(), true);
    useSessionStore.setState(initialSession, true);
  });
});

describe('the check of robots with macros', () => {
  it('takes the place of the note, and leaves all other findings to the save', async () => {
    const codes = open();
    expect(codes()).toEqual(['BT0623', 'BT0915']);
    await idle();
    expect(requests.map(({ body }) => body)).toEqual([{ files: [] }]);
    expect(codes()).toEqual(['BT0916', 'BT0623']);
  });

  it('is not requested for a project without macros', async () => {
    open([other]);
    await idle();
    expect(requests).toEqual([]);
  });

  it('waits for the save, and is requested again for another version of a robot only', async () => {
    const codes = open();
    act(() => useSavingStore.setState({ state: { kind: 'dirty' } }));
    await idle();
    expect(requests).toEqual([]);
    act(() => useSavingStore.setState({ state: { kind: 'saved' } }));
    await idle();
    act(() => useProjectStore.getState().rebase('notes.md', 2, ''));
    await idle();
    expect(requests).toHaveLength(1);
    act(() => useProjectStore.getState().rebase(FILE, 2, '<robot/>'));
    expect(codes()).toEqual(['BT0623', 'BT0915']);
    await idle();
    expect(requests).toHaveLength(2);
    expect(codes()).toEqual(['BT0916', 'BT0623']);
  });

  it('says that they are not looked at while no executor is there, and asks again once there is one', async () => {
    answers[CHECK] = answer(note);
    const codes = open();
    await idle();
    expect(codes()).toEqual(['BT0623', 'BT0915']);
    answers[CHECK] = answer();
    act(() => useSessionStore.setState({ connection: 'open' }));
    await idle();
    expect(codes()).toEqual(['BT0623']);
    expect(requests).toHaveLength(2);
  });

  it('leaves the note where there is no answer', async () => {
    delete answers[CHECK];
    const codes = open();
    await idle();
    expect(requests).toHaveLength(1);
    expect(codes()).toEqual(['BT0623', 'BT0915']);
  });
});
