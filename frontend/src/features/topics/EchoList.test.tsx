import { screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { useTopicsStore, type Echo } from '@/store/session/topics';
import { show, user } from '../../../harness/testing';
import { EchoList } from './EchoList';

const echo = (
  topic: string,
  message: Record<string, unknown> | null,
  cut: Record<string, number> = {},
): Echo => ({
  topic,
  count: message ? 3 : 0,
  last: message ? { topic, type: 'a/msg/A', message, bytes: 64, t: 1, cut } : null,
});

const open = (...echoes: Echo[]) => {
  useTopicsStore.setState({ echoes: Object.fromEntries(echoes.map((each) => [each.topic, each])) });
  show(<EchoList />);
};
const row = (path: string) => document.querySelector(`[data-path="${path}"]`) as HTMLElement;

beforeEach(() => {
  onTestFinished(() => useTopicsStore.setState(useTopicsStore.getInitialState(), true));
});

describe('EchoList', () => {
  it('shows each echoed topic', () => {
    open(echo('/a', { x: 1 }), echo('/b', null));
    expect(screen.getByTestId('echo-/a')).toHaveAttribute('data-count', '3');
    expect(screen.getByRole('region', { name: '/a' })).toHaveTextContent('1.00 s · 64 B');
    const waiting = within(screen.getByRole('region', { name: '/b' }));
    expect(waiting.queryByRole('button', { name: /^Publish one/ })).toBeNull();
  });

  it('indents fields by their depth', () => {
    open(echo('/a', { pose: { x: 1 } }));
    expect(row('pose')).toHaveStyle({ paddingLeft: '8px' });
    expect(row('pose.x')).toHaveStyle({ paddingLeft: '22px' });
  });

  it.each(['header', 'covariance', 'ranges', 'intensities', 'data'])(
    'folds %s at first, also within',
    async (name) => {
      open(
        echo('/a', { [name]: { inner: 1 }, pose: { [name]: { inner: 2 } }, [`my_${name}`]: { inner: 3 } }),
      );
      const isOpen = (path: string) => within(row(path)).getByRole('button').getAttribute('aria-expanded');
      expect([isOpen(name), isOpen('pose'), isOpen(`pose.${name}`), isOpen(`my_${name}`)]).toEqual([
        'false',
        'true',
        'false',
        'true',
      ]);
      await user.click(within(row(name)).getByRole('button'));
      expect(isOpen(name)).toBe('true');
      expect(row(`${name}.inner`)).toHaveTextContent('inner1');
      await user.click(within(row(name)).getByRole('button'));
      expect(isOpen(name)).toBe('false');
    },
  );

  it('counts the items of a list, even of a shortened one', () => {
    open(echo('/a', { few: [1, 2], many: [1, 2] }, { many: 900 }));
    expect(row('few')).toHaveTextContent(/few.*2/);
    expect(row('many')).toHaveTextContent(/many.*900/);
  });

  it('plots numbers and booleans, and nothing else', () => {
    open(echo('/a', { n: 1, b: true, s: 'x' }));
    const canPlot = (path: string) => within(row(path)).queryByRole('button') !== null;
    expect([canPlot('n'), canPlot('b'), canPlot('s')]).toEqual([true, true, false]);
  });
});
