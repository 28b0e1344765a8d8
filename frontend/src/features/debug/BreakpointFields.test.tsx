import { act, screen, within } from '@testing-library/react';
import { afterEach, expect, it } from 'vitest';
import type { TreeNode } from '@/generated/messages';
import '@/i18n/editorTexts';
import { plainBreakpoint } from '@/model/breakpoints';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { attached } from '../../../harness/attached';
import { show, user } from '../../../harness/testing';
import { BreakpointFields } from './BreakpointFields';

const node = (uid: number, parent: number, tree_id: string, node_id: string, type = 'Sleep'): TreeNode => ({
  uid,
  parent,
  type,
  kind: '',
  name: node_id,
  path: `path ${uid}`,
  node_id,
  tree_id,
});

function Shown() {
  const breakpoint = useBreakpoints((state) => state.list[0]);
  return breakpoint ? <BreakpointFields breakpoint={breakpoint} /> : null;
}
const now = () => useBreakpoints.getState().list[0];

afterEach(() =>
  act(() => {
    useBreakpoints.setState({ list: [] });
    useSessionStore.setState(initialSession);
  }),
);

it('change when the tree is held, from which hit, and with a whole condition', async () => {
  useBreakpoints.setState({ list: [plainBreakpoint('Dock', 'd')] });
  show(<Shown />);
  expect(screen.queryByTestId('breakpoint-status')).toBeNull();
  await user.selectOptions(screen.getByTestId('breakpoint-when'), 'returns');
  expect(now()).toMatchObject({ when: 'returns', status: 'FAILURE' });
  await user.clear(screen.getByLabelText('From hit'));
  await user.type(screen.getByLabelText('From hit'), '3');
  await user.type(screen.getByTestId('breakpoint-condition'), 'x >');
  expect(now()).toMatchObject({ hits: 3, condition: '' });
  await user.type(screen.getByTestId('breakpoint-condition'), ' 1{Enter}');
  expect(now()?.condition).toBe('x > 1');
});

it('choose one instance of a tree that is called several times', async () => {
  useBreakpoints.setState({ list: [plainBreakpoint('Dock', 'd')] });
  useSessionStore.setState({
    tree: [
      node(1, 0, 'Main', 'r', 'Sequence'),
      node(2, 1, 'Main', 's1', 'SubTree'),
      node(3, 2, 'Dock', 'd'),
      node(4, 1, 'Main', 's2', 'SubTree'),
      node(5, 4, 'Dock', 'd'),
    ],
  });
  show(<Shown />);
  await user.selectOptions(screen.getByLabelText('Where'), 'path 5');
  expect(now()?.instance).toEqual(['s2']);
  await user.selectOptions(screen.getByLabelText('Where'), 'in all 2 instances');
  expect(now()?.instance).toBeNull();
});

it('offer for another program only what its protocol has', () => {
  useBreakpoints.setState({ list: [plainBreakpoint('Dock', 'd')] });
  useSessionStore.setState({ attached: attached() });
  show(<Shown />);
  const when = within(screen.getByTestId('breakpoint-when')).getAllByRole('option');
  expect(when.map((each) => each.getAttribute('value'))).toEqual(['before', 'after']);
  expect(screen.queryByLabelText('From hit')).toBeNull();
  for (const id of ['breakpoint-condition', 'breakpoint-log']) expect(screen.queryByTestId(id)).toBeNull();
  act(() => useSessionStore.setState({ attached: null }));
  expect(screen.getByLabelText('From hit')).toBeInTheDocument();
  expect(screen.getByTestId('breakpoint-condition')).toBeInTheDocument();
});
