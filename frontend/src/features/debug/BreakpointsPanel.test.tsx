import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { toggleBreakpoint, useBreakpoints } from '@/store/debug/breakpoints';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openDiagram } from '../../../harness/canvas';
import { show, user, watchNavigation } from '../../../harness/testing';
import { BreakpointsPanel } from './BreakpointsPanel';

const list = () => useBreakpoints.getState().list;

beforeEach(() =>
  openDiagram({
    root: 'r',
    nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep', name: 'wait' } },
  }),
);
afterEach(() =>
  act(() => {
    useBreakpoints.setState({ list: [], areOn: true, refusal: '' });
    useSessionStore.setState(initialSession);
  }),
);

it('says how to set a breakpoint while there is none', () => {
  show(<BreakpointsPanel />);
  expect(screen.getByText(/Select a block and press F9/)).toBeVisible();
});

it('lists breakpoints of blocks that exist; each is shown, switched, edited and removed', async () => {
  const { openTree } = watchNavigation();
  toggleBreakpoint('Main', 'a');
  toggleBreakpoint('Main', 'gone');
  show(<BreakpointsPanel />);
  expect(screen.getAllByRole('listitem')).toHaveLength(1);
  await user.click(screen.getByRole('button', { name: 'wait' }));
  expect(openTree).toHaveBeenCalledWith('Main');
  await user.click(screen.getByRole('checkbox', { name: 'The breakpoint of wait is on' }));
  expect(list()[0]?.on).toBe(false);
  await user.click(screen.getByTestId('edit-a'));
  await user.selectOptions(screen.getByTestId('breakpoint-when'), 'returns');
  await user.selectOptions(screen.getByTestId('breakpoint-status'), 'SUCCESS');
  await user.type(screen.getByTestId('breakpoint-condition'), 'x > 1{Enter}');
  await user.type(screen.getByTestId('breakpoint-log'), 'here');
  await user.tab();
  expect(list()[0]).toMatchObject({ when: 'returns', status: 'SUCCESS', condition: 'x > 1', log: 'here' });
  expect(screen.getByTestId('row-a')).toHaveTextContent('when it returns SUCCESS · if x > 1 · writes “here”');
  await user.click(screen.getByTestId('remove-a'));
  expect(screen.queryByRole('listitem')).toBeNull();
});

it('switches all, removes all, and tells a refusal and a viewer', async () => {
  toggleBreakpoint('Main', 'a');
  useBreakpoints.setState({ refusal: 'A breakpoint cannot be set' });
  useSessionStore.setState({ introspection: { role: 'viewer' } as never });
  show(<BreakpointsPanel />);
  expect(screen.getByRole('alert')).toHaveTextContent('A breakpoint cannot be set');
  expect(screen.getByText(/take effect when you take over/)).toBeVisible();
  await user.click(screen.getByTestId('breakpoints-on'));
  expect(useBreakpoints.getState().areOn).toBe(false);
  await user.click(screen.getByRole('button', { name: 'Remove all' }));
  expect(list()).toEqual([]);
});
