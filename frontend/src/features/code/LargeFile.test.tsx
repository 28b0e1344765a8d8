import { screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useLargeFiles } from '@/store/saving/large';
import { projectDetail, projectFile } from '@/store/testing';
import { fakeServer, show, user } from '../../../harness/testing';
import { CodeTab } from './CodeTab';
import { LargeFile } from './LargeFile';

const PATH = 'big.txt';

function openLarge(answer?: Response, shown = <CodeTab path={PATH} />) {
  fakeServer(answer ? { [`GET /projects/p1/files/${PATH}`]: answer } : {});
  const file = { ...projectFile(PATH, 1, ''), content: null, left_out: true };
  useProjectStore.getState().load(projectDetail(1, [file]));
  onTestFinished(() => {
    useProjectStore.getState().close();
    useLargeFiles.setState({ failed: {} });
  });
  show(shown);
}

it('loads a large file when it is opened, and shows its text', async () => {
  openLarge(new Response('the text'));
  expect(screen.getByLabelText('big.txt is loaded…')).toBeInTheDocument();
  expect(await screen.findByTestId('code-editor')).toHaveTextContent('the text');
});

it('says why it cannot be loaded, and tries again', async () => {
  openLarge();
  expect(await screen.findByRole('alert')).toHaveTextContent('big.txt could not be loaded: Not found');
  fakeServer({ [`GET /projects/p1/files/${PATH}`]: new Response('now') });
  await user.click(screen.getByRole('button', { name: 'Try again' }));
  expect(await screen.findByTestId('code-editor')).toHaveTextContent('now');
});

it('says that it opens when the server can be reached', async () => {
  openLarge(undefined, <LargeFile path={PATH} />);
  await screen.findByRole('alert');
  useLargeFiles.setState({ failed: { [PATH]: { reason: '', isOffline: true } } });
  expect(await screen.findByText(/It opens when the server can be reached/)).toBeInTheDocument();
});
