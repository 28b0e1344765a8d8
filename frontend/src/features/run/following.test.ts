import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import { useProjectStore } from '@/store/project';
import { liveKey, useLiveStore } from '@/store/project/live';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { treeNode } from '../../../harness/running';
import { openProject, watchNavigation } from '../../../harness/testing';
import { followRunning, runningLeaf, toggleFollowing, useFollowing } from './following';

const nodes = [
  treeNode(1, 0, 'root'),
  treeNode(2, 1, 'first'),
  treeNode(3, 1, 'branch'),
  treeNode(4, 3, 'second'),
  treeNode(5, 3, 'hidden', { node_id: '' }),
];

const leafOf = (...running: number[]) => runningLeaf(nodes, ({ uid }) => running.includes(uid))?.uid;

describe('runningLeaf', () => {
  it('is the first running node without a running child', () => {
    expect(leafOf()).toBeUndefined();
    expect(leafOf(1)).toBe(1);
    expect(leafOf(1, 3, 4)).toBe(4);
    expect(leafOf(1, 2, 3, 4)).toBe(2);
    expect(leafOf(1, 3, 5)).toBeUndefined();
  });
});

describe('following', () => {
  let openTree: ReturnType<typeof watchNavigation>['openTree'];
  const run = (...uids: number[]) => {
    const entries = uids.map((uid): [string, NodeStatus] => [liveKey('Main', `n${uid}`), 'RUNNING']);
    useLiveStore.setState({ statuses: new Map(entries) });
  };
  const revealed = () => useProjectStore.getState().revealed;

  beforeEach(() => {
    vi.useFakeTimers();
    localStorage.clear();
    openProject({ trees: { Main: { n1: { type: 'Sequence' } } } });
    ({ openTree } = watchNavigation());
    useSessionStore.setState({ tree: nodes });
    const stop = followRunning();
    onTestFinished(() => {
      stop();
      vi.useRealTimers();
      useFollowing.setState({ isOn: false });
      useLiveStore.getState().clear();
      useSessionStore.setState(initialSession, true);
      localStorage.clear();
    });
  });

  it('is off at first, and remembered', () => {
    expect(useFollowing.getState().isOn).toBe(false);
    toggleFollowing();
    expect([useFollowing.getState().isOn, localStorage.getItem('bts.followRunning')]).toEqual([true, '1']);
    toggleFollowing();
    expect([useFollowing.getState().isOn, localStorage.getItem('bts.followRunning')]).toEqual([false, '0']);
  });

  it('shows nothing while it is off', () => {
    run(1, 2);
    vi.advanceTimersByTime(2000);
    expect(openTree).not.toHaveBeenCalled();
  });

  it('shows the running block as soon as it is switched on', () => {
    run(1, 3, 4);
    toggleFollowing();
    vi.advanceTimersByTime(700);
    expect(openTree).toHaveBeenCalledExactlyOnceWith('Main');
    expect(revealed()).toMatchObject({ tree: 'Main', node: 'n4', count: 1 });
  });

  it('shows another block after a readable time, and only the last of several', () => {
    toggleFollowing();
    vi.advanceTimersByTime(700);
    run(1, 2);
    vi.advanceTimersByTime(600);
    run(1, 3, 4);
    vi.advanceTimersByTime(99);
    expect(revealed()).toBeFalsy();
    vi.advanceTimersByTime(1);
    expect(revealed()).toMatchObject({ node: 'n4', count: 1 });
    run(1, 2);
    vi.advanceTimersByTime(700);
    expect(revealed()).toMatchObject({ node: 'n2', count: 2 });
  });

  it('shows a block once while it runs', () => {
    toggleFollowing();
    run(1, 2);
    vi.advanceTimersByTime(700);
    run(1, 2);
    vi.advanceTimersByTime(700);
    expect(openTree).toHaveBeenCalledOnce();
  });

  it('stops when it is switched off', () => {
    toggleFollowing();
    run(1, 2);
    toggleFollowing();
    vi.advanceTimersByTime(2000);
    expect(openTree).not.toHaveBeenCalled();
  });
});
