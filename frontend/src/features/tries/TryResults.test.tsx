import { screen } from '@testing-library/react';
import { afterEach, expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { place } from '../../../harness/tries';
import { beginJob, changeJob, useTries } from '@/store/session/tries';
import { TryResults } from './TryResults';

afterEach(() => useTries.setState({ job: null }));

it('shows the rows that wait once the run is at the moment', () => {
  beginJob('a1', place, ['1']);
  changeJob('a1', () => ({ started: { job: 'a1', t: 3.25, at_once: 1, outlines: [] } }));
  show(<TryResults />);
  expect(screen.getByTestId('tries-row-1')).toHaveTextContent('waiting');
});
