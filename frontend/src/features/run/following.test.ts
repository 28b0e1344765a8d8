import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import { useProjectStore } from '@/store/project';
import { liveKey, useLiveStore } from '@/store/project/live';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { treeNode } from '../../../harness/running';
import { openProject, watchNavigation } from '../../../harness/testing';
import { followRunning, runningBlock, toggleFollowing, useFollowing } from './following';

const nodes = [
  treeNode(1, 0, 'root'),
  treeNode(2, 1, 'first'),
  treeNode(3, 1, 'branch'),
  treeNode(4, 3, 'second'),
  treeNode(5, 3, 'hidden', { node_id: '' }),
];

const found = (...running: number[]) => runningBlock(nodes, ({ uid }) => running.includes(uid))?.uid;

it('the running block is the deepest, and the first of several', () => {
  expect(found()).toBeUndefined();
  expect(found(1)).toBe(1);
  expect(found(1, 3, 4)).toBe(4);
  expect(found(1, 2, 3, 4)).toBe(4);
  expect(found(1, 2, 3)).toBe(2);
  expect(found(1, 3, 5)).toBe(3);
});

const KEY = 'bts.followRunning.p1';

describe('following', () => {
  let showTree: ReturnType<typeof watchNavigation>['showTree'];
  const run = (...uids: number[]) => {
    const entries = uids.map((uid): [string, NodeStatus] => [liveKey('Main', `n${uid}`), 'RUNNING']);
    useLiveStore.setState({ statuses: new Map(entries) });
  };
  const revealed = () => useProjectStore.getState().revealed;

  beforeEach(() => {
    vi.useFakeTimers();
    localStorage.clear();
    openProject({ trees: { Main: { n1: { type: 'Sequence' } } } });
    ({ showTree } = watchNavigation());
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
    expect([useFollowing.getState().isOn, localStorage.getItem(KEY)]).toEqual([true, '1']);
    toggleFollowing();
    expect([useFollowing.getState().isOn, localStorage.getItem(KEY)]).toEqual([false, '0']);
  });

  it('shows nothing while it is off', () => {
    run(1, 2);
    vi.advanceTimersByTime(2000);
    expect(showTree).not.toHaveBeenCalled();
  });

  it('shows a block that has run long enough, and what it shows once', () => {
    toggleFollowing();
    run(1, 3, 4);
    vi.advanceTimersByTime(699);
    expect(showTree).not.toHaveBeenCalled();
    vi.advanceTimersByTime(1);
    expect(showTree).toHaveBeenCalledExactlyOnceWith('Main');
    expect(revealed()).toMatchObject({ tree: 'Main', node: 'n4', count: 1 });
    run(1, 3, 4);
    vi.advanceTimersByTime(2000);
    expect(revealed()).toMatchObject({ count: 1 });
  });

  it('stays at the block above while those below change in less than half a second', () => {
    toggleFollowing();
    for (let round = 0; round < 10; round += 1) {
      run(1, 3, 4);
      vi.advanceTimersByTime(200);
      run(1, 2);
      vi.advanceTimersByTime(200);
    }
    expect(revealed()).toMatchObject({ node: 'n1', count: 1 });
    run(1, 2);
    vi.advanceTimersByTime(1400);
    expect(revealed()).toMatchObject({ node: 'n2', count: 2 });
  });

  it('leaves the view alone where a file is in front, or somebody writes', () => {
    showTree.mockReturnValue(false);
    toggleFollowing();
    run(1, 2);
    vi.advanceTimersByTime(1400);
    expect(revealed()).toBeFalsy();
    showTree.mockReturnValue(true);
    const editor = document.createElement('div');
    editor.className = 'cm-editor';
    editor.tabIndex = 0;
    document.body.append(editor);
    editor.focus();
    vi.advanceTimersByTime(1400);
    expect(revealed()).toBeFalsy();
    editor.remove();
    vi.advanceTimersByTime(1400);
    expect(revealed()).toMatchObject({ node: 'n2' });
  });

  it('is of one project', () => {
    toggleFollowing();
    openProject({ trees: { Main: { n1: { type: 'Sequence' } } } });
    useProjectStore.setState({ projectId: 'other' });
    expect(useFollowing.getState().isOn).toBe(false);
    useProjectStore.setState({ projectId: 'p1' });
    expect(useFollowing.getState().isOn).toBe(true);
  });

  it('stops when it is switched off', () => {
    toggleFollowing();
    run(1, 2);
    toggleFollowing();
    vi.advanceTimersByTime(2000);
    expect(showTree).not.toHaveBeenCalled();
  });
});
