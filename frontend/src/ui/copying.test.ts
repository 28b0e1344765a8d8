import { screen } from '@testing-library/react';
import { createElement } from 'react';
import { expect, it, onTestFinished, vi } from 'vitest';
import { show } from '../../harness/testing';
import { copyLink, copyText } from './copying';

function clipboard(writeText: (text: string) => Promise<void>) {
  vi.stubGlobal('navigator', Object.create(navigator, { clipboard: { value: { writeText } } }) as Navigator);
  onTestFinished(() => {
    vi.unstubAllGlobals();
  });
}

it('copies an address, and says what it opens', async () => {
  const writeText = vi.fn(() => Promise.resolve());
  clipboard(writeText);
  show(createElement('main'));
  await copyLink('https://x/projects/p1?run=a', 'All who may see the run');
  expect(writeText).toHaveBeenCalledWith('https://x/projects/p1?run=a');
  expect(await screen.findByText('All who may see the run')).toBeInTheDocument();
});

it('shows the address where the browser denies the clipboard', async () => {
  clipboard(() => Promise.reject(new Error('denied')));
  show(createElement('main'));
  await copyLink('https://x/projects/p1?run=b', '');
  expect(await screen.findByText('https://x/projects/p1?run=b')).toBeInTheDocument();
});

it('copies a text, and says whether it could', async () => {
  show(createElement('p'));
  const write = vi.spyOn(navigator.clipboard, 'writeText').mockRejectedValueOnce(new Error('denied'));
  await copyText('a', { done: 'Copied.', failed: 'Not copied.' });
  expect(await screen.findByText('Not copied.')).toBeInTheDocument();
  write.mockResolvedValueOnce();
  await copyText('b', { done: 'Copied.', failed: 'Not copied.' });
  expect(write).toHaveBeenLastCalledWith('b');
  expect(await screen.findByText('Copied.')).toBeInTheDocument();
  write.mockRestore();
});
