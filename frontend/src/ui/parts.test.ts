import { act, render, screen } from '@testing-library/react';
import { createElement, Suspense } from 'react';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { loadPart, PartMissing, preparedPart, stylesArrive } from './parts';

let server: MutationObserver | null = null;

/**
 * Returns a style sheet as the page sees one that loads at the `attempts`-th request; jsdom requests none.
 */
function styleThatComes(attempts: number): HTMLLinkElement {
  const link = document.createElement('link');
  link.rel = 'stylesheet';
  link.href = '/assets/part.css';
  Object.defineProperty(link, 'sheet', { value: { cssRules: [] } });
  let asked = 1;
  server = new MutationObserver((changes) => {
    for (const added of changes.flatMap((change) => [...change.addedNodes])) {
      if (!(added instanceof HTMLLinkElement) || added === link) continue;
      asked += 1;
      if (asked >= attempts) Object.defineProperty(added, 'sheet', { value: { cssRules: [{}] } });
      added.dispatchEvent(new Event(asked >= attempts ? 'load' : 'error'));
    }
  });
  server.observe(document.head, { childList: true });
  document.head.append(link);
  return link;
}

const links = () => [...document.querySelectorAll<HTMLLinkElement>('link[rel=stylesheet]')];

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
  server?.disconnect();
  document.head.replaceChildren();
});

/** Returns the outcome of a promise after all retries. */
async function outcome<T>(promise: Promise<T>): Promise<PromiseSettledResult<T>> {
  const settled = Promise.allSettled([promise]);
  await vi.advanceTimersByTimeAsync(20_000);
  return (await settled)[0];
}

describe('a part of the page', () => {
  it('is requested again when it fails', async () => {
    const load = vi.fn().mockRejectedValueOnce(new Error('timed out')).mockResolvedValue('part');
    expect(await outcome(loadPart(load))).toEqual({ status: 'fulfilled', value: 'part' });
    expect(load).toHaveBeenCalledTimes(2);
  });

  it('is given up after some seconds, with an error', async () => {
    const load = vi.fn().mockRejectedValue(new Error('timed out'));
    expect(await outcome(loadPart(load))).toEqual({
      status: 'rejected',
      reason: new PartMissing('timed out'),
    });
    expect(load).toHaveBeenCalledTimes(4);
  });

  it('is not shown before its style sheet has loaded', async () => {
    styleThatComes(3);
    expect(await outcome(loadPart(() => Promise.resolve('part')))).toMatchObject({ value: 'part' });
    expect(links().map((link) => link.sheet?.cssRules.length)).toEqual([1]);
  });
});

describe('a prepared part', () => {
  const Text = ({ text }: { readonly text: string }) => text;
  const shown = (part: typeof Text) =>
    render(createElement(Suspense, { fallback: 'waiting' }, createElement(part, { text: 'part' })));

  it('is shown at once', async () => {
    const [Part, prepare] = preparedPart(() => Promise.resolve(Text));
    await outcome(prepare());
    shown(Part as typeof Text);
    expect(screen.getByText('part')).toBeInTheDocument();
  });

  it('is awaited if it is shown before it has come', async () => {
    const [Part] = preparedPart(() => Promise.resolve(Text));
    shown(Part as typeof Text);
    expect(screen.getByText('waiting')).toBeInTheDocument();
    await act(() => vi.advanceTimersByTimeAsync(1000));
    expect(screen.getByText('part')).toBeInTheDocument();
  });
});

describe('the styles of a page', () => {
  it('are named in the error if they never load', async () => {
    styleThatComes(99);
    expect(await outcome(stylesArrive())).toMatchObject({
      reason: new PartMissing('The style sheet /assets/part.css did not come.'),
    });
  });
});
