import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { usePalette } from '@/commands/palette';
import { setName } from '@/model/edits';
import { useProjectStore } from '@/store/project';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openProject, show, user } from '../../../harness/testing';
import { Hint } from './Hint';
import { useHints, type HintId } from './hints';

const hint = () => screen.queryByTestId('hint')?.dataset['hint'];
const done = () => useHints.getState().done;

function open(...read: HintId[]) {
  useHints.setState({ done: read });
  show(<Hint />);
}

beforeEach(() => {
  localStorage.clear();
  openProject({ trees: { Main: { r: { type: 'Sequence' } } } });
  onTestFinished(() => {
    useSessionStore.setState(initialSession);
    usePalette.setState({ page: null });
    localStorage.clear();
  });
});

describe('Hint', () => {
  it.each([
    [[], 'build', /Drag blocks onto the tree/],
    [['build'], 'run', /Press Run/],
    [['run'], 'build', /Drag blocks onto the tree/],
    [['build', 'run'], 'find', /found with Ctrl\+K/],
  ] as const)('after %o is the one to %s', (read, id, text) => {
    open(...read);
    expect(hint()).toBe(id);
    expect(screen.getByRole('status')).toHaveTextContent(text);
  });

  it('is absent after all were read', () => {
    open('build', 'run', 'find');
    expect(hint()).toBeUndefined();
  });

  it('is absent for a viewer', () => {
    act(() => useProjectStore.setState({ role: 'viewer' }));
    open();
    expect(hint()).toBeUndefined();
  });

  it('to build is followed by an edit', () => {
    open();
    act(() => useProjectStore.getState().apply('Main', 'rename', [setName('r', 'Work')]));
    expect(hint()).toBe('run');
    expect(done()).toEqual(['build']);
  });

  it('to run is followed by a run', () => {
    open('build');
    act(() => useSessionStore.setState({ executor: 'paused' }));
    expect(hint()).toBe('run');
    act(() => useSessionStore.setState({ executor: 'application_running' }));
    expect(hint()).toBe('find');
    expect(done()).toEqual(['build', 'run']);
  });

  it('to find opens the command palette', async () => {
    open('build', 'run');
    await user.click(screen.getByRole('button', { name: /Ctrl\+K/ }));
    expect(usePalette.getState().page).toBe(document);
    expect(hint()).toBeUndefined();
    expect(localStorage.getItem('bts.hints')).toBe('build run find');
  });

  it('is closed for good', async () => {
    open();
    expect(screen.getAllByRole('button')).toHaveLength(1);
    await user.click(screen.getByRole('button', { name: 'Close this hint permanently' }));
    expect(hint()).toBe('run');
    expect(localStorage.getItem('bts.hints')).toBe('build');
  });
});
