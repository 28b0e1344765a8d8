import { fireEvent, screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show } from '../../../harness/testing';
import { LogDrop } from './LogDrop';

const drop = (name: string) =>
  fireEvent.drop(window, { dataTransfer: { types: ['Files'], files: [new File(['x'], name)] } });

it('sends a log that is dropped on the page', async () => {
  const { requests } = fakeServer({
    'POST /projects/p1/runs/logs?filename=patrol.btlog': refusal('It is damaged.'),
  });
  openProject({});
  show(<LogDrop />);
  drop('patrol.btlog');
  expect(await screen.findByText('The log cannot be opened')).toBeInTheDocument();
  expect(requests.map(({ path }) => path)).toContain('/projects/p1/runs/logs?filename=patrol.btlog');
});

it('says which files can be dropped', async () => {
  fakeServer({});
  openProject({});
  show(<LogDrop />);
  drop('holiday.jpg');
  expect(await screen.findByText('This file cannot be opened here')).toBeInTheDocument();
});
