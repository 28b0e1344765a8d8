import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { basicPage } from '../../../harness/basicPage';
import { show, user } from '../../../harness/testing';
import { ConsoleBar } from './ConsoleBar';
import { useConsoleFilter } from './filter';

const sources = [
  { value: 'all', label: 'All' },
  { value: 'world', label: 'World' },
];

beforeEach(() => {
  onTestFinished(() => {
    useConsoleFilter.setState(useConsoleFilter.getInitialState(), true);
    useSessionStore.setState(initialSession, true);
  });
});

it('sets what is searched and shown', async () => {
  show(<ConsoleBar sources={sources} toEnd={null} mayClear />);
  await user.type(screen.getByRole('searchbox'), 'crate');
  const [source, level] = screen.getAllByRole('combobox');
  await user.selectOptions(source!, 'world');
  await user.selectOptions(level!, 'error');
  expect(useConsoleFilter.getState()).toMatchObject({ search: 'crate', source: 'world', level: 'error' });
});

it('goes to the end only while the view does not follow it', async () => {
  const toEnd = vi.fn();
  const { rerender } = show(<ConsoleBar sources={sources} toEnd={null} mayClear />);
  const buttons = () => screen.getAllByRole('button');
  expect(buttons()).toHaveLength(1);
  rerender(<ConsoleBar sources={sources} toEnd={toEnd} mayClear />);
  await user.click(buttons()[0]!);
  expect(toEnd).toHaveBeenCalledOnce();
});

it('removes the lines of the present, if it may', async () => {
  const line = {
    time: 1,
    source: 'world',
    level: 'info',
    text: 'a',
    node_id: '',
    node_path: '',
    launch_node: '',
  };
  useSessionStore.setState({ logs: [{ ...line, id: 1 } as never] });
  const { rerender } = show(<ConsoleBar sources={sources} toEnd={null} mayClear={false} />);
  expect(screen.getByRole('button')).toBeDisabled();
  rerender(<ConsoleBar sources={sources} toEnd={null} mayClear />);
  await user.click(screen.getByRole('button'));
  expect(useSessionStore.getState().logs).toEqual([]);
});

it('is a search alone in the basic page, until a filter hides lines', () => {
  basicPage();
  show(<ConsoleBar sources={sources} toEnd={null} mayClear />);
  expect(screen.queryAllByRole('combobox')).toEqual([]);
  expect(screen.queryAllByRole('button')).toEqual([]);
  act(() => useConsoleFilter.setState({ level: 'error' }));
  expect(screen.getAllByRole('combobox')).toHaveLength(2);
});
