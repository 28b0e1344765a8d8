import { act, fireEvent, screen, waitFor } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import '@/i18n/editorTexts';
import { closeImporting, useImporting } from '@/store/dialogs/importing';
import { openNewRobot, useNewRobot } from '@/store/dialogs/newRobot';
import { useProjectStore } from '@/store/project';
import { lookOnly } from '../../../harness/documents';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show } from '../../../harness/testing';
import { FileDrop } from './FileDrop';

const drop = (name: string) =>
  fireEvent.drop(window, { dataTransfer: { types: ['Files'], items: [], files: [new File(['x'], name)] } });

it('sends a log that is dropped on the page', async () => {
  const { requests } = fakeServer({
    'POST /projects/p1/runs/logs?filename=patrol.btlog': refusal('It is damaged.'),
  });
  openProject({});
  show(<FileDrop />);
  drop('patrol.btlog');
  expect(await screen.findByText('The log cannot be opened')).toBeInTheDocument();
  expect(requests.map(({ path }) => path)).toContain('/projects/p1/runs/logs?filename=patrol.btlog');
});

it('opens the import of a robot or a world, as the open dialogue wants it', async () => {
  fakeServer({});
  openProject({});
  show(<FileDrop />);
  openNewRobot();
  drop('cart.zip');
  await waitFor(() => expect(useImporting.getState()).toMatchObject({ isOpen: true, kind: 'robot' }));
  expect(useImporting.getState().source?.files.map(({ path }) => path)).toEqual(['cart.zip']);
  expect(useNewRobot.getState().base).toBeNull();
  closeImporting();
  drop('yard.sdf');
  await waitFor(() => expect(useImporting.getState()).toMatchObject({ isOpen: true, kind: null }));
  closeImporting();
});

it('says when what is dropped cannot be read', async () => {
  fakeServer({});
  openProject({});
  show(<FileDrop />);
  const entry = {
    ...{ isFile: true, isDirectory: false, fullPath: '/cart.zip' },
    file: (_: unknown, fail: () => void) => fail(),
  };
  const items = [{ kind: 'file', webkitGetAsEntry: () => entry }];
  const files = [new File(['x'], 'cart.zip')];
  fireEvent.drop(window, { dataTransfer: { types: ['Files'], items, files } });
  expect(await screen.findByText(/^cart.zip cannot be read\. Choose it again/)).toBeInTheDocument();
  expect(useImporting.getState().isOpen).toBe(false);
});

it('does not end an import that is under way', async () => {
  fakeServer({});
  openProject({});
  show(<FileDrop />);
  useImporting.setState({ isBusy: true });
  onTestFinished(() => useImporting.setState({ isBusy: false }));
  const { count } = useImporting.getState();
  drop('cart.zip');
  await act(async () => undefined);
  expect(useImporting.getState().count).toBe(count);
  useImporting.setState({ isBusy: false });
  drop('yard.sdf');
  await waitFor(() => expect(useImporting.getState().source?.name).toBe('yard.sdf'));
  expect(useImporting.getState().count).toBe(count + 1);
  closeImporting();
});

it('does not import for those who may only look', async () => {
  fakeServer({});
  openProject({});
  show(<FileDrop />);
  lookOnly();
  onTestFinished(() => useProjectStore.setState({ role: 'owner' }));
  drop('cart.zip');
  expect(await screen.findByText(/You may only look at this project/)).toBeInTheDocument();
  expect(useImporting.getState().isOpen).toBe(false);
});

it('says which files can be dropped', async () => {
  fakeServer({});
  openProject({});
  show(<FileDrop />);
  drop('holiday.jpg');
  expect(await screen.findByText('This file cannot be opened here')).toBeInTheDocument();
});
