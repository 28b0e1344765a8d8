import { screen } from '@testing-library/react';
import { createElement } from 'react';
import { expect, it, onTestFinished, vi } from 'vitest';
import { show } from '../../harness/testing';
import { copyLink } from './copyLink';

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
