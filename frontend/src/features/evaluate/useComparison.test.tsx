import { screen, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import { evaluation } from '../../../harness/evaluations';
import { fakeServer, show } from '../../../harness/testing';
import { useComparison } from './useComparison';

function P({ older, state }: { readonly older: number | null; readonly state: 'done' | 'running' }) {
  return <p>{useComparison('p1', evaluation({ older, state })).data?.p ?? 'none'}</p>;
}

it('asks for the comparison once both revisions are run', async () => {
  const { requests } = fakeServer({ 'GET /projects/p1/evaluations/e1/comparison': { p: 0.5 } });
  const { rerender } = show(<P older={null} state="done" />);
  rerender(<P older={3} state="running" />);
  expect(requests).toEqual([]);
  rerender(<P older={3} state="done" />);
  await waitFor(() => expect(screen.getByText('0.5')).toBeInTheDocument());
});
