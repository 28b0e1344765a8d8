import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { toggleLine, useLines } from '@/store/python/lines';
import { usePython } from '@/store/python/stop';
import { show, user, watchNavigation } from '../../../harness/testing';
import { LineList } from './LineList';

const now = () => useLines.getState();

beforeEach(() => useLines.setState({ list: [], exceptions: [], watches: [] }));

it('lists breakpoints; each is shown, changed, switched and removed', async () => {
  const { openFile } = watchNavigation();
  show(<LineList />);
  expect(screen.getByText(/No breakpoints in Python/)).toBeInTheDocument();
  act(() => {
    toggleLine('actions/Turn.py', 12);
    usePython.setState({ problems: { 'actions/Turn.py:12': 'No code here.' } });
  });
  expect(screen.getByText('No code here.')).toBeInTheDocument();
  act(() => usePython.setState(usePython.getInitialState()));
  await user.click(screen.getByRole('button', { name: 'actions/Turn.py:12' }));
  expect(openFile).toHaveBeenCalledWith('actions/Turn.py', 12);
  await user.click(screen.getByRole('button', { name: /Conditions of/ }));
  await user.type(screen.getByRole('textbox', { name: /Condition/ }), 'n > 3{Enter}');
  await user.type(screen.getByRole('textbox', { name: /Log line/ }), 'hi{Enter}');
  expect(now().list).toMatchObject([{ condition: 'n > 3', log: 'hi' }]);
  expect(screen.getByText('if n > 3 · writes “hi”')).toBeInTheDocument();
  await user.click(screen.getByRole('checkbox', { name: /is on/ }));
  expect(now().list[0]?.on).toBe(false);
  await user.click(screen.getByRole('button', { name: /Remove the breakpoint/ }));
  expect(now().list).toEqual([]);
});

it('stops at exceptions, and removes all', async () => {
  toggleLine('actions/Turn.py', 12);
  show(<LineList />);
  await user.click(screen.getByTestId('exception-userUnhandled'));
  expect(now().exceptions).toEqual(['userUnhandled']);
  await user.click(screen.getByRole('button', { name: 'Remove all' }));
  expect(now().list).toEqual([]);
});

it('says that the debugger does not reach launch nodes', () => {
  toggleLine('launch/talker.py', 3);
  show(<LineList />);
  expect(screen.getByTestId('line-launch/talker.py:3')).toHaveTextContent(/process of its own/);
});
