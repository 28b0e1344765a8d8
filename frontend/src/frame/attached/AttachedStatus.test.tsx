import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { attached } from '../../../harness/attached';
import { openSession, show } from '../../../harness/testing';
import { AttachedStatus } from './AttachedStatus';

const none = { changed: [], flashed: [], past: [], forced: [], duration_ms: 0 };

it('shows the address, the age of the last status, and what could not be read', async () => {
  const executor = await openSession();
  show(<AttachedStatus address="robot:1667" />);
  expect(screen.getByTestId('attached-age')).toHaveTextContent('no status yet');
  executor.emit('attached', attached({ dropped: 2 }));
  executor.emit('tick', { n: 1, ...none }, 4.25);
  await expect.poll(() => screen.getByTestId('attached-age').textContent).toMatch(/last status .* s ago/);
  expect(screen.getByText(/robot:1667 · following/)).toBeInTheDocument();
  expect(screen.getByText('2 entries could not be read')).toBeInTheDocument();
  expect(screen.getByTestId('attached-time')).toHaveTextContent('4.3 s');
});
