import { screen } from '@testing-library/react';
import { useState } from 'react';
import { expect, it } from 'vitest';
import { show, user } from '../../harness/testing';
import { lazyPart } from './parts';
import { PartDialog } from './PartDialog';

let loads = 0;
const Contents = lazyPart(async () => {
  loads += 1;
  await Promise.resolve();
  return () => <p>Contents</p>;
});

function Page() {
  const [isOpen, setOpen] = useState(false);
  return (
    <>
      <button onClick={() => setOpen(true)}>Open</button>
      <PartDialog isOpen={isOpen} onClose={() => setOpen(false)} title="Runs" closeLabel="Close the runs">
        <Contents />
      </PartDialog>
    </>
  );
}

it('loads its contents when it opens, and has none while it is closed', async () => {
  show(<Page />);
  expect(loads).toBe(0);
  await user.click(screen.getByRole('button', { name: 'Open' }));
  expect(screen.getByRole('dialog', { name: 'Runs' })).toBeInTheDocument();
  expect(await screen.findByText('Contents')).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Close the runs' }));
  expect(screen.queryByText('Contents')).toBeNull();
});
