import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { refusal } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { LogButton } from './LogButton';

it('says why a log cannot be read', async () => {
  fakeServer({
    'POST /projects/p1/runs/logs?filename=f.btlog': refusal('f.btlog:0: it ends within its head'),
  });
  const { container } = show(<LogButton projectId="p1" />);
  expect(screen.getByRole('button', { name: 'Open a log of a robot…' })).toBeEnabled();
  const input = container.ownerDocument.querySelector('input[type=file]');
  await user.upload(input as HTMLInputElement, new File(['x'], 'f.btlog'));
  expect(await screen.findByText('The log cannot be opened')).toBeInTheDocument();
  expect(screen.getByText(/it ends within its head/)).toBeInTheDocument();
});
