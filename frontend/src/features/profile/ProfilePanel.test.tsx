import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it } from 'vitest';
import '@/i18n/editorTexts';
import type { Profile } from '@/generated/messages';
import { useProfile } from '@/store/debug/profile';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openDiagram } from '../../../harness/canvas';
import { treeNode } from '../../../harness/heldTree';
import { openSession, show, user, watchNavigation } from '../../../harness/testing';
import { ProfilePanel } from './ProfilePanel';

const tree = [
  { ...treeNode(1, 'r'), kind: 'Control' },
  { ...treeNode(2, 'a'), kind: 'Action' },
];
const profile: Profile = {
  on: true,
  ticks: 4,
  tick_ms: 8,
  nodes: [
    { uid: 1, calls: 4, total_ms: 8, self_ms: 2 },
    { uid: 2, calls: 3, total_ms: 6, self_ms: 6 },
  ],
  sample: null,
  samples: 0,
  stacks: [],
};
const toggle = () => screen.getByTestId('profile-on');

beforeEach(() =>
  openDiagram({ root: 'r', nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep' } } }),
);
afterEach(() =>
  act(() => {
    useSessionStore.setState(initialSession);
    useProfile.setState({ isWanted: false });
  }),
);

it('says what is needed without a session, and who may switch', () => {
  show(<ProfilePanel />);
  expect(screen.getByText(/Run the project first/)).toBeVisible();
  expect(toggle()).toBeDisabled();
  act(() => useSessionStore.setState({ introspection: { role: 'viewer' } as never }));
  expect(screen.getByText(/Only the window that controls/)).toBeVisible();
  expect(toggle()).toBeDisabled();
});

it('switches the measurement on and off', async () => {
  const { sent } = await openSession();
  show(<ProfilePanel />);
  expect(screen.getByText(/It costs little/)).toBeVisible();
  await user.click(toggle());
  expect(toggle()).toBeChecked();
  await user.click(toggle());
  expect(toggle()).not.toBeChecked();
  expect(sent.filter(({ command }) => command === 'profile').map(({ data }) => data)).toEqual([
    { on: true },
    { on: false },
  ]);
});

it('shows the times as a flame graph and as a table that leads to the blocks', async () => {
  const { openTree } = watchNavigation();
  useSessionStore.setState({ tree, profile, introspection: { role: 'viewer' } as never });
  show(<ProfilePanel />);
  expect(toggle()).toBeChecked();
  expect(screen.getByTestId('profile-ticks')).toHaveTextContent('4 ticks, 2.000 ms each');
  expect(screen.getByTitle(/^a: 6\.00 ms, 6\.00 ms of its own, in 3 ticks/)).toHaveStyle({ width: '75%' });
  const rows = screen.getAllByRole('row').map((row) => row.textContent);
  expect(rows).toEqual(['NodeShareOwn µsAll µsTicks', 'a75.0 %2000.02000.03', 'r25.0 %500.02000.04']);
  await user.click(screen.getByRole('button', { name: 'a' }));
  expect(openTree).toHaveBeenCalledWith('Main');
  expect(screen.queryByRole('button', { name: /Sample/ })).toBeNull();
});

it('samples a leaf on request, and shows where it spends its time', async () => {
  const { sent } = await openSession();
  act(() => useSessionStore.setState({ tree, profile }));
  show(<ProfilePanel />);
  expect(screen.queryByRole('button', { name: 'Sample the Python code of r' })).toBeNull();
  await user.click(screen.getByRole('button', { name: 'Sample the Python code of a' }));
  expect(sent.at(-1)?.data).toEqual({ on: true, sample: 2, path: 'a' });
  const stacks = [
    { frames: ['A.update (actions/A.py:3)', 'far (actions/A.py:9)'], samples: 3 },
    { frames: ['A.update (actions/A.py:4)'], samples: 1 },
  ];
  act(() => useSessionStore.setState({ profile: { ...profile, sample: 2, samples: 4, stacks } }));
  const shown = screen.getByRole('region', { name: 'Where a spends its time' });
  expect(shown).toHaveTextContent('4 samples');
  expect(screen.getAllByRole('listitem').map((item) => item.textContent)).toEqual([
    '75 % A.update (actions/A.py:3) › far (actions/A.py:9)',
    '25 % A.update (actions/A.py:4)',
  ]);
});
