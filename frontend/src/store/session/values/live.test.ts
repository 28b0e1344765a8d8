import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { TreeNode } from '@/generated/messages';
import { openProject } from '../../../../harness/testing';
import { blackboardId, initialSession } from '../reduce';
import { useSessionStore } from '../store';
import type { SessionData } from '../types';
import { feedValues, forgetValues, INTERVAL_MS, useLiveValues } from './live';
import { shownPort, showValues, useShownValues } from './shown';

const speed = shownPort('Main', 'a', 'speed');
const treeNode = (uid: number, parent: number, type: string, tree: string, id: string, path: string) =>
  ({ uid, parent, type, kind: '', name: '', path, tree_id: tree, node_id: id }) satisfies TreeNode;

const tree = [
  treeNode(1, 0, 'Sequence', 'Main', 'r', 'Sequence'),
  treeNode(2, 1, 'Move', 'Main', 'a', 'Move'),
  treeNode(3, 1, 'SubTree', 'Main', 's', 'Dock::3'),
  treeNode(4, 3, 'Move', 'Dock', 'd', 'Dock::3/Move'),
];

let session: SessionData;
let changedAt = 0;

function write(key: string, value: unknown, more: Partial<SessionData> = {}) {
  changedAt += 1;
  const row = { scope: '', key, value, type: 'float', preview: false, removed: false, changedAt };
  session = { ...session, ...more, blackboard: { ...session.blackboard, [blackboardId(row)]: row } };
}

const arrive = () => {
  useSessionStore.setState(session);
  feedValues(useSessionStore.getState);
};

/** Lets the session as it is now arrive, and waits until the next values are due. */
function feed() {
  vi.advanceTimersByTime(INTERVAL_MS);
  arrive();
  vi.advanceTimersByTime(INTERVAL_MS);
}
const shown = (port = speed) => useLiveValues.getState().values.get(port);

beforeEach(() => {
  vi.useFakeTimers();
  onTestFinished(() => {
    forgetValues();
    useSessionStore.setState(initialSession);
    vi.useRealTimers();
  });
  localStorage.clear();
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['a', 's'] },
        a: { type: 'Move', ports: { speed: '{v}', text: 'fast' } },
        s: { type: 'SubTree', tree: 'Dock', ports: { rate: '{v}' } },
      },
      Dock: { d: { type: 'Move', ports: { speed: '{rate}' } } },
    },
  });
  useShownValues.setState({ ports: new Set() });
  session = { ...initialSession, tree, executor: 'application_running' };
  showValues([speed], true);
});

describe('live values', () => {
  it('are those of the entry to which the port points, with their last samples', () => {
    write('v', 0.5);
    feed();
    write('v', 1);
    feed();
    feed();
    expect(shown()).toMatchObject({ key: 'v', value: 1, samples: [0.5, 1, 1] });
  });

  it('come at a limited rate, and the last one is never lost', () => {
    write('v', 1);
    feed();
    for (const value of [2, 3, 4]) {
      write('v', value);
      arrive();
    }
    expect(shown()?.samples).toEqual([1, 2]);
    vi.advanceTimersByTime(INTERVAL_MS);
    expect(shown()?.samples).toEqual([1, 2, 4]);
  });

  it('of a port that is chosen while time is paused are shown too', () => {
    showValues([speed], false);
    write('v', 1, { executor: 'paused' });
    feed();
    expect(shown()).toBeUndefined();
    showValues([speed], true);
    vi.advanceTimersByTime(INTERVAL_MS);
    expect(shown()).toMatchObject({ value: 1 });
  });

  it('stay as they are while time is paused', () => {
    write('v', 1, { executor: 'paused' });
    feed();
    const first = shown();
    feed();
    expect(shown()).toBe(first);
  });

  it('are followed through the ports of SubTrees', () => {
    const inner = shownPort('Dock', 'd', 'speed');
    showValues([inner], true);
    write('v', 0.25);
    feed();
    expect(shown(inner)).toMatchObject({ key: 'v', value: 0.25 });
  });

  it('have samples only if they are numbers', () => {
    write('v', 'door');
    feed();
    expect(shown()).toMatchObject({ value: 'door', samples: [] });
    write('v', true);
    feed();
    expect(shown()?.samples).toEqual([1]);
  });

  it('begin again with a new tree, and end with the choice', () => {
    write('v', 1);
    feed();
    session = { ...session, tree: [...tree] };
    feed();
    expect(shown()?.samples).toEqual([1]);
    showValues([speed], false);
    feed();
    expect(shown()).toBeUndefined();
  });

  it('are none for ports without a key or an entry', () => {
    showValues([shownPort('Main', 'a', 'text'), shownPort('Main', 'gone', 'speed')], true);
    feed();
    expect(useLiveValues.getState().values.size).toBe(0);
  });
});
