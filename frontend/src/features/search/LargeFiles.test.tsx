import { screen, waitFor } from '@testing-library/react';
import { expect, it, onTestFinished, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useLargeFiles } from '@/store/saving/large';
import { projectDetail, projectFile } from '@/store/testing';
import { show, user } from '../../../harness/testing';
import { LargeFiles } from './LargeFiles';

const left = (path: string) => ({ ...projectFile(path, 1, ''), content: null, left_out: true });
const kinds = () => Object.values(useProjectStore.getState().files).map(({ kind }) => kind);

function openLarge(fetching: (path: string, signal: AbortSignal) => Promise<Response>) {
  vi.stubGlobal('fetch', (url: string, init: RequestInit) =>
    fetching(url.replace(/^.*\/files\//, ''), init.signal as AbortSignal),
  );
  useProjectStore.getState().load(projectDetail(1, [left('a.txt'), left('b.txt')]));
  onTestFinished(() => {
    vi.unstubAllGlobals();
    useProjectStore.getState().close();
    useLargeFiles.setState({ failed: {} });
  });
  show(<LargeFiles />);
}

it('loads the large files before they are searched', async () => {
  openLarge(() => Promise.resolve(new Response('text')));
  expect(screen.getByRole('status')).toHaveTextContent('0 of 2 large files are loaded');
  await waitFor(() => expect(kinds()).toEqual(['text', 'text']));
  expect(screen.queryByTestId('search-large')).toBeNull();
});

it('can be cancelled, and says what is not searched', async () => {
  openLarge(
    (path, signal) =>
      new Promise((done, fail) => {
        if (path === 'a.txt') done(new Response('text'));
        else signal.addEventListener('abort', () => fail(new DOMException('', 'AbortError')));
      }),
  );
  await waitFor(() => expect(screen.getByRole('status')).toHaveTextContent('1 of 2'));
  await user.click(screen.getByRole('button', { name: 'Cancel' }));
  expect(screen.getByRole('status')).toHaveTextContent('1 large file is not searched.');
  expect(kinds()).toEqual(['text', 'large']);
  expect(screen.getByRole('button', { name: 'Load' })).toBeInTheDocument();
});

it('says that the server cannot be reached', async () => {
  openLarge(() => Promise.reject(new TypeError('no network')));
  await waitFor(() => expect(screen.getByRole('status')).toHaveTextContent('the server cannot be reached'));
});
