import { act, screen } from '@testing-library/react';
import { afterEach, expect, it, onTestFinished } from 'vitest';
import { show, user } from '../../../harness/testing';
import { outcomeOf, place } from '../../../harness/tries';
import { useMoment } from '@/store/moment/store';
import { hidePaths, useShownPaths } from '@/store/session/trace/shownPaths';
import { beginJob, changeJob, useTries } from '@/store/session/tries';
import { TryResults } from './TryResults';

afterEach(() => useTries.setState({ job: null }));

it('shows the rows that wait once the run is at the moment', () => {
  beginJob('a1', place, ['1']);
  changeJob('a1', () => ({ started: { job: 'a1', t: 3.25, at_once: 1, outlines: [] } }));
  show(<TryResults />);
  expect(screen.getByTestId('tries-row-1')).toHaveTextContent('waiting');
});

const started = { job: 'a1', t: 3.25, at_once: 1, outlines: [] };

it('draws the chosen rows in 3D', async () => {
  beginJob('a1', place, ['1', '2']);
  const outcomes = [outcomeOf(0), outcomeOf(1), outcomeOf(2, { end: 'refused', ticks: 0, paths: {} })];
  changeJob('a1', () => ({ started, outcomes }));
  show(<TryResults />);
  expect(screen.getByTestId('tries-choose-2')).toBeDisabled();
  expect(screen.getByTestId('tries-3d')).toHaveTextContent('Show 2 paths in 3D');
  await user.click(screen.getByTestId('tries-choose-0'));
  await user.click(screen.getByTestId('tries-3d'));
  expect(useShownPaths.getState().paths.map(({ label }) => label)).toEqual(['1']);
  act(() => hidePaths('tries'));
});

it('shows seeds, of which only the run as it is can be opened', () => {
  beginJob('a1', { run: 'a', t: 3.25 }, ['40']);
  changeJob('a1', () => ({ started, outcomes: [outcomeOf(0), outcomeOf(1)] }));
  show(<TryResults />);
  expect(screen.getByTestId('tries-results')).toHaveTextContent('Results for seeds, from 3.25 s');
  expect(screen.getByRole('columnheader', { name: 'Seed' })).toBeVisible();
  expect(screen.getByTestId('tries-branch-0')).toBeVisible();
  expect(screen.queryByTestId('tries-branch-1')).toBeNull();
});

it('says after what time each ended, and names blocks by those that lead to them', () => {
  const node = { uid: 1, parent: 0, type: 'Sequence', kind: '', name: 'Main', path: 'Main::1' };
  const more = { node_id: 'n', tree_id: 'MainTree', ports: {} };
  useMoment.setState({
    tree: [
      { ...node, ...more },
      { ...node, ...more, uid: 6, parent: 1, name: 'Forward', path: 'Forward::6' },
    ],
  });
  onTestFinished(() => useMoment.setState({ tree: [] }));
  beginJob('a1', place, ['1', '2']);
  const outcomes = [
    outcomeOf(0),
    outcomeOf(1, { end: 'finished', root: 'SUCCESS', t: 4.5, nodes: [] }),
    outcomeOf(2, { end: 'refused', ticks: 0, nodes: [], paths: {} }),
  ];
  changeJob('a1', () => ({ started, outcomes }));
  show(<TryResults />);
  expect(screen.getByTestId('tries-row-1')).toHaveTextContent('tree ended: SUCCESS after 1.25 s');
  expect(screen.getByTestId('tries-row-0')).not.toHaveTextContent('after');
  expect(screen.getByTestId('tries-row-2')).not.toHaveTextContent('after');
  expect(screen.getByTestId('tries-row-0')).toHaveTextContent('Main › Forward');
  expect(screen.getByTestId('tries-results')).toHaveTextContent('Results for lin_speed of Main › Forward');
});
